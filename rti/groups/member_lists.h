// Group communication that reaches every member: the one that comes with the RTI.
#pragma once

#include <vector>

#include "rti/groups/group_communication.h"

namespace rink::rti {

/// A list for each group, in the order of joining. It is returned without a copy unless the sender
/// is itself a member.
class MemberLists final : public GroupCommunication {
 public:
  void join(std::uint32_t group, std::uint32_t federate) override;
  void leave(std::uint32_t group, std::uint32_t federate) override;
  void remove_federate(std::uint32_t federate) override;
  bool is_member(std::uint32_t group, std::uint32_t federate) const override;
  std::span<const std::uint32_t> receivers(std::uint32_t group, std::uint32_t sender) override;

 private:
  std::vector<std::vector<std::uint32_t>> members_;  ///< by group
  std::vector<std::uint32_t> others_;  ///< the receivers for a sender that is a member
};

}  // namespace rink::rti
