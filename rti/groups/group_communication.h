// The seam of group communication: the members of each group, and the receivers of a message to a
// group.
#pragma once

#include <cstdint>
#include <span>

namespace rink::rti {

/// Groups and federates are small dense numbers. The federation execution makes every interaction
/// class a group; its members are the subscribers to the class or a superclass. The sender's
/// regions, or the one receiver of a directed interaction, narrow down what `receivers` gives; a
/// replacement decides the rest: to all, to one in turn, to those of a site. A replacement must
/// keep these promises: all receivers are members, none is the sender, and none appears twice.
class GroupCommunication {
 public:
  virtual ~GroupCommunication() = default;

  /// Joining twice counts once, and leaving a group of others has no effect.
  virtual void join(std::uint32_t group, std::uint32_t federate) = 0;
  virtual void leave(std::uint32_t group, std::uint32_t federate) = 0;
  /// Removes a federate that is gone from all groups.
  virtual void remove_federate(std::uint32_t federate) = 0;

  virtual bool is_member(std::uint32_t group, std::uint32_t federate) const = 0;
  /// The receivers of the next message of `sender` to the group, in the order of delivery. Called
  /// once for each message; valid until the next operation.
  virtual std::span<const std::uint32_t> receivers(std::uint32_t group, std::uint32_t sender) = 0;
};

}  // namespace rink::rti
