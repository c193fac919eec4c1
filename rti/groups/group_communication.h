// The part of the RTI that knows who belongs to which group, and whom a message to a group reaches.
#pragma once

#include <cstdint>
#include <span>

namespace rink::rti {

/// Groups and federates are small dense numbers. The federation execution makes every interaction
/// class a group; who subscribes to it or to a class above belongs to it. Regions and the one
/// receiver of a directed interaction narrow down what `receivers` gives, for these are the
/// sender's to say; a replacement decides the rest: to all, to one in turn, to those of a site. A
/// replacement must keep these promises: nobody receives who does not belong, nor the sender, nor
/// anyone twice.
class GroupCommunication {
 public:
  virtual ~GroupCommunication() = default;

  /// Belonging twice is belonging once, and leaving what one does not belong to is nothing.
  virtual void join(std::uint32_t group, std::uint32_t federate) = 0;
  virtual void leave(std::uint32_t group, std::uint32_t federate) = 0;
  /// The federate is gone, and belongs to no group any more.
  virtual void remove_federate(std::uint32_t federate) = 0;

  virtual bool is_member(std::uint32_t group, std::uint32_t federate) const = 0;
  /// Whom the next message that `sender` says to the group goes to, in the order in which it is
  /// handed on. Asked once for each message; valid until the next operation.
  virtual std::span<const std::uint32_t> receivers(std::uint32_t group, std::uint32_t sender) = 0;
};

}  // namespace rink::rti
