// What was said later counts, whichever way it came: by the stream, or by a datagram that may have
// been overtaken.
#include "rti/federation/delivery/arrival_orders.h"

#include <gtest/gtest.h>

#include <map>
#include <random>

#include "rti/federation/services/newest_stamps.h"

namespace rink::rti {
namespace {

/// Of class 0: two attributes by best effort, and one that is reliable.
const Fom& sea() {
  static const Fom fom = Fom::parse(R"(<objectModel><objects><objectClass><name>Root</name>
<attribute><name>place</name><dataType>HLAfloat64LE</dataType>
<transportation>HLAbestEffort</transportation></attribute>
<attribute><name>speed</name><dataType>HLAfloat64LE</dataType>
<transportation>HLAbestEffort</transportation></attribute>
<attribute><name>name</name><dataType>HLAfloat64LE</dataType>
<transportation>HLAreliable</transportation></attribute>
</objectClass></objects></objectModel>)",
                                    "sea");
  return fom;
}
const AttributeSet place{AttributeHandle{0}}, speed{AttributeHandle{1}};

struct Ways : ::testing::Test {
  void SetUp() override { orders.joined(0); }
  AttributeSet by_datagram(std::uint32_t frames, std::uint32_t number, AttributeSet set) {
    return orders.accept(0, {7}, 0, set, order_of_datagram({number, frames}));
  }
  void by_frame(AttributeSet set) {
    orders.count_frame(0);
    orders.accept_frame(0, {7}, 0, set);
  }
  ArrivalOrders orders{sea()};
};

TEST_F(Ways, TakeNothingOfADatagramThatANewerOneHasOvertaken) {
  orders.begin(0);
  EXPECT_EQ(by_datagram(0, 1, place), place);
  EXPECT_EQ(by_datagram(0, 3, place), place);
  EXPECT_EQ(by_datagram(0, 2, place | speed), speed);
}

TEST_F(Ways, TakeNothingThatAFrameHasSaidSince) {
  orders.begin(0);
  by_frame(place);
  EXPECT_EQ(orders.frames_received(0), 1u);
  EXPECT_EQ(by_datagram(0, 9, place | speed), speed) << "it was sent before the frame";
  EXPECT_EQ(by_datagram(1, 10, place), place);
}

TEST_F(Ways, TakeNothingFromBeforeTheFirstDatagramThatCame) {
  by_frame(place), by_frame(speed);
  orders.begin(0);
  EXPECT_EQ(orders.first_frames(0), 2u);
  EXPECT_EQ(by_datagram(1, 1, place | speed), AttributeSet());
  EXPECT_EQ(by_datagram(2, 2, place | speed), place | speed);
}

TEST_F(Ways, ForgetOneWhoLeft) {
  orders.begin(0);
  by_frame(place);
  orders.left(0);
  orders.joined(0);
  EXPECT_EQ(orders.frames_received(0), 0u);
  EXPECT_FALSE(orders.is_kept(0));
}

/// The latest of all orders that were accepted, for each attribute; a frame's is its number.
TEST_F(Ways, AgreeWithTheGreatestOrderOfEachAttribute) {
  constexpr std::uint64_t seed = 9;
  SCOPED_TRACE(::testing::Message() << "seed " << seed);
  std::mt19937_64 random(seed);
  orders.begin(0);
  std::map<std::uint32_t, std::uint64_t> newest;
  std::uint32_t frames = 0;
  for (std::uint32_t step = 1; step < 3000; ++step) {
    const AttributeSet set(1u + static_cast<std::uint32_t>(random() % 3));
    if (random() % 3 == 0) {
      by_frame(set);
      ++frames;
      set.for_each([&](AttributeHandle each) { newest[each.value] = order_of_frame(frames); });
      continue;
    }
    const std::uint32_t sent_after =
                            frames - std::min(frames, static_cast<std::uint32_t>(random() % 3)),
                        number =
                            step - std::min(step - 1, static_cast<std::uint32_t>(random() % 9));
    const std::uint64_t order = order_of_datagram({number, sent_after});
    AttributeSet expected;
    set.for_each([&](AttributeHandle each) {
      if (order < newest[each.value]) return;
      expected.insert(each);
      newest[each.value] = order;
    });
    ASSERT_EQ(by_datagram(sent_after, number, set), expected) << step;
  }
}

/// An object of Ann's that is Bob's now: what he says of it counts, but nobody takes it to be older
/// than what she said.
TEST(ANewestStamp, IsThatOfTheOwnerAndNotOlderThanWhatAFormerOwnerSaid) {
  ObjectTable objects(sea());
  Ownership ownership(sea(), objects);
  NewestStamps newest(objects, ownership);
  newest.joined(0), newest.joined(1);
  const ObjectSlot boat = objects.insert({0}, 0, 0, "");
  newest.note(0, {.time = 5.0, .tag = 1});
  EXPECT_EQ(newest.of(boat).time, 5.0);
  newest.note_unless_older(0, {.time = 4.0, .tag = 2});
  EXPECT_EQ(newest.of(boat).time, 5.0);
  newest.note_unless_older(0, {.time = 5.0, .tag = 3});
  EXPECT_EQ(newest.of(boat).tag, 3u) << "it came later";
  newest.note_if_newer(0, {.time = 5.0, .tag = 4});
  EXPECT_EQ(newest.of(boat).tag, 3u);
  newest.inherit(boat, newest.of(boat));
  objects[boat].owner = 1;
  newest.note(1, {.time = 3.0, .tag = 5});
  EXPECT_EQ(newest.of(boat).time, 5.0);
  newest.note(1, {.time = 6.0, .tag = 6});
  EXPECT_EQ(newest.of(boat).time, 6.0);
  newest.forget(boat);
  newest.note(1, {.time = 1.0, .tag = 7});
  EXPECT_EQ(newest.of(boat).time, 1.0);
}

}  // namespace
}  // namespace rink::rti
