// Peers cut off from each other by a modelled network for a while, in virtual time: who is too few
// halts, the others go on, and what they end with is what nobody disturbed.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <iostream>
#include <map>
#include <thread>

#include "tests/peer/fate.h"
#include "tests/peer/shared_scenes.h"
#include "tests/peer/virtual_mail.h"

namespace rink::peer::test {
namespace {

constexpr std::int64_t ms = 1'000'000;
constexpr std::uint64_t window_count = 30;
constexpr std::int64_t window_pace_ns = 50 * ms;  // of the network's clock
constexpr std::int64_t patience_ns = 300 * ms;

struct Outcomes {
  std::vector<Fate> fates;
  std::vector<std::string> messages;
  std::vector<std::vector<Handover>> ends;
  std::vector<SessionCounters> counters;
  std::vector<std::uint64_t> last_steps;
  std::int64_t end_ns = 0;

  std::size_t count(Fate fate) const {
    return static_cast<std::size_t>(std::count(fates.begin(), fates.end(), fate));
  }
};

/// One scene among peers who play a window every 50 ms of the network's clock.
class PartitionPlay {
 public:
  PartitionPlay(std::uint64_t scene, PeerNumber peer_count,
                const rti::NetworkConditions& conditions, const Cut& cut)
      : scene_number_(scene),
        peer_count_(peer_count),
        model_(conditions, cut),
        network_(model_),
        turns_(peer_count),
        start_(shared_scene(scene, window_length * static_cast<double>(window_count))),
        cuts_(Cuts::by_count(start_.world.spec().field, places(), peer_count)) {
    std::stable_sort(start_.keys.begin(), start_.keys.end(), [](const Key& a, const Key& b) {
      return a.time != b.time ? a.time < b.time : a.bat < b.bat;
    });
    for (PeerNumber number = 0; number < peer_count; ++number)
      mails_.emplace_back(network_, turns_, number, peer_count, patience_ns);
    outcomes_.fates.resize(peer_count, Fate::playing), outcomes_.messages.resize(peer_count),
        outcomes_.ends.resize(peer_count), outcomes_.counters.resize(peer_count);
    outcomes_.last_steps.resize(peer_count);
  }

  /// Until all have ended.
  const Outcomes& run() {
    for (VirtualMail& mail : mails_) mail.connect();
    while (!std::all_of(mails_.begin(), mails_.end(),
                        [](const VirtualMail& mail) { return mail.is_connected(); })) {
      network_.advance_to(network_.next_arrival_ns().value());
      for (VirtualMail& mail : mails_) mail.poll();
    }
    network_.advance_to(start_ns);
    {
      std::vector<std::jthread> threads;
      for (PeerNumber number = 0; number < peer_count_; ++number)
        threads.emplace_back([this, number] { live(number); });
      keep_time();
    }
    outcomes_.end_ns = network_.now_ns();
    return outcomes_;
  }
  /// Where windows begin; cuts count from here, too.
  static constexpr std::int64_t start_ns = 2'000 * ms;

  /// Of one engine that nobody disturbs.
  std::uint64_t truth() const {
    SharedScene alone =
        shared_scene(scene_number_, window_length * static_cast<double>(window_count));
    std::vector<Key> keys = start_.keys;
    for (const Key& key : keys) {
      if (key.time > window_length * static_cast<double>(window_count)) break;
      physics::test::RandomKeys::advance(alone.world, key.time);
      alone.world.set_thrust({key.bat}, key.thrust);
    }
    physics::test::RandomKeys::advance(alone.world,
                                       window_length * static_cast<double>(window_count));
    return alone.world.hash();
  }
  /// Nothing unless each body is one peer's.
  std::optional<std::uint64_t> hash_of(const std::vector<Handover>& parts) const {
    return hash_of_whole(start_.world.spec(), start_.world.body_count(), parts);
  }
  /// At each step that ever stood, nobody's body is another's too, and where all members were, each
  /// is somebody's.
  void expect_one_owner_each() const {
    for (const auto& [at, owners] : owners_) {
      for (const auto& [body, count] : owners.counts)
        ASSERT_EQ(count, 1) << "body " << body << " at step " << at.first << ", window "
                            << at.second;
      if (owners.peer_count == owners.member_count) {
        ASSERT_EQ(owners.counts.size(), start_.world.body_count()) << "at step " << at.first;
      }
    }
  }

 private:
  struct Owners {
    std::size_t peer_count = 0, member_count = 0;
    std::map<std::uint32_t, int> counts;
  };

  std::vector<Vector2> places() const {
    std::vector<Vector2> all;
    for (std::uint32_t body = 0; body < start_.world.body_count(); ++body)
      all.push_back(start_.world.position({body}));
    return all;
  }

  /// From one instant at which something comes, or somebody has waited long enough, to the next.
  void keep_time() {
    for (bool is_first = true;; is_first = false) {
      std::int64_t next_ns =
          network_.next_arrival_ns().value_or(std::numeric_limits<std::int64_t>::max());
      bool is_over = true;
      for (PeerNumber number = 0; number < peer_count_; ++number) {
        const bool has_news = mails_[number].poll();
        if (turns_.is_over(number)) continue;
        if (is_first || has_news || turns_.wake_ns(number) <= network_.now_ns()) turns_.run(number);
        if (turns_.is_over(number)) continue;
        is_over = false;
        next_ns = std::min(next_ns, turns_.wake_ns(number));
      }
      if (is_over) return;
      next_ns = std::min(next_ns, network_.next_arrival_ns().value_or(next_ns));
      network_.advance_to(std::max(network_.now_ns(), next_ns));
    }
  }

  void live(PeerNumber number) {
    turns_.await_first(number);
    std::unique_ptr<Session> session;
    VirtualMail& mail = mails_[number];
    try {
      SessionSettings settings{.number = number,
                               .peer_count = peer_count_,
                               .halo = 0.2,
                               .window_count = window_count,
                               .end_of = {}};
      settings.end_of = [](std::uint64_t k) { return window_length * static_cast<double>(k); };
      settings.keys = start_.keys;
      session = std::make_unique<Session>(start_.world, cuts_, std::move(settings), mail);
      while (!session->is_over()) {
        mail.rest_until(start_ns + window_pace_ns * static_cast<std::int64_t>(session->window()));
        session->advance();
        note_owners(*session);
        outcomes_.last_steps[number] = session->step();
      }
      outcomes_.ends[number] = session->end();
      outcomes_.fates[number] = Fate::done;
      mail.leave(true);
    } catch (const Halt& halt) {
      outcomes_.fates[number] = Fate::halted;
      outcomes_.messages[number] = halt.what();
      mail.leave(false);
    }
    if (session) outcomes_.counters[number] = session->counters();
    turns_.end(number);
  }

  /// One thread runs at a time.
  void note_owners(const Session& session) {
    Owners& owners = owners_[{session.step(), session.window()}];
    ++owners.peer_count, owners.member_count = session.members().size();
    for (const std::uint32_t body : session.peer().owned()) ++owners.counts[body];
  }

  std::uint64_t scene_number_;
  PeerNumber peer_count_;
  CutNetwork model_;
  rti::VirtualNetwork network_;
  Turns turns_;
  SharedScene start_;
  Cuts cuts_;
  std::deque<VirtualMail> mails_;
  std::map<std::pair<std::uint64_t, std::uint64_t>, Owners> owners_;
  Outcomes outcomes_;
};

rti::NetworkConditions conditions_of(std::uint64_t seed, double loss) {
  rti::LinkConditions line{.latency_ns = 5 * ms, .jitter_ns = ms};
  line.loss = rti::PacketLoss::independent(loss);
  return {
      .seed = seed, .to_listener = line, .from_listener = line, .exceptions = {}, .partitions = {}};
}

/// Fewer than half of them, or half without the first.
std::function<bool(PeerNumber)> some_minority(Random& random, PeerNumber peer_count) {
  for (;;) {
    const std::uint64_t mask = 1 + below(random, (1u << peer_count) - 2);
    const auto count = static_cast<PeerNumber>(std::popcount(mask));
    if (2 * count < peer_count || (2 * count == peer_count && (mask & 1) == 0))
      return [mask](PeerNumber peer) { return (mask >> peer & 1) != 0; };
  }
}

Cut some_cut(Random& random, PeerNumber peer_count, std::int64_t shortest_ms,
             std::int64_t longest_ms) {
  Cut cut{.from_ns = PartitionPlay::start_ns + static_cast<std::int64_t>(below(random, 1200)) * ms,
          .is_minority = some_minority(random, peer_count)};
  cut.until_ns =
      cut.from_ns +
      (shortest_ms + static_cast<std::int64_t>(
                         below(random, static_cast<std::uint32_t>(longest_ms - shortest_ms)))) *
          ms;
  return cut;
}

/// Nobody of whom is the mirror of another: then the others have all that is needed to go on.
bool is_mirrored_beyond(const std::function<bool(PeerNumber)>& is_minority, PeerNumber peer_count) {
  for (PeerNumber peer = 0; peer < peer_count; ++peer)
    if (is_minority(peer) && is_minority((peer + 1) % peer_count)) return false;
  return true;
}

TEST(Partition, HaltsTheMinorityAndTheOthersEndAsIfUndisturbed) {
  std::size_t done = 0, halted = 0;
  for (std::uint64_t seed = 0; seed < 16 && !HasFailure(); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    const PeerNumber peer_count = 3 + below(random, 4);
    Cut cut = some_cut(random, peer_count, 1000,
                       1500);  // over three patiences, and healed while the others play
    while (!is_mirrored_beyond(cut.is_minority, peer_count))
      cut.is_minority = some_minority(random, peer_count);
    PartitionPlay play(below(random, 10) + 10 * seed, peer_count, conditions_of(seed, 0.0), cut);
    const Outcomes& outcomes = play.run();
    play.expect_one_owner_each();
    for (PeerNumber peer = 0; peer < peer_count; ++peer) {
      SCOPED_TRACE("peer " + std::to_string(peer) + ": " + outcomes.messages[peer]);
      if (cut.is_minority(peer)) {
        EXPECT_EQ(outcomes.fates[peer], Fate::halted);
        EXPECT_THAT(outcomes.messages[peer],
                    testing::AnyOf(testing::HasSubstr("it halts, for the others may go on"),
                                   testing::HasSubstr("it halts, others may go on")));
      } else {
        EXPECT_EQ(outcomes.fates[peer], Fate::done);
        EXPECT_GT(outcomes.counters[peer].recoveries, 0u);
        EXPECT_EQ(play.hash_of(outcomes.ends[peer]), play.truth());
      }
    }
    done += outcomes.count(Fate::done), halted += outcomes.count(Fate::halted);
  }
  std::cout << done << " peers went on, " << halted << " halted\n";
  EXPECT_GT(done, halted);
}

TEST(Partition, ShorterThanThePatienceIsWaitedOut) {
  for (std::uint64_t seed = 0; seed < 8 && !HasFailure(); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    const PeerNumber peer_count = 3 + below(random, 4);
    PartitionPlay play(below(random, 10) + 10 * seed, peer_count, conditions_of(seed, 0.0),
                       some_cut(random, peer_count, 20, 150));
    const Outcomes& outcomes = play.run();
    EXPECT_EQ(outcomes.count(Fate::done), peer_count);
    play.expect_one_owner_each();
    for (PeerNumber peer = 0; peer < peer_count; ++peer) {
      EXPECT_EQ(outcomes.counters[peer].recoveries, 0u);
      EXPECT_EQ(play.hash_of(outcomes.ends[peer]), play.truth());
    }
  }
}

/// What was cut off comes late, in the middle of recoveries too, and segments are lost besides.
TEST(Partition, OfAnyLengthLeavesOneAuthorityAtMost) {
  std::size_t done = 0, halted = 0, divided = 0;
  for (std::uint64_t seed = 0; seed < 40 && !HasFailure(); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(1000 + seed);
    const PeerNumber peer_count = 3 + below(random, 4);
    PartitionPlay play(below(random, 10) + 10 * seed, peer_count,
                       conditions_of(seed, seed % 2 == 0 ? 0.0 : 0.002),
                       some_cut(random, peer_count, 100, 900));
    const Outcomes& outcomes = play.run();
    play.expect_one_owner_each();
    EXPECT_EQ(outcomes.count(Fate::playing), 0u);
    std::optional<std::vector<PeerNumber>> authority;
    for (PeerNumber peer = 0; peer < peer_count; ++peer) {
      if (outcomes.fates[peer] != Fate::done) continue;
      EXPECT_EQ(play.hash_of(outcomes.ends[peer]), play.truth());
      std::vector<PeerNumber> owners;
      for (PeerNumber other = 0; other < outcomes.ends[peer].size(); ++other)
        if (!outcomes.ends[peer][other].bodies.empty() ||
            !outcomes.ends[peer][other].free_flights.empty())
          owners.push_back(other);
      if (!authority) authority = owners;
      EXPECT_EQ(owners, *authority) << "peer " << peer;
    }
    done += outcomes.count(Fate::done), halted += outcomes.count(Fate::halted);
    divided += outcomes.count(Fate::done) > 0 && outcomes.count(Fate::halted) > 0;
  }
  std::cout << done << " peers went on, " << halted << " halted; " << divided
            << " of 40 cuts divided them\n";
  EXPECT_GT(divided, 10u);
  EXPECT_GT(done, halted);
}

TEST(Partition, GoesTheSameWayEachTime) {
  std::optional<Outcomes> first;
  for (int run = 0; run < 2; ++run) {
    Random random(5);
    PartitionPlay play(15, 5, conditions_of(5, 0.002), some_cut(random, 5, 600, 900));
    const Outcomes& outcomes = play.run();
    if (!first) first = outcomes;
    EXPECT_EQ(outcomes.fates, first->fates);
    EXPECT_EQ(outcomes.messages, first->messages);
    EXPECT_EQ(outcomes.last_steps, first->last_steps);
    EXPECT_EQ(outcomes.end_ns, first->end_ns);
  }
}

}  // namespace
}  // namespace rink::peer::test
