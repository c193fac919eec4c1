// What interest management asserts of its callers: a wrong argument ends the program, with the
// condition that it broke.
#include <gtest/gtest.h>

#include "im/basics/byte_stream.h"
#include "im/basics/seeded_stream.h"
#include "im/checked_filter.h"
#include "im/composition/combination.h"
#include "im/matching/change_join.h"
#include "im/stages/flight.h"
#include "im/stages/priority_order.h"
#include "im/stages/stages.h"
#include "im/view/sector.h"

namespace rink::im {
namespace {

#ifndef NDEBUG

constexpr Region unit{0.0, 0.0, 1.0, 1.0};

TEST(ImDeathTest, NamesWhatIsWrongWithBoxesAndTheirWorld) {
  BoxIndex index;
  EXPECT_DEATH(index.begin({0.0, 0.0, 0.0, 1.0}, 1, Boxes::resting), "low_x < world.high_x");
  index.begin(unit, 1, Boxes::resting);
  index.stage(0, unit);
  EXPECT_DEATH(index.stage(1, unit), "staged_count_ <");
  EXPECT_DEATH(index.stage(1, Motion{unit, unit}), "is_moving_");
  EXPECT_DEATH(SizeLevels().count(-1.0f), "side >= 0");
}

TEST(ImDeathTest, NamesWhatIsWrongWithNumbersThatAreWritten) {
  std::vector<std::byte> bytes;
  ByteWriter writer(bytes);
  std::uint16_t number = 5;
  EXPECT_DEATH(writer.range(number, 4), "is_sound");
  std::uint64_t word = 0x1234;
  EXPECT_DEATH(writer.part(word, 1), "value >> ");
  EXPECT_DEATH(writer.part(word, 9), "size <= sizeof value");
  std::string_view name = "too long";
  EXPECT_DEATH(writer.text(name, 3), "is_sound");
}

TEST(ImDeathTest, NamesWhatIsWrongWithRegionsAndTheirHistory) {
  RegionHistory history;
  EXPECT_DEATH(history.set(0, {1.0, 0.0, 0.0, 1.0}), "is_valid");
  EXPECT_DEATH(history.set(RegionHistory::id_max, unit), "id < id_max");
  history.set(0, unit);
  history.take_moved();
  history.settle();
  EXPECT_DEATH(history.settle(), "settled_.empty");
  const std::uint32_t movers[] = {0, 1};
  EXPECT_DEATH(ChangeJoin(unit).find(history, movers, history, {}), "moved_entities.size");
}

TEST(ImDeathTest, NamesWhatIsWrongWithFiltersAndWhatTheyAreMadeOf) {
  const auto none = [] { return make_filter("none", {}); };
  EXPECT_DEATH(make_dwell(none(), 0), "matches_ >= 1");
  EXPECT_DEATH(make_tiers(none(), {}, {}), "fractions_");
  EXPECT_DEATH(make_hysteresis(none(), none(), -1.0), "margin_ >= 0");
  std::vector<std::unique_ptr<Filter>> operands;
  operands.push_back(none());
  EXPECT_DEATH(make_combination(std::move(operands), {Step::negation}), "are_sound");
  EXPECT_DEATH(CheckedFilter(nullptr, 4), "filter_ != nullptr");
  const Change left{0, 0, Transition::left};
  EXPECT_DEATH(PriorityOrder().take({&left, 1}), "Transition::entered");
}

TEST(ImDeathTest, NamesWhatIsWrongWithNumbers) {
  EXPECT_DEATH(SeededStream().below(0), "count > 0");
  EXPECT_DEATH(Wedge({1.0, 0.0}, 181.0), "half_angle_deg <= 180");
  EXPECT_DEATH(at_time({}, 1.0, -1.0), "drag >= 0");
}

#endif

/// Random steps, each of which leaves the structure whole.
TEST(RegionHistory, StaysWholeWhoeverMovesComesAndGoes) {
  SeededStream random(5);
  RegionHistory history;
  for (int match = 0; match < 200; ++match) {
    for (int step = 0; step < 20; ++step) {
      const std::uint32_t id = random.below(100);
      if (random.below(4) == 0) history.remove(id);
      else if (random.below(8) == 0) history.touch(id);
      else history.set(id, {0.0, 0.0, random.uniform(), 1.0});
      history.check();
    }
    history.take_moved();
    history.check();
    history.settle();
    history.check();
  }
}

}  // namespace
}  // namespace rink::im
