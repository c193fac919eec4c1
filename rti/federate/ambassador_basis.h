// What the services of an ambassador stand on.
#pragma once

#include "rti/ambassador_counters.h"
#include "rti/federate/delivery/frame_outbox.h"
#include "rti/federate/join_phase.h"
#include "rti/federate_ambassador.h"
#include "rti/fom/fom.h"

namespace rink::rti {

/// Each service is handed it by its maker and keeps a copy; all that it names outlives them.
struct AmbassadorBasis {
  const Fom& fom;
  FederateAmbassador& callbacks;  ///< the federate, or the queue before it
  const JoinPhase& phase;
  FrameOutbox& frames;
  AmbassadorCounters& counters;
};

}  // namespace rink::rti
