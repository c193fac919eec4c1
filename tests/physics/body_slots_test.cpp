// Bodies in slots by their numbers, whoever comes and goes.
#include "game/physics/body_slots.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <random>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace rink::physics::test {
namespace {

/// Slots with what a world would have in them: of each body its number.
class HeldNumbers {
 public:
  explicit HeldNumbers(std::uint32_t body_count) : slots_(body_count), held_(1, none) {}

  void put(std::uint32_t number) {
    auto room = slots_.room_for(number);
    if (!room) {
      spread(number);
      room = slots_.room_for(number);
    }
    ASSERT_TRUE(room.has_value());
    BodySlots::visit_moves(*room, [&](std::uint32_t from, std::uint32_t to) {
      ASSERT_EQ(held_[to], none);
      held_[to] = std::exchange(held_[from], none);
      ++moves_;
    });
    ASSERT_EQ(held_[room->slot], none);
    held_[room->slot] = number;
    slots_.take(number, *room);
  }
  void drop(std::uint32_t number) {
    held_[slots_.slot_of(number)] = none;
    slots_.release(number);
  }
  void expect(const std::set<std::uint32_t>& numbers) const {
    ASSERT_EQ(slots_.count(), numbers.size());
    std::vector<std::uint32_t> in_order;
    for (const std::uint32_t number : held_)
      if (number != none) in_order.push_back(number);
    EXPECT_TRUE(std::ranges::equal(in_order, numbers)) << "slots are in order of numbers";
    for (std::uint32_t number = 0; number < slots_.body_count(); ++number) {
      const std::uint32_t slot = slots_.slot_of(number);
      ASSERT_EQ(slot != BodySlots::nobody, numbers.contains(number)) << number;
      if (slot != BodySlots::nobody) {
        ASSERT_EQ(held_[slot], number);
        ASSERT_EQ(slots_.number_of(slot), number);
      }
    }
    slots_.check();
  }
  const BodySlots& slots() const { return slots_; }
  std::uint64_t moves() const { return moves_; }
  std::uint64_t spreads() const { return spreads_; }

 private:
  static constexpr std::uint32_t none = 0xffffffff;

  void spread(std::uint32_t number) {
    const std::vector<std::uint32_t> from = slots_.spread(number);
    std::vector<std::uint32_t> next(from.size(), none);
    for (std::size_t slot = 0; slot < from.size(); ++slot)
      if (from[slot] != BodySlots::nobody) next[slot] = held_[from[slot]];
    held_ = next;
    ++spreads_;
  }

  BodySlots slots_;
  std::vector<std::uint32_t> held_;
  std::uint64_t moves_ = 0, spreads_ = 0;
};

std::uint32_t below(std::uint32_t end, std::mt19937& random) {
  return static_cast<std::uint32_t>(random() % end);
}

TEST(BodySlots, AreInOrderOfNumbersWhoeverComesAndGoes) {
  for (std::uint32_t seed = 0; seed < 20; ++seed) {
    std::mt19937 random(seed);
    const std::uint32_t body_count = 1 + below(900, random);
    HeldNumbers held(body_count);
    std::set<std::uint32_t> numbers;
    for (int step = 0; step < 3000; ++step) {
      // Sometimes all come from one end, or many go.
      const std::uint32_t span = step / 500 % 2 == 0 ? body_count : 1 + body_count / 8;
      const std::uint32_t number = below(span, random);
      if (numbers.contains(number)) {
        if (random() % 3 != 0) numbers.erase(number), held.drop(number);
      } else {
        numbers.insert(number), held.put(number);
      }
      if (step % 300 == 0) held.expect(numbers);
    }
    SCOPED_TRACE("seed " + std::to_string(seed));
    held.expect(numbers);
  }
}

TEST(BodySlots, TakeLittleMoreRoomThanBodiesThatAreThereAndFewMovesForThoseThatCome) {
  constexpr std::uint32_t body_count = 1'000'000, there = 20'000;
  std::mt19937 random(1);
  std::set<std::uint32_t> numbers;
  while (numbers.size() < there) numbers.insert(below(body_count, random));
  HeldNumbers held(body_count);
  for (const std::uint32_t number : numbers) held.put(number);
  EXPECT_EQ(held.moves(), 0u) << "those that come in order move nobody";
  EXPECT_LT(held.spreads(), 20u);
  const std::uint64_t spreads = held.spreads();
  std::uint64_t came = 0;
  for (int step = 0; step < 40'000; ++step, ++came) {
    const std::uint32_t gone = *numbers.lower_bound(below(*numbers.rbegin(), random));
    numbers.erase(gone), held.drop(gone);
    std::uint32_t comes = below(body_count, random);
    while (numbers.contains(comes)) comes = below(body_count, random);
    numbers.insert(comes), held.put(comes);
  }
  EXPECT_LT(held.spreads() - spreads, 40u) << "of 40,000 that came";
  EXPECT_LT(static_cast<double>(held.moves()) / static_cast<double>(came), 8.0);
  EXPECT_LT(held.slots().slot_count(), there * 9 / 8 + 100);
}

}  // namespace
}  // namespace rink::physics::test
