// What a federate keeps of keyframes: those that are still referred to, in the memory of those that
// are not.
#include "rti/baselines/keyframe_memory.h"

#include <gtest/gtest.h>

namespace rink::rti::testing {
namespace {

constexpr std::uint32_t object_count = 1000;

/// Keyframe `number`, in which object k has the counts number and k.
void add_keyframe(KeyframeMemory& memory, std::uint16_t number) {
  memory.begin(number);
  for (std::uint32_t object = 0; object < object_count; ++object) {
    const std::int64_t counts[] = {number, object};
    memory.add(object, 0.5 * number, counts);
  }
  memory.seal();
}

TEST(KeyframeMemory, TakesAsMuchAsIsReferredToHoweverManyKeyframesCame) {
  KeyframeMemory two, many;
  for (std::uint16_t number = 0; number < 2; ++number) add_keyframe(two, number);
  for (std::uint16_t number = 0; number < 3 * keyframe_window; ++number) {
    add_keyframe(many, number);
    many.drop_before(number);
  }
  EXPECT_LT(many.memory_bytes(), two.memory_bytes() + two.memory_bytes() / 10);
}

TEST(KeyframeMemory, GivesEachKeyframeThatIsKeptAsItWasWhereMemoryIsUsedAgain) {
  KeyframeMemory memory;
  for (std::uint16_t number = 0; number < 3 * keyframe_window; ++number) {
    add_keyframe(memory, number);
    const std::uint16_t oldest = number < 5 ? 0 : static_cast<std::uint16_t>(number - 5);
    memory.drop_before(oldest);
    for (std::uint16_t kept = oldest; kept <= number; ++kept)
      for (std::uint32_t object = 0; object < object_count; object += 99) {
        const auto baseline = memory.find(kept, object);
        ASSERT_TRUE(baseline) << "keyframe " << kept << " after " << number;
        EXPECT_EQ(baseline->time, 0.5 * kept);
        ASSERT_EQ(baseline->counts.size(), 2u);
        EXPECT_EQ(baseline->counts[0], kept);
        EXPECT_EQ(baseline->counts[1], object);
      }
    if (oldest > 0) {
      EXPECT_FALSE(memory.find(static_cast<std::uint16_t>(oldest - 1), 0));
    }
  }
}

}  // namespace
}  // namespace rink::rti::testing
