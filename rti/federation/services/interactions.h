// Interactions: who subscribes to which, and whom each one reaches.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "rti/distribution/data_distribution.h"
#include "rti/federation/federation_basis.h"
#include "rti/federation/services/publications.h"
#include "rti/federation/status.h"
#include "rti/groups/group_communication.h"
#include "rti/wire/declaration_messages.h"
#include "rti/wire/region_messages.h"

namespace rink::rti {

class Interactions {
 public:
  using Receivers = std::span<const std::uint32_t>;
  Interactions(const FederationBasis& basis, GroupCommunication& groups,
               DataDistribution& distribution, const Publications& publications)
      : basis_(basis), groups_(groups), distribution_(distribution), publications_(publications) {}

  Status handle_subscribe(std::uint32_t slot, Reader& reader);
  Status handle_subscribe_within(std::uint32_t slot, Reader& reader);
  /// Those who subscribe to a class or a superclass, in whatever region, belong to its group.
  void join_groups(std::uint32_t slot);
  /// How it subscribes to the class or a superclass, with and without regions.
  Listening listening(std::uint32_t slot, std::uint16_t interaction_class) const;
  /// Of the class's group; a sender in it is left out.
  Receivers receivers(std::uint16_t interaction_class, std::uint32_t sender) {
    return groups_.receivers(interaction_class, sender);
  }

  Status read(Reader& reader, InteractionMessage& message) const;
  /// With the sender's regions, which must be there.
  Status read_within(std::uint32_t slot, Reader& reader, InteractionMessage& message,
                     std::vector<RegionHandle>& regions) const;
  /// Whether it may be said, and to whom it would go.
  Status accept(std::uint32_t slot, const InteractionMessage& message, Receivers& receivers);
  /// What was accepted. `regions` are the sender's; none: the default region, which overlaps all.
  Status deliver(std::uint32_t slot, InteractionMessage& message, Receivers receivers,
                 std::span<const RegionHandle> regions);
  /// By the RTI itself, to all who subscribe. Its bytes count as said by who asked for it, so that
  /// asking can't fill the queues of those who listen.
  void report(std::uint32_t asking, InteractionClassHandle interaction_class, Bytes parameters);
  /// From now on everybody may say as much again.
  void flushed();
  void joined(std::uint32_t slot);
  void left(std::uint32_t slot);

 private:
  /// What an interaction costs beside its parameters, roughly.
  static constexpr std::size_t head_size = 16;
  bool receives_everywhere(std::uint32_t slot, std::uint16_t interaction_class) const;
  void deliver_to(std::uint32_t receiver, InteractionMessage& message);

  FederationBasis basis_;
  GroupCommunication& groups_;  ///< of federate slots: a group for each class
  DataDistribution& distribution_;
  const Publications& publications_;
  struct Federate {
    std::vector<Listening> subscribed;  ///< by class, without regions
    std::size_t bytes_sent = 0;         ///< bytes since the last flush
  };
  std::vector<Federate> federates_;  ///< by slot
};

}  // namespace rink::rti
