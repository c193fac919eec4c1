// Agreement up and down a tree: the same results as from each to each, by few messages; whoever is
// killed, cut off, comes or leaves in the middle of it, one part at most goes on.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <iostream>
#include <set>

#include "game/peer/verdict_tree.h"
#include "tests/peer/many/counted_sessions.h"
#include "tests/peer/session_play.h"

namespace rink::peer::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr std::size_t always = 2, never = 1000;

TEST(VerdictTree, ReachesEverybodyOnceInTwoLevels) {
  for (std::size_t count = 1; count <= 64; ++count) {
    const VerdictTree tree(count);
    std::multiset<std::size_t> reached{0};
    for (std::size_t place = 0; place < count; ++place) {
      const std::vector<std::size_t> children = tree.children(place);
      EXPECT_LE(children.size(), 8u);
      for (const std::size_t child : children) {
        EXPECT_EQ(tree.parent(child), place);
        reached.insert(child);
      }
      std::set<std::size_t> branch{place};  // by the definition, from below
      for (std::size_t below = place + 1; below < count; ++below)
        if (branch.contains(tree.parent(below))) branch.insert(below);
      EXPECT_TRUE(std::ranges::equal(tree.branch(place), branch)) << count << ", " << place;
    }
    EXPECT_EQ(reached.size(), count);
    EXPECT_EQ((std::set<std::size_t>(reached.begin(), reached.end()).size()), count);
    EXPECT_LE(tree.depth(), 2u) << count;
  }
  EXPECT_EQ(VerdictTree(21).degree(), 4u);
  EXPECT_EQ(VerdictTree(64).degree(), 8u);
  EXPECT_THAT(VerdictTree(8).branch(1), ElementsAre(1u, 5u, 6u, 7u));
}

TEST(VerdictBundle, ComesBackAsItWasSaid) {
  VerdictBundle bundle{.is_decision = true, .window = 300};
  bundle.verdicts.resize(3);
  bundle.verdicts[0].accepts = true, bundle.verdicts[0].halo = 0.25f;
  bundle.verdicts[1].goals = {{0.5, 7, true}};
  bundle.verdicts[2].events = 1000, bundle.verdicts[2].listed = {1, 2, 3};
  for (Verdict& verdict : bundle.verdicts) verdict.window = 300;
  const std::vector<std::uint8_t> bytes = written(bundle);
  VerdictBundle back;
  ASSERT_TRUE(read(bytes, back));
  EXPECT_EQ(written(back), bytes);
  for (std::size_t k = 0; k < 3; ++k)
    EXPECT_EQ(written(back.verdicts[k]), written(bundle.verdicts[k])) << k;
  bundle.verdicts.resize(65);
  EXPECT_EQ(bundle.verdicts.size(), VerdictBundle::verdicts_max + 1);
  Verdict verdict;
  EXPECT_FALSE(read(bytes, verdict)) << "it is no verdict";
}

TEST(TreeAgreement, PlaysWhatOneEnginePlaysByFewerMessages) {
  for (const PeerNumber peer_count : {3u, 6u, 12u}) {
    std::array<std::uint64_t, 2> messages{}, bytes{};
    for (const bool is_by_tree : {false, true}) {
      SharedScene scene = shared_scene(0, 0.3);
      const CountedRun run = counted_run(scene.world, {.node_count = peer_count,
                                                       .window = window_length,
                                                       .halo = 0.2,
                                                       .warm_up = 4,
                                                       .windows = 16,
                                                       .tree_from = is_by_tree ? always : never});
      physics::test::RandomKeys::advance(scene.world, 20.0 * window_length);
      for (PeerNumber peer = 0; peer < peer_count; ++peer)
        EXPECT_EQ(hash_of_whole(scene.world.spec(), scene.world.body_count(), run.ends[peer]),
                  scene.world.hash())
            << peer;
      for (const NodeCost& node : run.nodes)
        messages[is_by_tree] += node.agreement_messages, bytes[is_by_tree] += node.agreement_bytes;
    }
    const std::uint64_t rounds = messages[0] / (peer_count * (peer_count - 1));
    EXPECT_GE(rounds, 16u);
    EXPECT_EQ(messages[0], rounds * peer_count * (peer_count - 1));
    EXPECT_EQ(messages[1], rounds * 2 * (peer_count - 1));
    std::cout << peer_count << " peers agree " << rounds << " times by " << messages[0]
              << " messages of " << bytes[0] << " B, or up and down a tree by " << messages[1]
              << " of " << bytes[1] << " B\n";
  }
}

TEST(TreeAgreement, GoesOnWhereverInTheProtocolAPeerIsKilled) {
  std::uint64_t recoveries = 0;
  for (std::uint64_t seed = 0; seed < 60 && !HasFailure(); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    const PeerNumber peer_count = 3 + below(random, 7), victim = below(random, peer_count);
    const std::uint64_t last_word = 1 + below(random, 12 * 12);
    Play play(below(random, 10) + 10 * seed, peer_count, 12);
    play.tree_from = 2 + seed % 4;  // a loss may lead to agreement from each to each
    play.balance_windows = static_cast<std::uint32_t>(seed % 3);
    play.before_word = [&](End peer, std::uint64_t word) {
      if (peer != victim || word != last_word) return;
      play.office().kill(victim);
      throw Killed();
    };
    play.run();
    EXPECT_EQ(play.count(Fate::killed) + play.count(Fate::done), peer_count);
    EXPECT_GE(play.count(Fate::done), peer_count - 1);
    expect_whole(play);
    for (const SessionCounters& counters : play.counters) recoveries += counters.recoveries;
  }
  std::cout << recoveries << " recoveries\n";
  EXPECT_GT(recoveries, 100u);
}

TEST(TreeAgreement, LetsPeersJoinAndLeave) {
  std::size_t joined = 0;
  for (std::uint64_t seed = 0; seed < 16 && !HasFailure(); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    const PeerNumber peer_count = 4 + below(random, 4);
    Play play(below(random, 10) + 10 * seed, peer_count, 24);
    play.tree_from = peer_count + seed % 2;
    const End leaver = below(random, peer_count);
    play.before_window = [&](Session& session, End peer) {
      if (peer == 0 && session.window() == 3) play.invite(1 % peer_count);
      if (peer == leaver && session.window() >= 12) session.leave();
    };
    play.run();
    expect_whole(play);
    EXPECT_EQ(play.fates[leaver], Fate::left);
    joined += play.fates[peer_count] == Fate::done;
  }
  EXPECT_GT(joined, 12u);
}

/// Whose bodies those that a peer ended with were.
std::vector<PeerNumber> owners_of(const std::vector<Handover>& parts) {
  std::vector<PeerNumber> owners;
  for (PeerNumber peer = 0; peer < parts.size(); ++peer)
    if (!parts[peer].bodies.empty() || !parts[peer].free_flights.empty()) owners.push_back(peer);
  return owners;
}

/// A few pucks: what counts here is who goes on.
SharedScene sparse_scene(std::uint64_t number, double) {
  Random random(number + 1);
  SharedScene scene{physics::World(physics::test::rink_of(4.0, 2.0)), {}};
  physics::test::scatter_pucks(scene.world, random, 24, 0.05, 2.0);
  return scene;
}

struct StormEnds {
  std::size_t done = 0, halted = 0, divided = 0;
  std::uint64_t recoveries = 0;
};

/// Of a number each bit of which is a peer: without those whose standby is among them, too.
std::uint64_t without_neighbours(std::uint64_t side, PeerNumber peer_count) {
  for (PeerNumber peer = 0; peer < peer_count; ++peer)
    if ((side >> peer & 1) != 0 && (side >> ((peer + 1) % peer_count) & 1) != 0)
      side &= ~(std::uint64_t{1} << peer);
  return side;
}

/// Up to three cuts, each at any word of anybody and between any sides, of which some let words
/// through in one direction; nobody has ended yet when they fall. After every other storm all that
/// is needed to go on is left on one side.
void let_storm(std::uint64_t seed, StormEnds& storm) {
  SCOPED_TRACE("seed " + std::to_string(seed));
  constexpr std::uint64_t window_count = 7;
  Random random(seed);
  const PeerNumber peer_count = 3 + below(random, 7);
  struct StormCut {
    std::uint64_t word, side;
    bool is_one_way;
  };
  std::vector<StormCut> cuts(1 + below(random, 3));
  std::uint64_t word = 0;
  for (StormCut& cut : cuts) {
    word += 1 + below(random, (cuts.size() == 1 ? 60 : 30) * peer_count);
    cut = {word, 1 + below(random, (1u << peer_count) - 2), below(random, 3) == 0};
    if (seed % 2 == 0) cut.side = without_neighbours(cut.side, peer_count);
  }
  std::atomic<std::uint64_t> words = 0;
  std::atomic<bool> is_late = false;
  Play play(seed, peer_count, window_count, sparse_scene);
  play.tree_from = seed % 8 == 7 ? never : 2 + below(random, 4);
  play.office().patience = std::chrono::seconds(20);
  play.before_window = [&](Session& session, End) {
    if (session.window() + 3 >= window_count) is_late = true;
  };
  play.before_word = [&](End, std::uint64_t) {
    const std::uint64_t now = ++words;
    for (const StormCut& cut : cuts) {
      if (cut.word != now || is_late) continue;
      const auto is_one = [&](End peer) { return peer < 32 && (cut.side >> peer & 1) != 0; };
      cut.is_one_way ? play.office().mute(is_one) : play.office().cut_off(is_one);
    }
  };
  play.run();
  expect_whole(play);
  std::optional<std::vector<PeerNumber>> authority;
  for (PeerNumber peer = 0; peer < peer_count; ++peer) {
    EXPECT_NE(play.fates[peer], Fate::playing);
    storm.recoveries += play.counters[peer].recoveries;
    if (play.fates[peer] != Fate::done || play.may_have_split[peer]) continue;
    if (!authority) authority = owners_of(play.ends[peer]);
    EXPECT_EQ(owners_of(play.ends[peer]), *authority)
        << "two parts end with status 0: " << peer << " and another";
  }
  storm.done += play.count(Fate::done), storm.halted += play.count(Fate::halted);
  storm.divided += play.count(Fate::done) > 0 && play.count(Fate::halted) > 0;
}

void let_storms(std::uint64_t first, std::uint64_t count) {
  StormEnds storm;
  for (std::uint64_t seed = first; seed < first + count && !testing::Test::HasFailure(); ++seed)
    let_storm(seed, storm);
  std::cout << storm.done << " peers went on, " << storm.halted << " halted; " << storm.divided
            << " of " << count << " storms divided them; " << storm.recoveries << " recoveries\n";
  EXPECT_GT(storm.divided, count / 10);
}

TEST(PartitionStorm, LeavesOneAuthorityAtMost) { let_storms(0, 300); }

class PartitionStormLong : public testing::TestWithParam<std::uint64_t> {};
TEST_P(PartitionStormLong, LeavesOneAuthorityAtMost) { let_storms(1000 * (1 + GetParam()), 1000); }
INSTANTIATE_TEST_SUITE_P(Part, PartitionStormLong, testing::Range<std::uint64_t>(0, 4));

/// Peer 1 of nine has 5 to 8 below it.
constexpr PeerNumber nine = 9;
constexpr End relay = 1;

/// `change` makes another of a bundle that the relay passes on from window 4 on; `restore`, of one
/// that it receives.
void play_with_liar(
    Play& play, const std::function<bool(VerdictBundle&)>& change,
    const std::function<bool(VerdictBundle&)>& restore = [](VerdictBundle&) { return false; }) {
  play.tree_from = always;
  play.office().patience = std::chrono::seconds(5);
  const auto changed = [](const std::function<bool(VerdictBundle&)>& how) {
    return [how](End peer, std::vector<std::uint8_t>& bytes) {
      VerdictBundle bundle;
      if (peer != relay || !read(bytes, bundle) || bundle.window < 4) return;
      if (how(bundle)) bytes = written(std::move(bundle));
    };
  };
  play.on_the_way = changed(change), play.on_arrival = changed(restore);
  play.run();
}

/// All but the liar, and perhaps some who go with it, have ended as one part, with the truth.
void expect_one_part(Play& play, std::size_t at_least) {
  std::optional<std::vector<PeerNumber>> authority;
  std::size_t done = 0;
  for (PeerNumber peer = 0; peer < nine; ++peer) {
    if (peer == relay || play.fates[peer] != Fate::done) continue;
    ++done;
    if (!authority) authority = owners_of(play.ends[peer]);
    EXPECT_EQ(owners_of(play.ends[peer]), *authority);
    EXPECT_THAT(play.lost[peer], testing::Contains(PeerNumber{relay}));
  }
  EXPECT_GE(done, at_least);
  for (PeerNumber peer = 0; peer < nine && done < at_least; ++peer)
    std::cout << peer << ": " << play.messages[peer] << " | " << play.last_losses[peer] << '\n';
  expect_whole(play);
}

/// In its own run the relay has what is true, so it does not see its lie itself.
TEST(TreeAgreement, NamesTheRelayThatChangesWhatABranchSays) {
  Play play(0, nine, 10);
  const auto lie = [](VerdictBundle& bundle) {
    bundle.verdicts[bundle.is_decision ? 5 : 1].events += 5;  // of peer 5
    return true;
  };
  const auto restore = [](VerdictBundle& bundle) {
    if (bundle.is_decision) bundle.verdicts[5].events -= 5;
    return bundle.is_decision;
  };
  play_with_liar(play, lie, restore);
  expect_one_part(play, nine - 1);
  EXPECT_THAT(play.last_losses[5], HasSubstr("peer 1 "));
}

TEST(TreeAgreement, NamesTheRelayThatPassesOnWhatCannotBe) {
  for (const bool is_decision : {false, true}) {
    Play play(0, nine, 10);
    play_with_liar(play, [&](VerdictBundle& bundle) {
      if (bundle.is_decision != is_decision) return false;
      bundle.verdicts[1].goals = {{0.05, 4'000'000'000, true}};
      return true;
    });
    expect_one_part(play, nine - 1);
    for (PeerNumber peer = 0; peer < nine; ++peer)
      if (peer != relay) {
        EXPECT_THAT(play.lost[peer], ElementsAre(PeerNumber{relay}));
      }
  }
}

/// It tells those below that others do not accept, so they repeat a window that is final for these.
TEST(TreeAgreement, NamesTheRelayThatChangesADecision) {
  Play play(0, nine, 10);
  play_with_liar(play, [](VerdictBundle& bundle) {
    if (!bundle.is_decision) return false;
    for (const std::size_t other : {0, 2, 3})
      bundle.verdicts[other].accepts = false, bundle.verdicts[other].halo = 0.5f;
    return true;
  });
  expect_one_part(play, nine - 1);
}

}  // namespace
}  // namespace rink::peer::test
