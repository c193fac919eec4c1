// A set of handles of one kind, in one word of fixed width.
#pragma once

#include <bit>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <iterator>

namespace rink::rti {

/// The upper 64 bits of a wide word; none of a narrow one. Most sets are of classes that need none,
/// so that what walks through a set looks at them once, at the end of the lower ones.
template <class Word>
constexpr std::uint64_t upper_half(Word word) {
  if constexpr (sizeof(Word) > sizeof(std::uint64_t)) return static_cast<std::uint64_t>(word >> 64);
  else return 0;
}
/// The place of the lowest bit set of a word that is not 0.
template <class Word>
constexpr std::uint32_t lowest_bit(Word word) {
  const auto low = static_cast<std::uint64_t>(word);
  return static_cast<std::uint32_t>(low != 0 ? std::countr_zero(low)
                                             : 64 + std::countr_zero(upper_half(word)));
}
template <class Word>
constexpr std::size_t bit_count(Word word) {
  auto count = static_cast<std::size_t>(std::popcount(static_cast<std::uint64_t>(word)));
  // A second popcount, which is a call where the processor may lack it, would be made always.
  for (std::uint64_t upper = upper_half(word); upper != 0; upper &= upper - 1) ++count;
  return count;
}

/// Bit k stands for the handle whose value is k; every handle is below the number of bits.
template <class Handle, class Word>
struct HandleSet {
  static constexpr std::uint32_t capacity = 8 * sizeof(Word);
  Word bits = 0;

  constexpr HandleSet() = default;
  explicit constexpr HandleSet(Word bits) : bits(bits) {}
  HandleSet(std::initializer_list<Handle> handles) {
    for (const Handle handle : handles) insert(handle);
  }
  /// Every handle that a set has room for.
  static constexpr HandleSet all() { return HandleSet(static_cast<Word>(~Word{0})); }
  void insert(Handle handle) {
    assert(handle.value < capacity);
    bits |= Word{1} << handle.value;
  }
  bool contains(Handle handle) const {
    return handle.value < capacity && (bits >> handle.value & Word{1}) != 0;
  }
  bool includes(HandleSet other) const { return (other.bits & ~bits) == 0; }
  bool is_empty() const { return bits == 0; }
  std::size_t count() const { return bit_count(bits); }
  HandleSet without(HandleSet other) const { return HandleSet(bits & ~other.bits); }
  /// The rank of `handle` among all members in ascending order.
  std::size_t rank(Handle handle) const {
    assert(contains(handle));
    return bit_count(bits & ((Word{1} << handle.value) - 1));
  }
  /// The lowest member; there must be one.
  Handle front() const {
    assert(!is_empty());
    return Handle{lowest_bit(bits)};
  }
  /// The highest member; there must be one.
  Handle back() const {
    assert(!is_empty());
    const std::uint64_t upper = upper_half(bits);
    const int above = upper != 0 ? 127 - std::countl_zero(upper)
                                 : 63 - std::countl_zero(static_cast<std::uint64_t>(bits));
    return Handle{static_cast<std::uint32_t>(above)};
  }
  /// Calls `visit(Handle)` for each member in ascending order until it returns false; true if it
  /// never did. The quickest walk: a loop for each half.
  template <class Visit>
  bool all_of(Visit visit) const {
    for (auto left = static_cast<std::uint64_t>(bits); left != 0; left &= left - 1)
      if (!visit(Handle{static_cast<std::uint32_t>(std::countr_zero(left))})) return false;
    for (std::uint64_t left = upper_half(bits); left != 0; left &= left - 1)
      if (!visit(Handle{64u + static_cast<std::uint32_t>(std::countr_zero(left))})) return false;
    return true;
  }
  /// Calls `visit(Handle)` for each member in ascending order.
  template <class Visit>
  void for_each(Visit visit) const {
    all_of([&](Handle handle) { return visit(handle), true; });
  }
  /// Members in ascending order.
  class Iterator {
   public:
    explicit Iterator(Word word)
        : left_(static_cast<std::uint64_t>(word)), upper_(upper_half(word)) {
      if (left_ == 0) go_up();
    }
    Handle operator*() const {
      return Handle{base_ + static_cast<std::uint32_t>(std::countr_zero(left_))};
    }
    Iterator& operator++() {
      left_ &= left_ - 1;
      if (left_ == 0) go_up();
      return *this;
    }
    friend bool operator==(const Iterator& at, std::default_sentinel_t) { return at.left_ == 0; }

   private:
    void go_up() {
      left_ = upper_;
      upper_ = 0;
      base_ = 64;
    }
    std::uint64_t left_, upper_;
    std::uint32_t base_ = 0;
  };
  Iterator begin() const { return Iterator(bits); }
  std::default_sentinel_t end() const { return {}; }
  friend HandleSet operator|(HandleSet a, HandleSet b) { return HandleSet(a.bits | b.bits); }
  friend HandleSet operator&(HandleSet a, HandleSet b) { return HandleSet(a.bits & b.bits); }
  friend bool operator==(HandleSet, HandleSet) = default;
};

}  // namespace rink::rti
