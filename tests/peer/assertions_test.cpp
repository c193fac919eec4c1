// What the parts of a shared simulation assert of each other: a wrong argument ends the program,
// with the condition that it broke.
#include <gtest/gtest.h>

#include "game/peer/cuts.h"
#include "game/peer/session/scoring.h"
#include "tests/peer/shared_scenes.h"

namespace rink::peer::test {
namespace {

#ifndef NDEBUG

TEST(PeerDeathTest, NamesWhatIsWrongWithZones) {
  const Cuts cuts = Cuts::by_count(field, {}, 2);
  EXPECT_DEATH(cuts.division(2).zones_of(2), "peer < peer_count_");
  EXPECT_DEATH(Cuts::by_count(field, {}, 0), "peer_count > 0");
  EXPECT_DEATH(cuts.without(2), "has\\(peer\\)");
  EXPECT_DEATH(cuts.balanced(std::vector<double>{1.0}, 1.1), "back\\(\\) < loads.size");
}

TEST(PeerDeathTest, NamesWhatIsWrongWithMessagesAndFaceOffs) {
  EXPECT_DEATH(Head({true, true, true, true, true, true, true, true}), "parts.size\\(\\) <= 7");
  Scoring over{.is_over = true, .face_offs = {}};
  EXPECT_DEATH(over.schedule({.time = 1.0}), "!is_over");
  EXPECT_DEATH(over.count({}, {.goals_to_win = 0, .places = {}}), "goals_to_win > 0");
}

#endif

}  // namespace
}  // namespace rink::peer::test
