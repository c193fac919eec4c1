// A set of handles of one kind, in one word.
#pragma once

#include <bit>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <limits>

namespace rink::rti {

/// Bit k stands for the handle whose value is k; every handle is below the number of bits.
template <class Handle, class Word>
struct HandleSet {
  static constexpr std::uint32_t capacity = std::numeric_limits<Word>::digits;
  Word bits = 0;

  constexpr HandleSet() = default;
  explicit constexpr HandleSet(Word bits) : bits(bits) {}
  HandleSet(std::initializer_list<Handle> handles) {
    for (const Handle handle : handles) insert(handle);
  }
  void insert(Handle handle) {
    assert(handle.value < capacity);
    bits |= Word{1} << handle.value;
  }
  bool contains(Handle handle) const {
    return handle.value < capacity && (bits >> handle.value & Word{1}) != 0;
  }
  bool includes(HandleSet other) const { return (other.bits & ~bits) == 0; }
  bool is_empty() const { return bits == 0; }
  std::size_t count() const { return static_cast<std::size_t>(std::popcount(bits)); }
  HandleSet without(HandleSet other) const { return HandleSet(bits & ~other.bits); }
  /// The rank of `handle` among all members in ascending order.
  std::size_t rank(Handle handle) const {
    assert(contains(handle));
    return static_cast<std::size_t>(std::popcount(bits & ((Word{1} << handle.value) - 1)));
  }
  /// Calls `visit(Handle)` for each member in ascending order.
  template <class Visit>
  void for_each(Visit visit) const {
    for (Word left = bits; left != 0; left &= left - 1)
      visit(Handle{static_cast<std::uint32_t>(std::countr_zero(left))});
  }
  friend HandleSet operator|(HandleSet a, HandleSet b) { return HandleSet(a.bits | b.bits); }
  friend HandleSet operator&(HandleSet a, HandleSet b) { return HandleSet(a.bits & b.bits); }
  friend bool operator==(HandleSet, HandleSet) = default;
};

}  // namespace rink::rti
