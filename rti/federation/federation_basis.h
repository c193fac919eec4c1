// References that every service of a federation execution needs.
#pragma once

#include <cstdint>

#include "rti/federation/federate_table.h"
#include "rti/federation_counters.h"
#include "rti/federation_settings.h"
#include "rti/fom/fom.h"
#include "rti/objects/object_table.h"

namespace rink::rti {

/// While the federation is saved or restored, nobody joins and nothing but that is sent.
enum class SavePhase : std::uint8_t { idle, saving, restoring };

/// Each service keeps a copy; all that it refers to outlives the services.
struct FederationBasis {
  const Fom& fom;
  const FederationSettings& settings;
  FederateTable& federates;
  ObjectTable& objects;
  FederationCounters& counters;
  const double& now;  ///< as the clock was last advanced [s]
  const SavePhase& save_phase;
};

}  // namespace rink::rti
