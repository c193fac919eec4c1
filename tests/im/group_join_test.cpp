// Eight askers at a time find what brute force finds, whatever the instructions.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <set>
#include <vector>

#include "im/matching/group_join.h"
#include "im/matching/short_sort.h"
#include "tests/im/layouts.h"
#include "tests/im/recount.h"

namespace rink::im {
namespace {

using Motions = std::vector<Motion>;
constexpr Region field{0.0, 0.0, side, side};

/// One in ten is new.
Motions draw(const Layout& layout, Random& random, std::size_t count, double half_max) {
  Motions motions(count);
  for (Motion& motion : motions) {
    const Region before = layout.draw(random, half_max);
    if (between(random, 0.0, 1.0) < 0.9) motion.before = before;
    motion.now = moved(random, before, layout, half_max);
  }
  return motions;
}

void bin(const Motions& motions, BoxIndex& index) {
  index.begin(field, motions.size(), Boxes::moving_for_groups);
  for (std::uint32_t id = 0; id < motions.size(); ++id) index.stage(id, motions[id]);
  index.build();
}

/// Ordered: the asker's id, and below it the found id with its change.
std::vector<std::uint64_t> recount(const Motions& askers, const Motions& asked) {
  std::vector<std::uint64_t> changes;
  for (std::uint64_t s = 0; s < askers.size(); ++s)
    for (std::uint32_t e = 0; e < asked.size(); ++e) {
      const bool was = overlap_closed(askers[s].before, asked[e].before),
                 is = overlap_closed(askers[s].now, asked[e].now);
      if (was != is) changes.push_back(s << 32 | found_change(e, is));
    }
  std::sort(changes.begin(), changes.end());
  return changes;
}

struct Exact {
  const Motions &askers, &asked;
};
Verdict judge(const void* context, std::uint32_t asker, std::uint32_t asked) {
  const auto& exact = *static_cast<const Exact*>(context);
  const Motion &a = exact.askers[asker], &b = exact.asked[asked];
  const bool was = overlap_closed(a.before, b.before), is = overlap_closed(a.now, b.now);
  return was == is ? Verdict::no : is ? Verdict::entered : Verdict::match;
}

std::vector<std::uint64_t> found_by(Instructions instructions, const Motions& askers,
                                    const Motions& asked) {
  BoxIndex index, asking;
  bin(asked, index), bin(askers, asking);
  const Exact exact{askers, asked};
  GroupJoin join(instructions);
  join.add_changes(index, asking, {!(index.is_exact() && asking.is_exact()), judge, &exact});
  std::vector<std::uint64_t> changes;
  join.for_each_asker([&](std::uint64_t asker, std::span<const std::uint32_t> found) {
    EXPECT_TRUE(std::is_sorted(found.begin(), found.end()) && !found.empty());
    for (const std::uint32_t each : found) changes.push_back(asker << 32 | each);
  });
  std::sort(changes.begin(), changes.end());
  EXPECT_EQ(join.found_count(), changes.size());
  EXPECT_LE(join.found_count(), join.candidate_count());
  return changes;
}

TEST(GroupJoin, FindsTheChangesOfBruteForceInEveryLayout) {
  Random random(1);
  for (const Layout& layout : layouts)
    for (const std::size_t askers : {1u, 7u, 8u, 9u, 300u})
      for (const std::size_t asked : {1u, 15u, 700u}) {
        SCOPED_TRACE(std::string(layout.name) + ", " + std::to_string(askers) + " ask about " +
                     std::to_string(asked));
        const Motions some = draw(layout, random, askers, 1.0),
                      others = draw(layout, random, asked, 0.2);
        const auto truth = recount(some, others);
        EXPECT_EQ(found_by(Instructions::best, some, others), truth);
        EXPECT_EQ(found_by(Instructions::scalar, some, others), truth);
      }
}

/// Whole numbers and large ones tie wherever they touch, and there single precision is in doubt.
TEST(GroupJoin, DecidesTouchingExactly) {
  Motions askers, asked;
  for (int i = 0; i < 40; ++i) {
    const double x = 0.1 * i, step = i % 3 == 0 ? 0x1p-40 : 0.0;
    askers.push_back({{x, 0.0, x + 0.1, 1.0}, {x + step, 0.0, x + 0.1 + step, 1.0}});
    asked.push_back({{x + 0.1, 0.5, x + 0.2, 0.5}, {x + 0.1 - step, 0.5, x + 0.2, 0.5}});
  }
  const auto truth = recount(askers, asked);
  EXPECT_GT(truth.size(), 10u);
  EXPECT_EQ(found_by(Instructions::best, askers, asked), truth);
  EXPECT_EQ(found_by(Instructions::scalar, askers, asked), truth);
}

/// Neighbours share a look at the same cells; who is far away from the one before does not widen
/// it, so that looking at all boxes stays the exception.
TEST(GroupJoin, LooksAtFewMoreBoxesThanEachAskerAlone) {
  Random random(2);
  constexpr std::size_t count = 20'000;
  Motions askers(count), asked(count);
  for (Motions* motions : {&askers, &asked})
    for (Motion& motion : *motions) {
      motion.before = around(between(random, 0.0, side), between(random, 0.0, side),
                             0.25 * side / std::sqrt(count));
      motion.now = motion.before;
      motion.now.low_x += 1e-3, motion.now.high_x += 1e-3;
    }
  BoxIndex index, asking;
  bin(asked, index), bin(askers, asking);
  const Exact exact{askers, asked};
  GroupJoin join(Instructions::best);
  join.add_changes(index, asking, {true, judge, &exact});
  EXPECT_LT(join.candidate_count(), 60 * count);  // 1 of which each overlaps
}

TEST(ShortSort, OrdersAnyNumberOfNumbers) {
  Random random(3);
  Buffer<std::uint32_t> spare;
  for (const std::uint32_t below : {0x100u, 0x30000u, 0xffffffffu})
    for (std::size_t count = 0; count < 250; ++count) {
      std::set<std::uint32_t> different;
      while (different.size() < std::min<std::size_t>(count, below))
        different.insert(static_cast<std::uint32_t>(random()) % below);
      std::vector<std::uint32_t> numbers(different.begin(), different.end()), sorted = numbers;
      std::shuffle(numbers.begin(), numbers.end(), random);
      sort_short(numbers, spare);
      ASSERT_EQ(numbers, sorted);
    }
}

}  // namespace
}  // namespace rink::im
