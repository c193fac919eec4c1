// A map from object handles to small values, with memory for its elements alone, not for all
// handles up to the greatest.
#pragma once

#include <bit>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "im/basics/checked.h"

#include "rti/handles.h"

namespace rink::rti {

/// Open addressing with linear probing, at most three quarters full; what is erased leaves no
/// trace, so look-ups never slow down. A federate that sees 100 of 100,000 objects keeps 1 to 2 kB
/// where a table over all handles takes 800 kB, and a look-up stays within its processor's cache.
template <class Value>
class ObjectMap {
 public:
  std::size_t size() const { return size_; }

  /// The value of `object`, or null. Valid until the next insertion or erasure.
  Value* find(ObjectHandle object) {
    if (size_ == 0 || object.value == nobody) return nullptr;
    const std::size_t at = place_of(object.value);
    return slots_[at].key == object.value ? &slots_[at].value : nullptr;
  }
  const Value* find(ObjectHandle object) const {
    return const_cast<ObjectMap*>(this)->find(object);
  }

  /// The value of `object`, which is inserted if it is not there.
  Value& operator[](ObjectHandle object) {
    assert(object.value != nobody && "the empty handle marks empty slots");
    if (4 * (size_ + 1) > 3 * slots_.size()) grow();
    Slot& slot = slots_[place_of(object.value)];
    if (slot.key == nobody) {
      slot.key = object.value;
      ++size_;
    }
    return slot.value;
  }

  void erase(ObjectHandle object) {
    if (find(object) == nullptr) return;
    std::size_t hole = place_of(object.value);
    // An element that a probe would no longer find, since the probe ends at the hole, moves into
    // the hole (Knuth, volume 3, 6.4, algorithm R).
    for (std::size_t at = next(hole); slots_[at].key != nobody; at = next(at)) {
      const std::size_t from_home = (at - home_of(slots_[at].key)) & mask(),
                        from_hole = (at - hole) & mask();
      if (from_home < from_hole) continue;
      slots_[hole] = std::move(slots_[at]);
      hole = at;
    }
    slots_[hole] = {};
    --size_;
    assert(!checks_whole_structures || find(object) == nullptr);
  }

  /// Asserts that every key is found, that there are as many as counted, and room for probes to
  /// end.
  void check() const {
    assert(slots_.empty() || std::has_single_bit(slots_.size()));
    assert(4 * size_ <= 3 * slots_.size());
    [[maybe_unused]] std::size_t count = 0;
    for (std::size_t at = 0; at < slots_.size(); ++at) {
      if (slots_[at].key == nobody) continue;
      assert(place_of(slots_[at].key) == at);
      ++count;
    }
    assert(count == size_);
  }

  /// Calls `visit(ObjectHandle, const Value&)` for each, in no particular order.
  template <class Visit>
  void for_each(Visit visit) const {
    for (const Slot& slot : slots_)
      if (slot.key != nobody) visit(ObjectHandle{slot.key}, slot.value);
  }

  std::size_t memory_bytes() const { return slots_.capacity() * sizeof(Slot); }

 private:
  static constexpr std::uint32_t nobody = ObjectHandle{}.value;
  struct Slot {
    std::uint32_t key = nobody;
    Value value{};
  };

  std::size_t mask() const { return slots_.size() - 1; }
  std::size_t next(std::size_t at) const { return (at + 1) & mask(); }
  /// Handles of neighbours in the world may be neighbours in number: the golden ratio scatters them
  /// (Knuth, volume 3, 6.4).
  std::size_t home_of(std::uint32_t key) const {
    return (key * std::uint64_t{0x9E3779B97F4A7C15} >> 32) & mask();
  }
  /// Where `key` is, or the empty slot where it would go.
  std::size_t place_of(std::uint32_t key) const {
    std::size_t at = home_of(key);
    while (slots_[at].key != key && slots_[at].key != nobody) at = next(at);
    return at;
  }
  void grow() {
    std::vector<Slot> old(slots_.empty() ? 8 : 2 * slots_.size());
    old.swap(slots_);
    for (Slot& slot : old)
      if (slot.key != nobody) slots_[place_of(slot.key)] = std::move(slot);
    if constexpr (checks_whole_structures) check();
  }

  std::vector<Slot> slots_;  ///< a power of two of them
  std::size_t size_ = 0;
};

}  // namespace rink::rti
