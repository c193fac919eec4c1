// References that every service of an ambassador needs.
#pragma once

#include "rti/ambassador_counters.h"
#include "rti/federate/delivery/frame_outbox.h"
#include "rti/federate/join_phase.h"
#include "rti/federate_ambassador.h"
#include "rti/fom/fom.h"

namespace rink::rti {

/// Each service keeps a copy; all that it refers to outlives the services.
struct AmbassadorBasis {
  const Fom& fom;
  FederateAmbassador& callbacks;  ///< the federate, or the queue before it
  const JoinPhase& phase;
  FrameOutbox& frames;
  AmbassadorCounters& counters;
};

}  // namespace rink::rti
