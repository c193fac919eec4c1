// Finds room between bodies, and makes some.
#include "game/physics/body_slots.h"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <utility>

namespace rink::physics {

namespace {

/// A body that comes moves few others if one slot in nine is blank. At the beginning, when bodies
/// come in order, there are more of them.
constexpr std::uint32_t bodies_per_blank = 8, blank_min = 15;
/// To move more bodies than this costs more, in the long run, than to spread all anew.
constexpr std::uint32_t moves_max = 64;
/// Of blank slots behind all bodies.
constexpr std::uint32_t above_all = 0xffffffff;

}  // namespace

void BodySlots::make_table() {
  const std::size_t size = std::bit_ceil(std::size_t{2} * slot_count());
  table_.assign(std::max<std::size_t>(size, 2), nobody);
  shift_ = 64 - std::countr_zero(table_.size());
  for (std::uint32_t slot = 1; slot < slot_count(); ++slot)
    if (is_taken_[slot] != 0) enter(slot);
}

void BodySlots::enter(std::uint32_t slot) {
  std::size_t place = home_of(numbers_[slot]);
  while (table_[place] != nobody) place = next(place);
  table_[place] = slot;
}

std::size_t BodySlots::place_of(std::uint32_t slot) const {
  assert(is_taken_[slot] != 0);
  std::size_t place = home_of(numbers_[slot]);
  while (table_[place] != slot) place = next(place);
  return place;
}

std::optional<BodySlots::Room> BodySlots::room_for(std::uint32_t number) const {
  assert(slot_of(number) == nobody);
  const std::uint32_t end = slot_count();
  const auto slot = static_cast<std::uint32_t>(
      std::lower_bound(numbers_.begin() + 1, numbers_.end(), number) - numbers_.begin());
  if (slot < end && is_taken_[slot] == 0) return Room{slot, slot};
  for (std::uint32_t moves = 0; moves <= moves_max; ++moves) {
    if (slot > moves + 1 && is_taken_[slot - 1 - moves] == 0)
      return Room{slot - 1, slot - 1 - moves};
    if (moves > 0 && slot + moves < end && is_taken_[slot + moves] == 0)
      return Room{slot, slot + moves};
  }
  return std::nullopt;
}

void BodySlots::move(std::uint32_t from, std::uint32_t to) {
  assert(is_taken_[to] == 0);
  table_[place_of(from)] = to;
  numbers_[to] = numbers_[from];
  is_taken_[to] = std::exchange(is_taken_[from], std::uint8_t{0});
}

void BodySlots::take(std::uint32_t number, const Room& room) {
  assert(number < body_count_ && slot_of(number) == nobody);
  visit_moves(room, [this](std::uint32_t from, std::uint32_t to) { move(from, to); });
  assert(room.slot != nobody && is_taken_[room.slot] == 0);
  numbers_[room.slot] = number, is_taken_[room.slot] = 1;
  ++count_;
  enter(room.slot);
}

/// Those behind the entry that goes move up, or else they would not be found.
void BodySlots::release(std::uint32_t number) {
  const std::uint32_t slot = slot_of(number);
  assert(slot != nobody);
  std::size_t blank = place_of(slot);
  is_taken_[slot] = 0;
  --count_;
  const std::size_t mask = table_.size() - 1;
  for (std::size_t k = next(blank); table_[k] != nobody; k = next(k)) {
    const std::size_t home = home_of(numbers_[table_[k]]);
    if (((k - home) & mask) < ((k - blank) & mask)) continue;
    table_[blank] = table_[k];
    blank = k;
  }
  table_[blank] = nobody;
}

std::vector<std::uint32_t> BodySlots::spread(std::uint32_t number) {
  std::vector<std::uint32_t> taken;
  for (std::uint32_t slot = 1; slot < slot_count(); ++slot)
    if (is_taken_[slot] != 0) taken.push_back(slot);
  assert(taken.size() == count_);
  const bool comes_last = taken.empty() || numbers_[taken.back()] < number;
  const std::uint32_t blank = count_ / (comes_last ? 2 : bodies_per_blank) + blank_min;
  std::vector<std::uint32_t> from(std::size_t{1} + count_ + blank, nobody);
  for (std::uint32_t k = 0; k < count_; ++k) {
    const std::uint64_t before = comes_last ? 0 : std::uint64_t{k + 1} * blank / (count_ + 1);
    from[1 + k + before] = taken[k];
  }
  std::vector<std::uint32_t> numbers(from.size());
  std::uint32_t key = above_all;
  for (std::size_t slot = from.size() - 1; slot > 0; --slot) {
    if (from[slot] != nobody) key = numbers_[from[slot]];
    numbers[slot] = key;
  }
  numbers_ = std::move(numbers);
  is_taken_.assign(from.size(), 0);
  for (std::size_t slot = 1; slot < from.size(); ++slot) is_taken_[slot] = from[slot] != nobody;
  make_table();
  return from;
}

void BodySlots::check() const {
  assert(is_taken_[nobody] == 0 && is_taken_.size() == numbers_.size());
  assert(std::is_sorted(numbers_.begin() + 1, numbers_.end()));
  [[maybe_unused]] std::uint32_t count = 0;
  for (std::uint32_t slot = 1; slot < slot_count(); ++slot) {
    if (is_taken_[slot] == 0) continue;
    assert(slot_of(numbers_[slot]) == slot);
    ++count;
  }
  assert(count == count_);
}

}  // namespace rink::physics
