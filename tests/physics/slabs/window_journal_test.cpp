// Tiles write a journal as the plain loop writes it: the same entries in the same order, and the
// same states from before the window.
#include "game/physics/slabs/window_journal.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <random>
#include <vector>

#include "game/physics/world_journal.h"
#include "tests/physics/slab_journal.h"

namespace rink::physics::test {
namespace {

JournalPlay play(std::uint64_t seed, bool is_forced, bool is_match) {
  SCOPED_TRACE(testing::Message() << "seed " << seed << (is_forced ? ", forced" : "")
                                  << (is_match ? ", match" : ""));
  std::mt19937_64 random(seed + 77);
  const SlabPlan plan = small_tiles(4 + static_cast<int>(random() % 9), is_forced ? 0 : 1,
                                    is_forced ? uniform(random, 2.0, 12.0) : 1.0);
  const MatchScene match(seed);
  const SlabScene gas(seed);
  const World whole =
      is_match ? match.world(QueuePolicy::calendar) : gas.world(QueuePolicy::calendar);
  PartsBySlabs parts(whole, plan, seed);
  return parts.play(is_match ? match.duration : gas.duration, 4);
}

void play_many(std::uint64_t first, std::uint64_t last, bool is_match) {
  JournalPlay sum;
  SlabCounters forced;
  for (std::uint64_t seed = first; seed < last; ++seed) {
    const bool is_forced = seed % 2 == 0;
    const JournalPlay played = play(seed, is_forced, is_match);
    if (testing::Test::HasFatalFailure()) return;
    (is_forced ? forced : sum.slabs).windows += played.slabs.windows;
    (is_forced ? forced : sum.slabs).undone += played.slabs.undone;
    (is_forced ? forced : sum.slabs).late += played.slabs.late;
    sum.quiet += played.quiet, sum.entered += played.entered, sum.changes += played.changes;
  }
  EXPECT_GT(sum.slabs.windows, 2 * (last - first));
  EXPECT_LT(sum.slabs.undone, sum.slabs.windows / 2u);
  EXPECT_GT(forced.undone, 0u);
  EXPECT_GT(forced.late, 0u);
  EXPECT_GT(sum.quiet, 100u);
  EXPECT_GT(sum.entered, 100u);
  EXPECT_GT(sum.changes, 1000u);
}

TEST(WindowJournal, IsThatOfThePlainLoop) { play_many(1, 60, false); }
TEST(WindowJournal, IsThatOfThePlainLoopInMatches) { play_many(1, 40, true); }
TEST(WindowJournalLong, IsThatOfThePlainLoopInManyScenes) {
  play_many(1000, 1600, false);
  play_many(1000, 1300, true);
}

/// Of a whole world there are no rooms, and nobody undoes anything.
TEST(WindowJournal, OfAWholeWorldIsThatOfThePlainLoop) {
  std::uint64_t windows = 0;
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    const MatchScene scene(seed);
    World plain = scene.world(QueuePolicy::calendar),
          slabs = scene.world(QueuePolicy::windows, small_tiles(6, 1, 1.0));
    WorldJournal of_plain, of_slabs;
    of_plain.observe(plain), of_slabs.observe(slabs);
    for (int stop = 1; stop <= 3; ++stop) {
      while (plain.advance(scene.duration * stop / 3)) {
      }
      while (slabs.advance(scene.duration * stop / 3)) {
      }
      expect_same(slabs, plain);
      ASSERT_EQ(of_slabs.changes().size(), of_plain.changes().size());
      for (std::size_t k = 0; k < of_plain.changes().size(); ++k) {
        expect_same(of_slabs.changes()[k], of_plain.changes()[k]);
        if (HasFatalFailure()) return;
      }
    }
    windows += slabs.counters().slabs.windows;
    WorldJournal::detach(plain), WorldJournal::detach(slabs);
  }
  EXPECT_GT(windows, 50u);
}

}  // namespace
}  // namespace rink::physics::test
