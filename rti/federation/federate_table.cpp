// Assigns slots, handles and blocks in a fixed order, since all of them show on the wire.
#include "rti/federation/federate_table.h"

#include <algorithm>
#include <cassert>

namespace rink::rti {

std::uint32_t FederateTable::take_slot() {
  if (free_.empty()) {
    federates_.emplace_back();
    return size() - 1;
  }
  const std::uint32_t slot = free_.back();
  assert(slot < size() && !federates_[slot].is_joined);
  free_.pop_back();
  federates_[slot] = {};
  return slot;
}

std::uint32_t FederateTable::take_block() {
  assert(has_block());
  if (free_blocks_.empty()) return next_block_++;
  const std::uint32_t block = free_blocks_.back();
  free_blocks_.pop_back();
  return block;
}

std::uint32_t FederateTable::add() {
  const std::uint32_t slot = take_slot();
  federates_[slot].block = take_block();
  return slot;
}

std::uint32_t FederateTable::admit(ConnectionId connection, std::string_view name,
                                   std::string_view type) {
  assert(!is_taken(name));
  const std::uint32_t slot = add();
  JoinedFederate& federate = federates_[slot];
  federate.is_joined = true;
  federate.connection = connection;
  federate.handle = {static_cast<std::uint32_t>(slot_of_handle_.size())};
  federate.name = name;
  federate.type = type;
  slot_of_handle_.push_back(slot);
  names_.emplace(federate.name, slot);
  ++joined_count_;
  assert(names_.size() == joined_count_);
  return slot;
}

void FederateTable::retire(std::uint32_t slot) {
  JoinedFederate& federate = federates_[slot];
  assert(federate.is_joined);
  names_.erase(federate.name);
  federate.is_joined = federate.is_watching = false;
  --joined_count_;
}

void FederateTable::release(std::uint32_t slot) {
  assert(!federates_[slot].is_joined);
  assert(std::ranges::find(free_, slot) == free_.end());
  federates_[slot] = {};
  free_.push_back(slot);
}

std::optional<std::uint32_t> FederateTable::joined(FederateHandle federate) const {
  if (!was_given(federate)) return std::nullopt;
  const std::uint32_t slot = slot_of_handle_[federate.value];
  return federates_[slot].is_joined && federates_[slot].handle == federate ? std::optional(slot)
                                                                           : std::nullopt;
}

bool FederateTable::is_sound() const {
  std::size_t count = 0;
  for (std::uint32_t slot = 0; slot < size(); ++slot) {
    const JoinedFederate& federate = federates_[slot];
    if (!federate.is_joined) continue;
    const auto named = names_.find(federate.name);
    if (named == names_.end() || named->second != slot || !was_given(federate.handle) ||
        slot_of(federate.handle) != slot || federate.block >= next_block_)
      return false;
    ++count;
  }
  std::vector<bool> is_free(size());
  for (const std::uint32_t slot : free_) {
    if (slot >= size() || federates_[slot].is_joined || is_free[slot]) return false;
    is_free[slot] = true;
  }
  return count == joined_count_ && names_.size() == count && next_block_ <= object_block_max &&
         std::ranges::all_of(slot_of_handle_, [&](std::uint32_t slot) { return slot < size(); }) &&
         std::ranges::all_of(free_blocks_, [&](std::uint32_t each) { return each < next_block_; });
}

}  // namespace rink::rti
