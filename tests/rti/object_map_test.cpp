// The map of known objects against an ordered map, and its memory.
#include "rti/objects/object_map.h"

#include <gtest/gtest.h>

#include <map>
#include <random>

namespace rink::rti {
namespace {

TEST(ObjectMap, HoldsWhatAnOrderedMapHoldsAfterAnyInsertionsAndErasures) {
  for (const std::uint32_t spread : {40u, 1000u, 0xfffffffeu}) {
    ObjectMap<std::uint32_t> map;
    std::map<std::uint32_t, std::uint32_t> expected;
    std::mt19937 random(spread);
    for (std::uint32_t step = 0; step < 20'000; ++step) {
      const auto number = static_cast<std::uint32_t>(random() % spread);
      if (random() % 2 == 0) {
        map[ObjectHandle{number}] = expected[number] = step;
      } else {
        map.erase(ObjectHandle{number});
        expected.erase(number);
      }
      const auto asked = static_cast<std::uint32_t>(random() % spread);
      const auto found = expected.find(asked);
      const std::uint32_t* value = map.find(ObjectHandle{asked});
      ASSERT_EQ(value != nullptr, found != expected.end());
      if (value != nullptr) {
        ASSERT_EQ(*value, found->second);
      }
      if (step % 500 == 0) map.check();
    }
    ASSERT_EQ(map.size(), expected.size());
    for (const auto& [number, value] : expected) {
      ASSERT_NE(map.find(ObjectHandle{number}), nullptr);
      ASSERT_EQ(*map.find(ObjectHandle{number}), value);
    }
  }
}

TEST(ObjectMap, TheEmptyHandleIsNeverThere) {
  ObjectMap<std::uint32_t> map;
  EXPECT_EQ(map.find({}), nullptr);
  map[ObjectHandle{1}] = 5;
  EXPECT_EQ(map.find({}), nullptr);
  map.erase({});
  EXPECT_EQ(map.size(), 1u);
}

TEST(ObjectMap, MemoryFollowsWhatIsInItAndNotTheGreatestHandle) {
  ObjectMap<std::uint32_t> map;
  EXPECT_EQ(map.memory_bytes(), 0u);
  for (std::uint32_t i = 0; i < 100; ++i) map[ObjectHandle{i * 40'000'000u % 0xfffffffeu}] = i;
  EXPECT_LE(map.memory_bytes(), 100u * 8u * 3u);
}

}  // namespace
}  // namespace rink::rti
