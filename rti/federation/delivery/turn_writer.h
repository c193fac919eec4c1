// Objects in scope that are not updated yet, since their tier's turn has not come or the
// subscriber's budget is spent: which attributes are late, and when they are sent.
#pragma once

#include <cstddef>
#include <cstdint>

#include "rti/distribution/data_distribution.h"
#include "rti/federation/delivery/flush_context.h"
#include "rti/federation/federation_basis.h"
#include "rti/federation/services/newest_stamps.h"

namespace rink::rti {

/// It does nothing for a filter that neither decides tiers, nor holds updates back, nor has a
/// budget.
class TurnWriter {
 public:
  TurnWriter(const FederationBasis& basis, DataDistribution& distribution,
             const NewestStamps& newest)
      : basis_(basis), distribution_(distribution), newest_(newest) {}

  /// Decides for this flush. An object whose turn it is is sent by this flush's updates if they
  /// have all its late attributes, so that it is shared, sent by datagram or as a difference as
  /// usual; else by `catch_up`.
  void apply_turns(FlushContext& context);
  /// Sends the late attributes of objects that have waited, from the newest state.
  void catch_up(FlushContext& context);

 private:
  void note_late(const FlushContext& context, Turns& turns);
  std::size_t bytes_due(std::uint32_t slot, ObjectSlot object) const;

  FederationBasis basis_;
  DataDistribution& distribution_;
  const NewestStamps& newest_;
};

}  // namespace rink::rti
