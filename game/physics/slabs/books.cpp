// A stable sort: into slots of time by counting, and by insertion within them.
#include "game/physics/slabs/books.h"

#include <algorithm>
#include <cassert>
#include <cstddef>

namespace rink::physics::inline RINK_PRECISION {

namespace {

bool comes_before(const BookEntry& a, const BookEntry& b) { return precedes(a.order, b.order); }

}  // namespace

/// Events come about evenly in time, so that few are in one slot: five times as fast as to compare
/// all.
void Books::sort_by_slots() {
  const auto [first, last] = std::minmax_element(
      entries_.begin(), entries_.end(),
      [](const BookEntry& a, const BookEntry& b) { return a.order.time < b.order.time; });
  const Real begin = first->order.time, span = last->order.time - begin;
  const std::size_t count = entries_.size();
  const auto slot = [&](const BookEntry& entry) {
    const Real part = span > 0.0 ? (entry.order.time - begin) / span : Real(0.0);
    return static_cast<std::size_t>(static_cast<double>(part) * static_cast<double>(count - 1));
  };
  ends_.assign(count + 1, 0);
  for (const BookEntry& entry : entries_) ++ends_[slot(entry) + 1];
  for (std::size_t k = 0; k < count; ++k) ends_[k + 1] += ends_[k];
  sorted_.resize(count);
  for (const BookEntry& entry : entries_) sorted_[ends_[slot(entry)]++] = entry;
}

void Books::enter() {
  if (entries_.empty()) return;
  sort_by_slots();
  std::uint32_t begin = 0;
  for (std::size_t k = 0; k + 1 < ends_.size(); begin = ends_[k++]) sort_slot(begin, ends_[k]);
  assert(std::is_sorted(sorted_.begin(), sorted_.end(), comes_before));
  for (const BookEntry& entry : sorted_) ledger_.spend(entry.transfer);
}

/// By insertion, unless very many events come at one instant.
void Books::sort_slot(std::uint32_t begin, std::uint32_t end) {
  constexpr std::uint32_t few = 32;
  if (end - begin > few)
    return std::stable_sort(sorted_.begin() + begin, sorted_.begin() + end, comes_before);
  for (std::uint32_t k = begin + 1; k < end; ++k) {
    const BookEntry entry = sorted_[k];
    std::uint32_t place = k;
    for (; place > begin && comes_before(entry, sorted_[place - 1]); --place)
      sorted_[place] = sorted_[place - 1];
    sorted_[place] = entry;
  }
}

}  // namespace rink::physics::inline RINK_PRECISION
