// The federates that have joined a federation execution: slots, handles, names and blocks of object
// handles.
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
#include "rti/wire/state_stream.h"

namespace rink::rti {

/// Slots are dense and used again, handles are not. A reference to a federate holds until the next
/// one is added.
class FederateTable {
 public:
  JoinedFederate& operator[](std::uint32_t slot) { return federates_[slot]; }
  const JoinedFederate& operator[](std::uint32_t slot) const { return federates_[slot]; }
  /// The number of slots, free ones included.
  std::uint32_t size() const { return static_cast<std::uint32_t>(federates_.size()); }
  auto begin() { return federates_.begin(); }
  auto end() { return federates_.end(); }
  auto begin() const { return federates_.begin(); }
  auto end() const { return federates_.end(); }
  /// The number of federates that have joined.
  std::size_t joined_count() const { return joined_count_; }

  /// Adds a slot with a block of handles, of which one must be left, that belongs to no joined
  /// federate: it is sent nothing and not counted.
  std::uint32_t add();
  std::uint32_t admit(ConnectionId connection, std::string_view name, std::string_view type);
  /// The federate is no longer joined, but others are yet to be notified; `release` follows.
  void retire(std::uint32_t slot);
  /// Frees the slot.
  void release(std::uint32_t slot);

  bool is_taken(std::string_view name) const { return names_.contains(std::string(name)); }
  /// The federate's slot; nothing if it has left or the handle was never given.
  std::optional<std::uint32_t> joined(FederateHandle federate) const;
  bool was_given(FederateHandle federate) const { return federate.value < slot_of_handle_.size(); }
  /// The slot that the federate has or had; the handle must have been given.
  std::uint32_t slot_of(FederateHandle federate) const {
    assert(was_given(federate));
    return slot_of_handle_[federate.value];
  }

  bool has_block() const { return !free_blocks_.empty() || next_block_ < object_block_max; }
  /// A block must be left.
  std::uint32_t take_block();
  /// Takes back a block of which no handle was ever used.
  void give_back(std::uint32_t block) {
    assert(block < next_block_);
    free_blocks_.push_back(block);
  }
  template <class Stream>
  bool keep(Stream& stream) {
    return keep_all(stream, federates_, free_, free_blocks_, next_block_, joined_count_,
                    slot_of_handle_, names_) &&
           (!Stream::is_reading || is_sound());
  }

 private:
  std::uint32_t take_slot();
  /// True if names, handles, blocks and free slots are those of these federates.
  bool is_sound() const;

  std::vector<JoinedFederate> federates_;  ///< by slot
  std::vector<std::uint32_t> free_, free_blocks_;
  std::uint32_t next_block_ = 0;
  std::size_t joined_count_ = 0;
  std::vector<std::uint32_t>
      slot_of_handle_;  ///< by federate handle; stale once it left, so compare
  std::unordered_map<std::string, std::uint32_t> names_;
};

}  // namespace rink::rti
