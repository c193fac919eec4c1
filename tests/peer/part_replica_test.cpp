// The part of a peer as another one keeps it: what it has, one step behind, and which keys it has
// told of.
#include "game/peer/session/part_replica.h"

#include <gtest/gtest.h>

namespace rink::peer::test {
namespace {

PartChange step(std::uint64_t number, bool is_whole, std::vector<Key> log) {
  return {.step = number,
          .time = 0.1 * static_cast<double>(number),
          .is_whole = is_whole,
          .bodies = {},
          .gone = {},
          .rest_contacts = {},
          .keys = {},
          .log = std::move(log)};
}

std::vector<double> times(const std::vector<Key>& log) {
  std::vector<double> all;
  for (const Key& key : log) all.push_back(key.time);
  return all;
}

const Key first{.time = 0.05}, second{.time = 0.15}, third{.time = 0.25};

TEST(PeerMirror, HasEachKeyOfItsPartOnceHoweverItWasToldOfIt) {
  PartReplica replica;
  ASSERT_TRUE(replica.add(step(1, true, {first})));
  EXPECT_EQ(times(replica.log()), (std::vector{0.05}));
  ASSERT_TRUE(replica.add(step(2, false, {second})));
  EXPECT_EQ(times(replica.log()), (std::vector{0.05, 0.15}));
  // A whole part brings the keys of all its story.
  ASSERT_TRUE(replica.add(step(7, true, {first, second, third})));
  EXPECT_EQ(times(replica.log()), (std::vector{0.05, 0.15, 0.25}));
  EXPECT_EQ(times(replica.part().log), (std::vector{0.05, 0.15, 0.25}));
  EXPECT_EQ(times(replica.log()), (std::vector{0.05, 0.15, 0.25}));
}

TEST(PeerMirror, TakesTheNextStepOrAWholePartAndGoesBackByOne) {
  PartReplica replica;
  EXPECT_FALSE(replica.add(step(1, false, {}))) << "nothing to change";
  ASSERT_TRUE(replica.add(step(4, true, {first})));
  EXPECT_FALSE(replica.add(step(6, false, {second}))) << "a step was left out";
  EXPECT_FALSE(replica.add(step(4, false, {second}))) << "a step twice";
  ASSERT_TRUE(replica.add(step(5, false, {second})));
  EXPECT_FALSE(replica.rewind(3));
  ASSERT_TRUE(replica.rewind(5));
  ASSERT_TRUE(replica.rewind(4));
  EXPECT_EQ(times(replica.log()), (std::vector{0.05}))
      << "the step that was taken back took its keys along";
  ASSERT_TRUE(replica.add(step(5, false, {third})));
  EXPECT_EQ(times(replica.log()), (std::vector{0.05, 0.25}));
  EXPECT_EQ(replica.part().time, 0.5);
}

}  // namespace
}  // namespace rink::peer::test
