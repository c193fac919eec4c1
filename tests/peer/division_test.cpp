// Which divisions of a field are none, and what is said of them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "game/peer/cuts.h"
#include "tests/peer/shared_scenes.h"

namespace rink::peer::test {
namespace {

using testing::HasSubstr;

std::string objection(const std::vector<Zone>& zones, PeerNumber peer_count = 2) {
  return Division::objection(field, zones, peer_count).value_or("");
}

TEST(Division, OfTwoHalvesOrManyRectanglesIsAccepted) {
  EXPECT_EQ(objection({{{0, 0, 2, 2}, 0}, {{2, 0, 4, 2}, 1}}), "");
  EXPECT_EQ(objection({{{0, 0, 4, 0.5}, 0}, {{0, 0.5, 1, 2}, 1}, {{1, 0.5, 4, 2}, 0}}), "");
  EXPECT_EQ(objection({{{0, 0, 4, 2}, 0}}, 1), "");
}

TEST(Division, WithAGapIsRefusedAndThePlaceNamed) {
  EXPECT_THAT(objection({{{0, 0, 2, 2}, 0}, {{2.5, 0, 4, 2}, 1}}),
              HasSubstr("no zone covers x 2 to 2.5 m, y 0 to 2 m"));
  EXPECT_THAT(objection({}), HasSubstr("no zone covers x 0 to 4 m, y 0 to 2 m"));
}

TEST(Division, WithAnOverlapIsRefusedAndBothZonesNamed) {
  EXPECT_THAT(objection({{{0, 0, 2.5, 2}, 0}, {{2, 0, 4, 2}, 1}}),
              HasSubstr("zones 0 and 1 overlap at x 2 to 2.5 m, y 0 to 2 m"));
}

TEST(Division, BeyondTheFieldOrOfNobodyIsRefused) {
  EXPECT_THAT(objection({{{0, 0, 2, 2}, 0}, {{2, 0, 5, 2}, 1}}), HasSubstr("zone 1"));
  EXPECT_THAT(objection({{{0, 0, 2, 2}, 0}, {{2, 0, 4, 2}, 2}}),
              HasSubstr("belongs to peer 2, expected one below 2"));
  EXPECT_THAT(objection({{{2, 0, 2, 2}, 0}, {{2, 0, 4, 2}, 1}}),
              HasSubstr("expected sides in order"));
  EXPECT_THAT(objection({{{0, 0, std::nan(""), 2}, 0}, {{2, 0, 4, 2}, 1}}), HasSubstr("zone 0"));
}

TEST(Division, GivesEveryPlaceOneOwnerAlsoAtSidesAndInGoals) {
  Random random(5);
  for (int k = 0; k < 200; ++k) {
    const PeerNumber peer_count = 2 + below(random, 15);
    const Division division = random_division(field, random, peer_count);
    for (int i = 0; i < 100; ++i) {
      const Vector2 place(uniform(random, -0.1, 4.1), uniform(random, 0.0, 2.0));
      int owners = 0;
      for (PeerNumber peer = 0; peer < peer_count; ++peer)
        for (const Box& zone : division.zones_of(peer))
          owners += zone.low_x <= place.x() && place.x() < zone.high_x && zone.low_y <= place.y() &&
                    place.y() < zone.high_y;
      EXPECT_EQ(owners, 1);
      EXPECT_TRUE(division.is_near(division.owner_of(place), Box::around(place, {0.0, 0.0}), 0.0));
    }
  }
  const Division halves(field, {{{0, 0, 2, 2}, 0}, {{2, 0, 4, 2}, 1}}, 2);
  EXPECT_EQ(halves.owner_of({2.0, 1.0}), 1u);
  EXPECT_EQ(halves.owner_of({std::nextafter(2.0, 0.0), 1.0}), 0u);
}

TEST(Box, HoldsThePathThatItIsSweptBy) {
  Random random(11);
  for (int k = 0; k < 2000; ++k) {
    physics::Motion motion;
    for (int axis = 0; axis < 2; ++axis) {
      motion.position[axis] = uniform(random, -1.0, 1.0);
      motion.velocity[axis] = uniform(random, -3.0, 3.0);
      motion.acceleration[axis] = below(random, 3) == 0 ? 0.0 : uniform(random, -8.0, 8.0);
      motion.drag[axis] = below(random, 3) == 0 ? 0.0 : uniform(random, 0.0, 3.0);
    }
    const double begin = uniform(random, 0.0, 1.0), length = uniform(random, 0.0, 2.0);
    const Box box = swept(motion, begin, begin + length, {0.04, 0.04}).grown(1e-9);
    for (int i = 0; i <= 50; ++i)
      EXPECT_TRUE(
          box.holds(Box::around(motion.at(begin + length * i / 50.0).position, {0.04, 0.04})));
  }
}

TEST(Division, ByCountGivesAllPeersEquallyManyPlaces) {
  Random random(11);
  for (int k = 0; k < 50; ++k) {
    const auto peer_count = static_cast<PeerNumber>(2 + k % 15);
    std::vector<Vector2> places;
    for (int n = 0; n < 1000; ++n) {
      const double x = uniform(random, 0.0, 1.0);
      const double y = uniform(random, 0.0, 1.0);
      places.push_back({4.0 * x * x * x, 2.0 * y * y});
    }
    const Division division = Cuts::by_count(field, places, peer_count).division(peer_count);
    std::vector<int> counts(peer_count, 0);
    for (const Vector2& place : places) ++counts[division.owner_of(place)];
    for (const int count : counts)
      EXPECT_NEAR(count, 1000.0 / peer_count, 4.0) << peer_count << " peers";
  }
}

TEST(Division, ByCountOfPlacesThatCannotBeToldApartIsOneByArea) {
  for (const std::size_t count : {0, 1, 7}) {
    const Division division =
        Cuts::by_count(field, std::vector<Vector2>(count, Vector2(0.0, 0.0)), 5).division(5);
    for (PeerNumber peer = 0; peer < 5; ++peer) EXPECT_EQ(division.zones_of(peer).size(), 1u);
  }
}

}  // namespace
}  // namespace rink::peer::test
