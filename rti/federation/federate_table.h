// Who has joined a federation execution: slots, handles, names and blocks of object handles.
#pragma once

#include <cassert>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "rti/federation/joined_federate.h"
#include "rti/handles.h"
#include "rti/wire/bytes.h"

namespace rink::rti {

/// Slots are dense and used again, handles are not. A reference to a federate holds until the next
/// one is added.
class FederateTable {
 public:
  JoinedFederate& operator[](std::uint32_t slot) { return federates_[slot]; }
  const JoinedFederate& operator[](std::uint32_t slot) const { return federates_[slot]; }
  /// Slots, with those that nobody has.
  std::uint32_t size() const { return static_cast<std::uint32_t>(federates_.size()); }
  auto begin() { return federates_.begin(); }
  auto end() { return federates_.end(); }
  auto begin() const { return federates_.begin(); }
  auto end() const { return federates_.end(); }
  /// Who has joined.
  std::size_t joined_count() const { return joined_count_; }

  /// A slot with a block of handles, of which one must be left, whose owner has not joined: it is
  /// sent nothing, and nobody counts it.
  std::uint32_t add();
  std::uint32_t admit(ConnectionId connection, std::string_view name, std::string_view type);
  /// It is no longer there for others, who are yet to be told; `release` follows.
  void retire(std::uint32_t slot);
  /// Nothing is left of who had the slot.
  void release(std::uint32_t slot);

  bool is_taken(std::string_view name) const { return names_.contains(std::string(name)); }
  /// Nothing if it has left, or there was none of that handle.
  std::optional<std::uint32_t> joined(FederateHandle federate) const;
  bool was_given(FederateHandle federate) const { return federate.value < slot_of_handle_.size(); }
  /// That it has or had; the handle must have been given.
  std::uint32_t slot_of(FederateHandle federate) const {
    assert(was_given(federate));
    return slot_of_handle_[federate.value];
  }

  bool has_block() const { return !free_blocks_.empty() || next_block_ < object_block_max; }
  /// One must be left.
  std::uint32_t take_block();
  /// None of its handles was ever used.
  void give_back(std::uint32_t block) {
    assert(block < next_block_);
    free_blocks_.push_back(block);
  }

 private:
  std::uint32_t take_slot();

  std::vector<JoinedFederate> federates_;  ///< by slot
  std::vector<std::uint32_t> free_, free_blocks_;
  std::uint32_t next_block_ = 0;
  std::size_t joined_count_ = 0;
  std::vector<std::uint32_t>
      slot_of_handle_;  ///< by federate handle; stale once it left, so compare
  std::unordered_map<std::string, std::uint32_t> names_;
};

}  // namespace rink::rti
