// What the services of a federation execution stand on.
#pragma once

#include "rti/federation/federate_table.h"
#include "rti/federation_counters.h"
#include "rti/federation_settings.h"
#include "rti/fom/fom.h"
#include "rti/objects/object_table.h"

namespace rink::rti {

/// Each service is handed it by its maker and keeps a copy; all that it names outlives them.
struct FederationBasis {
  const Fom& fom;
  const FederationSettings& settings;
  FederateTable& federates;
  ObjectTable& objects;
  FederationCounters& counters;
  const double& now;  ///< as the clock was last advanced [s]
};

}  // namespace rink::rti
