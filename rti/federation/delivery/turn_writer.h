// Who is in scope and not told of yet, for his tier's turn has not come or his subscriber's budget
// is spent: what becomes late of him, and when it is told.
#pragma once

#include <cstddef>
#include <cstdint>

#include "rti/distribution/data_distribution.h"
#include "rti/federation/delivery/flush_context.h"
#include "rti/federation/federation_basis.h"
#include "rti/federation/services/newest_stamps.h"

namespace rink::rti {

/// Nothing is done for a filter that says neither tiers nor a budget.
class TurnWriter {
 public:
  TurnWriter(const FederationBasis& basis, DataDistribution& distribution,
             const NewestStamps& newest)
      : basis_(basis), distribution_(distribution), newest_(newest) {}

  /// Decides for the flush at hand. Of whom it is the turn, that goes out by this flush's updates
  /// if they say all that is late of him, so that it is shared, goes by datagram or as a difference
  /// like anybody's; else by `catch_up`.
  void apply_turns(FlushContext& context);
  /// The newest state of whom has waited, as far as it is late.
  void catch_up(FlushContext& context);

 private:
  void note_late(const FlushContext& context, Turns& turns);
  std::size_t bytes_due(std::uint32_t slot, ObjectSlot object) const;

  FederationBasis basis_;
  DataDistribution& distribution_;
  const NewestStamps& newest_;
};

}  // namespace rink::rti
