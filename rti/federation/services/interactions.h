// Interactions: the subscribers of each class, and the receivers of each interaction.
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
#include "rti/wire/state_stream.h"

namespace rink::rti {

class Interactions {
 public:
  using Receivers = std::span<const std::uint32_t>;
  Interactions(const FederationBasis& basis, GroupCommunication& groups,
               DataDistribution& distribution, const Publications& publications)
      : basis_(basis), groups_(groups), distribution_(distribution), publications_(publications) {}

  Status handle_subscribe(std::uint32_t slot, Reader& reader);
  Status handle_subscribe_within(std::uint32_t slot, Reader& reader);
  /// Puts the federate into the groups of the classes to which it subscribes, also by a superclass,
  /// in any region.
  void join_groups(std::uint32_t slot);
  /// How the federate subscribes to the class or a superclass, with and without regions.
  Listening listening(std::uint32_t slot, std::uint16_t interaction_class) const;
  /// The members of the class's group without the sender.
  Receivers receivers(std::uint16_t interaction_class, std::uint32_t sender) {
    return groups_.receivers(interaction_class, sender);
  }

  Status read(Reader& reader, InteractionMessage& message) const;
  /// Reads an interaction with the sender's regions, which must exist.
  Status read_within(std::uint32_t slot, Reader& reader, InteractionMessage& message,
                     std::vector<RegionHandle>& regions) const;
  /// Checks whether the federate may send the interaction, and finds its receivers.
  Status accept(std::uint32_t slot, const InteractionMessage& message, Receivers& receivers);
  /// Delivers an accepted interaction. `regions` are the sender's; if there are none, it has the
  /// default region, which overlaps all.
  Status deliver(std::uint32_t slot, InteractionMessage& message, Receivers receivers,
                 std::span<const RegionHandle> regions);
  /// Sends an interaction of the RTI itself to all subscribers. Its bytes count as sent by the
  /// federate that requested it, so that requests cannot fill the queues of subscribers.
  void report(std::uint32_t asking, InteractionClassHandle interaction_class, Bytes parameters);
  /// Resets the limits of what each federate may send between two flushes.
  void flushed();
  void joined(std::uint32_t slot);
  void left(std::uint32_t slot);
  template <class Stream>
  bool keep(Stream& stream) {
    return keep_all(stream, federates_);
  }

 private:
  /// About what an interaction takes beside its parameters [bytes].
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
    template <class Stream>
    bool keep(Stream& stream) {
      return keep_all(stream, subscribed);
    }
  };
  std::vector<Federate> federates_;  ///< by slot
};

}  // namespace rink::rti
