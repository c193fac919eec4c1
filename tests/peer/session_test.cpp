// Peers that die, are cut off, or leave: whoever is left has the states of one engine, every double of them, at every window.
#include <gtest/gtest.h>

#include <atomic>
#include <iostream>
#include <map>
#include <thread>

#include "game/peer/session.h"
#include "tests/peer/lossy_mail.h"
#include "tests/peer/shared_scenes.h"

namespace rink::peer::test {
namespace {

constexpr double window_length = 0.01;

enum class Fate : std::uint8_t { playing, done, killed, halted, left };

/// One scene among peers in threads, with whatever befalls them.
class Play {
 public:
  Play(std::uint64_t number, PeerNumber peer_count, std::uint64_t window_count)
      : number_(number), peer_count_(peer_count), window_count_(window_count), scene_(shared_scene(number, window_length * static_cast<double>(window_count))),
        cuts_(Cuts::by_count(scene_.world.spec().field, places(), peer_count)), office_(peer_count), fates(peer_count, Fate::playing), ends(peer_count), counters(peer_count), messages(peer_count) {
    std::stable_sort(scene_.keys.begin(), scene_.keys.end(), [](const Key& a, const Key& b) { return a.time != b.time ? a.time < b.time : a.bat < b.bat; });
  }

  /// Told the number of the peer and of its word.
  std::function<void(PeerNumber, std::uint64_t)> before_word = [](PeerNumber, std::uint64_t) {};
  /// Told before each advance.
  std::function<void(Session&, PeerNumber)> before_window = [](Session&, PeerNumber) {};
  bool is_live = false;
  std::uint32_t balance_windows = 0;

  void run() {
    const SharedScene start = shared_scene(number_, window_length * static_cast<double>(window_count_));
    if (is_live) scene_.keys.clear();
    else find_truth();
    std::vector<std::jthread> threads;
    for (PeerNumber number = 0; number < peer_count_; ++number) threads.emplace_back([&, number] { play(start.world, number); });
  }
  /// By one engine, with everybody's logs.
  std::uint64_t replayed(const std::vector<Arrivals>& parts) {
    for (const Arrivals& part : parts) scene_.keys.insert(scene_.keys.end(), part.keys.begin(), part.keys.end());
    std::stable_sort(scene_.keys.begin(), scene_.keys.end(), [](const Key& a, const Key& b) { return a.time != b.time ? a.time < b.time : a.bat < b.bat; });
    find_truth();
    return scene_.world.hash();
  }
  std::uint64_t truth() const { return scene_.world.hash(); }
  std::size_t key_count() const { return scene_.keys.size(); }
  std::uint64_t hash_of(const std::vector<Arrivals>& parts) const { return hash_of_whole(scene_.world.spec(), scene_.world.body_count(), parts).value_or(0); }
  LossyOffice& office() { return office_; }
  std::size_t count(Fate fate) const { return static_cast<std::size_t>(std::count(fates.begin(), fates.end(), fate)); }

 private:
  std::vector<Vector2> places() const {
    std::vector<Vector2> all;
    for (std::uint32_t body = 0; body < scene_.world.body_count(); ++body) all.push_back(scene_.world.position({body}));
    return all;
  }

  void find_truth() {
    std::size_t next = 0;
    for (std::uint64_t window = 1; window <= window_count_; ++window) {
      const double until = window_length * static_cast<double>(window);
      for (; next < scene_.keys.size() && scene_.keys[next].time <= until; ++next) {
        physics::test::RandomKeys::advance(scene_.world, scene_.keys[next].time);
        scene_.world.set_thrust({scene_.keys[next].bat}, scene_.keys[next].thrust);
      }
      physics::test::RandomKeys::advance(scene_.world, until);
      for (std::uint32_t body = 0; body < scene_.world.body_count(); ++body) states_[{window, body}] = bytes_of(physics::Portion::state_in(scene_.world, body));
    }
  }

  void play(const physics::World& start, PeerNumber number) {
    LossyMail mail(office_, number, [&](std::uint64_t word) { before_word(number, word); });
    SessionSettings settings{.number = number, .peer_count = peer_count_, .halo = 0.2, .window_count = window_count_, .end_of = [](std::uint64_t k) { return window_length * static_cast<double>(k); }};
    settings.keys = scene_.keys;
    settings.balance_windows = balance_windows;
    if (is_live)
      for (std::uint32_t body = 0; body < start.body_count(); ++body)
        if (start.kind({body}) == physics::BodyKind::bat) settings.seats.push_back({.bat = body, .peer = body % peer_count_, .period = 0.02, .phase = 0.001 * body, .puck_count = 2});
    Session session(start, cuts_, settings, mail);
    Random random(number_ * 64 + number);
    try {
      while (!session.is_over()) {
        before_window(session, number);
        session.advance();
        if (!is_live) expect_truth(session);
        for (const Glimpse& glimpse : session.peer().glimpses()) {
          const double x = static_cast<double>(below(random, 3)) - 1.0;
          session.press(glimpse, {glimpse.bat, Vector2(x, 0.5) * 6.0, static_cast<std::uint8_t>(1 + below(random, 200))});
        }
      }
      fates[number] = session.has_left() ? Fate::left : Fate::done;
      if (!session.has_left()) ends[number] = session.end();
    } catch (const Killed&) {
      fates[number] = Fate::killed;
      return;
    } catch (const Halt& halt) {
      fates[number] = Fate::halted;
      messages[number] = halt.what();
    }
    counters[number] = session.counters();
    office_.finish(number);
  }

  void expect_truth(Session& session) {
    if (session.window() == 0) return;
    for (const std::uint32_t body : session.peer().owned())
      EXPECT_TRUE(bytes_of(session.peer().state(body)) == states_.at({session.window(), body})) << "peer " << session.peer().number() << ", window " << session.window() << ", body " << body;
  }

  std::uint64_t number_;
  PeerNumber peer_count_;
  std::uint64_t window_count_;
  SharedScene scene_;
  Cuts cuts_;
  LossyOffice office_;
  std::map<std::pair<std::uint64_t, std::uint32_t>, std::vector<std::uint8_t>> states_;

 public:
  std::vector<Fate> fates;
  std::vector<std::vector<Arrivals>> ends;
  std::vector<SessionCounters> counters;
  std::vector<std::string> messages;
};

void expect_whole(Play& play) {
  for (const std::vector<Arrivals>& parts : play.ends)
    EXPECT_TRUE(parts.empty() || play.hash_of(parts) == play.truth());
}

TEST(Session, HasTheStatesOfOneEngineWithoutALoss) {
  for (const std::uint64_t number : {0, 2, 6, 7}) {
    Play play(number, 3, 20);
    play.run();
    EXPECT_EQ(play.count(Fate::done), 3u);
    expect_whole(play);
    for (const SessionCounters& counters : play.counters) EXPECT_EQ(counters.recoveries, 0u);
  }
}

TEST(Session, GoesOnWhereverInTheProtocolAPeerIsKilled) {
  std::uint64_t recoveries = 0, shifts = 0;
  for (std::uint64_t seed = 0; seed < 60 && !HasFailure(); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    const PeerNumber peer_count = 3 + below(random, 4), victim = below(random, peer_count);
    const std::uint64_t last_word = 1 + below(random, 20 * 8 * (peer_count - 1));
    Play play(below(random, 10) + 10 * seed, peer_count, 20);
    play.balance_windows = static_cast<std::uint32_t>(seed % 3);
    play.before_word = [&](PeerNumber peer, std::uint64_t word) {
      if (peer != victim || word != last_word) return;
      play.office().kill(victim);
      throw Killed();
    };
    play.run();
    EXPECT_EQ(play.count(Fate::killed) + play.count(Fate::done), peer_count);
    EXPECT_GE(play.count(Fate::done), peer_count - 1);
    expect_whole(play);
    for (const SessionCounters& counters : play.counters) recoveries += counters.recoveries, shifts += counters.shifts;
  }
  std::cout << recoveries << " recoveries, " << shifts << " shifts of zones\n";
  EXPECT_GT(shifts, 50u);
  EXPECT_GT(recoveries, 100u);
}

TEST(Session, GoesOnWhenAPeerIsKilledWhileOthersRecoverOrSaysSo) {
  std::uint64_t done = 0, halted = 0;
  for (std::uint64_t seed = 0; seed < 60 && !HasFailure(); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    const PeerNumber peer_count = 5 + below(random, 2), first = below(random, peer_count), second = (first + 1 + below(random, peer_count - 1)) % peer_count;
    const std::uint64_t last_word = 1 + below(random, 20 * 6 * (peer_count - 1)), further = below(random, 6 * (peer_count - 1));
    std::atomic<bool> is_first_dead = false;
    std::atomic<std::uint64_t> words_since = 0;
    Play play(below(random, 10) + 10 * seed, peer_count, 20);
    play.balance_windows = static_cast<std::uint32_t>(seed % 3);
    play.before_word = [&](PeerNumber peer, std::uint64_t word) {
      const bool dies_first = peer == first && word == last_word, dies_second = peer == second && is_first_dead && words_since++ == further;
      if (!dies_first && !dies_second) return;
      play.office().kill(peer);
      if (dies_first) is_first_dead = true;
      throw Killed();
    };
    play.run();
    expect_whole(play);
    done += play.count(Fate::done), halted += play.count(Fate::halted);
    EXPECT_EQ(play.count(Fate::done) + play.count(Fate::halted) + play.count(Fate::killed), peer_count);
    EXPECT_TRUE(play.count(Fate::halted) == 0 || play.count(Fate::done) == 0);
    for (const std::string& message : play.messages)
      EXPECT_TRUE(message.empty() || message.find("and with them what peer") != std::string::npos) << message;
  }
  std::cout << done << " peers went on to the end, " << halted << " halted since both copies of a part were lost\n";
  EXPECT_GT(done, halted);
}

TEST(Session, IsGoneOnWithByOneSideOfAPartitionAtMost) {
  std::uint64_t done = 0, halted = 0;
  for (std::uint64_t seed = 0; seed < 60 && !HasFailure(); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    const PeerNumber peer_count = 3 + below(random, 4);
    const std::uint64_t side = 1 + below(random, (1u << peer_count) - 2), last_word = 1 + below(random, 20 * 6 * (peer_count - 1));
    const auto is_one = [&](PeerNumber peer) { return (side >> peer & 1) != 0; };
    Play play(below(random, 10) + 10 * seed, peer_count, 20);
    play.balance_windows = static_cast<std::uint32_t>(seed % 3);
    play.before_word = [&](PeerNumber peer, std::uint64_t word) {
      if (peer == 0 && word == last_word) play.office().cut_off(is_one);
    };
    play.run();
    expect_whole(play);
    for (PeerNumber a = 0; a < peer_count; ++a)
      for (PeerNumber b = 0; b < a; ++b) {
        const bool went_on = play.fates[a] == Fate::done && play.fates[b] == Fate::done;
        const bool was_cut = play.counters[a].recoveries > 0 || play.counters[b].recoveries > 0;
        EXPECT_FALSE(went_on && was_cut && is_one(a) != is_one(b)) << a << " and " << b;
      }
    done += play.count(Fate::done), halted += play.count(Fate::halted);
    EXPECT_EQ(play.count(Fate::done) + play.count(Fate::halted), peer_count);
  }
  std::cout << done << " peers went on to the end, " << halted << " halted\n";
  EXPECT_GT(done, 0u);
  EXPECT_GT(halted, 0u);
}

TEST(Session, OfTwoIsGoneOnWithAlone) {
  Play play(7, 2, 20);
  play.before_word = [&](PeerNumber peer, std::uint64_t word) {
    if (peer == 1 && word == 50) {
      play.office().kill(1);
      throw Killed();
    }
  };
  play.run();
  EXPECT_EQ(play.fates, (std::vector{Fate::done, Fate::killed}));
  expect_whole(play);
}

TEST(Session, IsLeftInGoodOrder) {
  for (std::uint64_t seed = 0; seed < 40 && !HasFailure(); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    const PeerNumber peer_count = 2 + below(random, 5);
    std::vector<std::uint64_t> windows;
    for (PeerNumber peer = 0; peer < peer_count; ++peer) windows.push_back(below(random, 40));
    windows[below(random, peer_count)] = 99;
    Play play(below(random, 10) + 10 * seed, peer_count, 20);
    play.balance_windows = static_cast<std::uint32_t>(seed % 3);
    play.before_window = [&](Session& session, PeerNumber peer) {
      if (session.window() >= windows[peer]) session.leave();
    };
    play.run();
    expect_whole(play);
    EXPECT_GT(play.count(Fate::done), 0u);
    EXPECT_EQ(play.count(Fate::done) + play.count(Fate::left), peer_count);
    for (PeerNumber peer = 0; peer < peer_count; ++peer)
      EXPECT_TRUE(windows[peer] >= 18 || play.fates[peer] == Fate::left) << peer;
  }
}

TEST(Session, KeepsTheLogsOfThoseWhoAreGone) {
  std::size_t keys = 0;
  for (std::uint64_t seed = 0; seed < 30 && !HasFailure(); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    const PeerNumber peer_count = 3 + below(random, 3), victim = below(random, peer_count), leaver = (victim + 1 + below(random, peer_count - 1)) % peer_count;
    const std::uint64_t last_word = 1 + below(random, 20 * 6 * (peer_count - 1)), last_window = below(random, 30);
    Play play(6 + seed % 2 + 10 * seed, peer_count, 20);
    play.is_live = true;
    play.before_word = [&](PeerNumber peer, std::uint64_t word) {
      if (peer != victim || word != last_word) return;
      play.office().kill(victim);
      throw Killed();
    };
    play.before_window = [&](Session& session, PeerNumber peer) {
      if (peer == leaver && session.window() >= last_window) session.leave();
    };
    play.run();
    std::optional<std::uint64_t> truth;
    for (const std::vector<Arrivals>& parts : play.ends) {
      if (parts.empty()) continue;
      if (!truth) truth = play.replayed(parts);
      EXPECT_EQ(play.hash_of(parts), truth);
    }
    keys += play.key_count();
    EXPECT_TRUE(truth || play.count(Fate::halted) > 0);
  }
  std::cout << keys << " keys\n";
  EXPECT_GT(keys, 500u);
}

}  // namespace
}  // namespace rink::peer::test
