// A growing set of small numbers, one bit each.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace rink::rti {

/// Looking up numbers beyond the greatest inserted is allowed. Memory is one bit per number up to
/// the greatest inserted.
class Bitmap {
 public:
  void insert(std::uint32_t number) {
    const std::size_t word = number / 64;
    if (word >= words_.size()) words_.resize(word + 1);
    words_[word] |= std::uint64_t{1} << number % 64;
  }
  /// The members of `word`, 64 numbers at once from 64 * `index` on.
  void insert_word(std::size_t index, std::uint64_t word) {
    if (word == 0) return;
    if (index >= words_.size()) words_.resize(index + 1);
    words_[index] |= word;
  }
  void insert_all(const Bitmap& others) {
    if (others.words_.size() > words_.size()) words_.resize(others.words_.size());
    for (std::size_t i = 0; i < others.words_.size(); ++i) words_[i] |= others.words_[i];
  }
  void erase_word(std::size_t index, std::uint64_t word) {
    if (index < words_.size()) words_[index] &= ~word;
  }
  void erase(std::uint32_t number) {
    if (number / 64 < words_.size()) words_[number / 64] &= ~(std::uint64_t{1} << number % 64);
  }
  bool contains(std::uint32_t number) const { return (word(number / 64) >> number % 64 & 1u) != 0; }
  /// 64 numbers at once, from 64 * `index` on.
  std::uint64_t word(std::size_t index) const { return index < words_.size() ? words_[index] : 0; }
  std::size_t word_count() const { return words_.size(); }
  /// Prefetches the first 512 numbers.
  void prefetch() const { __builtin_prefetch(words_.data()); }
  void clear() { words_.assign(words_.size(), 0); }

  /// Calls `visit(number)` for each member in ascending order.
  template <class Visit>
  void for_each(Visit visit) const {
    for (std::size_t i = 0; i < words_.size(); ++i)
      for (std::uint64_t bits = words_[i]; bits != 0; bits &= bits - 1)
        visit(
            static_cast<std::uint32_t>(i * 64 + static_cast<std::size_t>(std::countr_zero(bits))));
  }

  /// Calls `visit(number)` for each member from `first` on, then for those below it, until it
  /// returns false. Returns the number for which it did, 0 if it never did; continuing from there
  /// the next time treats all members fairly. `visit` may erase members.
  template <class Visit>
  std::uint32_t visit_from(std::uint32_t first, Visit visit) const {
    std::optional<std::uint32_t> stop;
    for (const bool is_above : {true, false})
      for_each([&](std::uint32_t number) {
        if (!stop && (number >= first) == is_above && !visit(number)) stop = number;
      });
    return stop.value_or(0);
  }

 private:
  std::vector<std::uint64_t> words_;
};

}  // namespace rink::rti
