// Keeps the member lists; only joining and leaving search them.
#include "rti/groups/member_lists.h"

#include <algorithm>
#include <cassert>

#include "im/basics/checked.h"

namespace rink::rti {

void MemberLists::join(std::uint32_t group, std::uint32_t federate) {
  if (group >= members_.size()) members_.resize(group + 1);
  if (!is_member(group, federate)) members_[group].push_back(federate);
}

void MemberLists::leave(std::uint32_t group, std::uint32_t federate) {
  if (group < members_.size()) std::erase(members_[group], federate);
}

void MemberLists::remove_federate(std::uint32_t federate) {
  for (std::vector<std::uint32_t>& group : members_) std::erase(group, federate);
}

bool MemberLists::is_member(std::uint32_t group, std::uint32_t federate) const {
  return group < members_.size() &&
         std::ranges::find(members_[group], federate) != members_[group].end();
}

std::span<const std::uint32_t> MemberLists::receivers(std::uint32_t group, std::uint32_t sender) {
  if (group >= members_.size()) return {};
  const std::vector<std::uint32_t>& members = members_[group];
  const auto self = std::ranges::find(members, sender);
  if (self == members.end()) return members;
  others_.assign(members.begin(), self);
  others_.insert(others_.end(), self + 1, members.end());
  if constexpr (checks_whole_structures)
    assert(std::ranges::find(others_, sender) == others_.end());
  return others_;
}

}  // namespace rink::rti
