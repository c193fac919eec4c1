// The state that all services of a federation execution share, and the parts that a user may
// replace.
#pragma once

#include <memory>

#include "im/filter.h"
#include "rti/buffering/buffering.h"
#include "rti/distribution/data_distribution.h"
#include "rti/federation/federation_basis.h"
#include "rti/federation_services.h"
#include "rti/groups/group_communication.h"
#include "rti/ownership/ownership.h"

namespace rink::rti {

/// Owns what `FederationBasis` refers to. It must not move.
struct FederationGround {
  FederationGround(const Fom& fom, const FederationSettings& settings,
                   const FederationServices& services, std::unique_ptr<im::Filter> filter);
  FederationGround(const FederationGround&) = delete;
  FederationGround& operator=(const FederationGround&) = delete;
  FederationBasis basis() { return {fom, settings, federates, objects, counters, now, save_phase}; }

  const Fom& fom;
  const FederationSettings settings;
  FederationCounters counters;
  double now = 0.0;  ///< as the clock was last advanced [s]
  SavePhase save_phase = SavePhase::idle;
  FederateTable federates;
  ObjectTable objects;
  Ownership ownership;
  const std::unique_ptr<DataDistribution> distribution;
  const std::unique_ptr<Buffering> buffering;
  const std::unique_ptr<GroupCommunication> groups;  ///< of federate slots: a group for each
                                                     ///< interaction class
};

}  // namespace rink::rti
