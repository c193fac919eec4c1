// One scene among peers in threads, with whatever befalls them.
#pragma once

#include <gtest/gtest.h>

#include <atomic>
#include <deque>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <thread>

#include "game/peer/session/session.h"
#include "tests/peer/fate.h"
#include "tests/peer/lossy_mail.h"
#include "tests/peer/shared_scenes.h"

namespace rink::peer::test {

/// One scene among peers in threads, with whatever befalls them.
class Play {
 public:
  Play(std::uint64_t number, PeerNumber peer_count, std::uint64_t window_count)
      : Play(number, peer_count, window_count, shared_scene) {}
  /// `scene` makes the scene of that number, with keys until then [s].
  Play(std::uint64_t number, PeerNumber peer_count, std::uint64_t window_count,
       std::function<SharedScene(std::uint64_t, double)> scene)
      : number_(number),
        peer_count_(peer_count),
        window_count_(window_count),
        make_scene_(std::move(scene)),
        scene_(make_scene_(number, window_length * static_cast<double>(window_count))),
        cuts_(Cuts::by_count(scene_.world.spec().field, places(), peer_count)),
        office_(peer_count),
        fates(LossyOffice::ends_max, Fate::away),
        ends(LossyOffice::ends_max),
        lost(LossyOffice::ends_max),
        may_have_split(LossyOffice::ends_max),
        last_losses(LossyOffice::ends_max),
        counters(LossyOffice::ends_max),
        messages(LossyOffice::ends_max),
        windows_played(LossyOffice::ends_max) {
    std::stable_sort(scene_.keys.begin(), scene_.keys.end(), [](const Key& a, const Key& b) {
      return a.time != b.time ? a.time < b.time : a.bat < b.bat;
    });
  }

  /// Told the end of the peer and its word.
  std::function<void(End, std::uint64_t)> before_word = [](End, std::uint64_t) {};
  /// Told what the peer of that end says, before it goes out, to be changed.
  std::function<void(End, std::vector<std::uint8_t>&)> on_the_way =
      [](End, std::vector<std::uint8_t>&) {};
  /// And what it receives.
  std::function<void(End, std::vector<std::uint8_t>&)> on_arrival =
      [](End, std::vector<std::uint8_t>&) {};
  /// Told before each advance.
  std::function<void(Session&, End)> before_window = [](Session&, End) {};
  /// How often what the peer of that end says to a peer arrives.
  std::function<int(End, PeerNumber, std::span<const std::uint8_t>)> copies =
      [](End, PeerNumber, std::span<const std::uint8_t>) { return 1; };
  std::optional<GoalRules> goals{};  ///< of a scene that has some
  bool is_live = false;
  std::uint32_t spare_bats = 0;  ///< of a live scene: for newcomers
  std::uint32_t balance_windows = 0;
  std::size_t tree_from = SessionSettings{}.tree_from;

  void run() {
    const SharedScene start =
        make_scene_(number_, window_length * static_cast<double>(window_count_));
    if (is_live) scene_.keys.clear();
    else find_truth();
    start_ = &start.world;
    for (std::uint32_t body = 0; body < start.world.body_count(); ++body)
      if (start.world.kind({body}) == physics::BodyKind::bat) bats_.push_back(body);
    for (PeerNumber number = 0; number < peer_count_; ++number)
      launch([&, number] { begin(number); });
    for (std::size_t k = 0;; ++k) {
      std::thread next;
      {
        const std::lock_guard lock(mutex_);
        if (k == threads_.size()) return;
        next = std::move(threads_[k]);
      }
      next.join();
    }
  }
  /// A newcomer asks `via`; where it is sent away it asks others, a few times.
  void invite(End via, std::uint32_t bat_count = 0) {
    launch([this, via, bat_count] { join(via, bat_count); });
  }
  /// By one engine, with everybody's logs.
  std::uint64_t replayed(const std::vector<Handover>& parts) {
    for (const Handover& part : parts)
      scene_.keys.insert(scene_.keys.end(), part.keys.begin(), part.keys.end());
    std::stable_sort(scene_.keys.begin(), scene_.keys.end(), [](const Key& a, const Key& b) {
      return a.time != b.time ? a.time < b.time : a.bat < b.bat;
    });
    find_truth();
    return scene_.world.hash();
  }
  /// All who ended have the hash of that. Answers whether anybody did.
  bool expect_truth_of_logs() {
    std::optional<std::uint64_t> truth;
    for (const std::vector<Handover>& parts : ends) {
      if (parts.empty()) continue;
      if (!truth) truth = replayed(parts);
      EXPECT_EQ(hash_of(parts), truth);
    }
    return truth.has_value();
  }
  std::uint64_t truth() const { return scene_.world.hash(); }
  std::size_t key_count() const { return scene_.keys.size(); }
  std::uint64_t hash_of(const std::vector<Handover>& parts) const {
    return hash_of_whole(scene_.world.spec(), scene_.world.body_count(), parts).value_or(0);
  }
  LossyOffice& office() { return office_; }
  std::size_t count(Fate fate) const {
    return static_cast<std::size_t>(std::count(fates.begin(), fates.end(), fate));
  }

 private:
  std::vector<Vector2> places() const {
    std::vector<Vector2> all;
    for (std::uint32_t body = 0; body < scene_.world.body_count(); ++body)
      all.push_back(scene_.world.position({body}));
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
      for (std::uint32_t body = 0; body < scene_.world.body_count(); ++body)
        states_[{window, body}] = bytes_of(physics::Subdomain::state_in(scene_.world, body));
    }
  }

  void launch(std::function<void()> run) {
    const std::lock_guard lock(mutex_);
    threads_.emplace_back(std::move(run));
  }

  SessionSettings settings(PeerNumber number) const {
    SessionSettings settings{
        .number = number,
        .peer_count = peer_count_,
        .halo = 0.2,
        .window_count = window_count_,
        .end_of = [](std::uint64_t k) { return window_length * static_cast<double>(k); }};
    settings.keys = scene_.keys;
    // Snapshots come often, and take several steps.
    settings.standby = {.replay_work = 20 + 150 * (number_ % 4), .piece_bytes = 900};
    settings.balance_windows = balance_windows;
    settings.tree_from = tree_from;
    settings.goals = goals;
    settings.bat_count = is_live ? static_cast<std::uint32_t>(bats_.size()) : 0;
    const std::uint32_t seated = settings.bat_count - std::min(settings.bat_count, spare_bats);
    for (PeerNumber peer = 0; peer < peer_count_; ++peer) {
      const std::uint32_t first = seated * peer / peer_count_;
      settings.players.push_back({.peer = peer,
                                  .first_bat = first,
                                  .bat_count = seated * (peer + 1) / peer_count_ - first,
                                  .puck_count = 2});
    }
    settings.seats_of = [this](const Player& player) {
      if (std::uint64_t{player.first_bat} + player.bat_count > bats_.size())
        throw ProtocolError("bats that are not there");
      std::vector<Seat> seats;
      for (std::uint32_t k = player.first_bat; k < player.first_bat + player.bat_count; ++k)
        seats.push_back({.bat = bats_[k],
                         .peer = player.peer,
                         .period = 0.02,
                         .phase = 0.001 * bats_[k],
                         .puck_count = player.puck_count});
      return seats;
    };
    return settings;
  }

  void begin(PeerNumber number) {
    std::map<PeerNumber, End> others;
    for (PeerNumber peer = 0; peer < peer_count_; ++peer)
      if (peer != number) others[peer] = peer;
    LossyMail mail(office_, number, others, others,
                   [&](std::uint64_t word) { before_word(number, word); });
    mail.on_the_way = [&](std::vector<std::uint8_t>& bytes) { on_the_way(number, bytes); };
    mail.on_arrival = [&](std::vector<std::uint8_t>& bytes) { on_arrival(number, bytes); };
    mail.copies = [&](PeerNumber to, std::span<const std::uint8_t> bytes) {
      return copies(number, to, bytes);
    };
    try {
      live(number,
           [&] { return std::make_unique<Session>(*start_, cuts_, settings(number), mail); });
    } catch (const SentAway& sent) {  // by a liar: nobody else sends away who began
      office_.kill(number);
      fates[number] = Fate::halted;
      messages[number] = sent.what();
    }
  }

  void join(End via, std::uint32_t bat_count) {
    for (int tries = 0; tries < 4; ++tries) {
      const auto [own, ticket] = office_.ask(via, {.bat_count = bat_count, .puck_count = 2});
      if (ticket.answer == Ticket::Answer::never) return;
      if (ticket.answer == Ticket::Answer::number) {
        std::map<PeerNumber, End> counted;
        for (const PeerNumber peer : ticket.members) counted[peer] = ticket.others.at(peer);
        LossyMail mail(office_, own, ticket.others, counted,
                       [&, own = own](std::uint64_t word) { before_word(own, word); });
        try {
          return live(own, [&, &ticket = ticket] {
            return std::make_unique<Session>(*start_, settings(ticket.number), mail,
                                             ticket.members);
          });
        } catch (const SentAway&) {
          office_.kill(own);
          fates[own] = Fate::away;
          ++sent_away;
        }
      }
      for (via = 0; via < LossyOffice::ends_max && !office_.is_there(via); ++via) {
      }
      if (via == LossyOffice::ends_max) return;
    }
  }

  /// From the first window to the last, or to whatever ends it before.
  void live(End own, const std::function<std::unique_ptr<Session>()>& make) {
    fates[own] = Fate::playing;
    std::unique_ptr<Session> session;
    Random random(number_ * 64 + own);
    try {
      session = make();
      while (!session->is_over()) {
        before_window(*session, own);
        session->advance();
        ++windows_played[own];
        if (!is_live) expect_truth(*session);
        note_owners(*session);
        for (const Observation& observation : session->peer().observations()) {
          const double x = static_cast<double>(below(random, 3)) - 1.0;
          session->press(observation, {observation.bat, Vector2(x, 0.5) * 6.0,
                                       static_cast<std::uint8_t>(1 + below(random, 200))});
        }
      }
      if (!session->has_left()) ends[own] = session->end();
      fates[own] = session->has_left() ? Fate::left : Fate::done;
    } catch (const Killed&) {
      fates[own] = Fate::killed;
      return;
    } catch (const SentAway&) {
      throw;
    } catch (const Halt& halt) {
      fates[own] = Fate::halted;
      messages[own] = halt.what();
    } catch (const ProtocolError& error) {
      fates[own] = Fate::halted;
      messages[own] = error.what();
    }
    if (session) {
      counters[own] = session->counters(), lost[own] = session->lost();
      may_have_split[own] = session->may_have_split();
      last_losses[own] = session->last_loss();
    }
    office_.finish(own);
  }

  /// Whoever is at the same step after the same windows is so by the same history, or by one that
  /// was undone.
  void note_owners(const Session& session) {
    if (session.has_left()) return;
    const std::lock_guard lock(mutex_);
    is_of_two = is_of_two || (session.members().size() == 1 && session.counters().recoveries > 0);
    Owners& owners = owners_[{session.step(), session.window()}];
    if (!owners.peers.insert(session.peer().number()).second) return;
    owners.member_count = session.members().size();
    for (const std::uint32_t body : session.peer().owned()) ++owners.counts[body];
  }

  void expect_truth(Session& session) {
    if (session.window() == 0) return;
    for (const std::uint32_t body : session.peer().owned())
      ASSERT_TRUE(bytes_of(session.peer().share().state(body)) ==
                  states_.at({session.window(), body}))
          << "peer " << session.peer().number() << ", window " << session.window() << ", body "
          << body;
  }

  struct Owners {
    std::set<PeerNumber> peers;
    std::size_t member_count = 0;
    std::map<std::uint32_t, int> counts;
  };

 public:
  /// Unless two were cut off from each other, of whom either goes on, at each step: nobody's body
  /// is another's too, and where all were, each is somebody's.
  void expect_one_owner_each() {
    if (is_of_two) return;
    for (const auto& [at, owners] : owners_) {
      for (const auto& [body, count] : owners.counts)
        ASSERT_EQ(count, 1) << "body " << body << " at step " << at.first << ", window "
                            << at.second;
      if (owners.peers.size() < owners.member_count) continue;
      ASSERT_EQ(owners.counts.size(), scene_.world.body_count())
          << "at step " << at.first << ", window " << at.second;
    }
  }

 private:
  std::uint64_t number_;
  PeerNumber peer_count_;
  std::uint64_t window_count_;
  std::function<SharedScene(std::uint64_t, double)> make_scene_;
  SharedScene scene_;
  Cuts cuts_;
  LossyOffice office_;
  std::map<std::pair<std::uint64_t, std::uint32_t>, std::vector<std::uint8_t>> states_;
  const physics::World* start_ = nullptr;
  std::vector<std::uint32_t> bats_;
  std::mutex mutex_;
  std::deque<std::thread> threads_;
  std::map<std::pair<std::uint64_t, std::uint64_t>, Owners> owners_;

 public:
  std::vector<Fate> fates;
  std::vector<std::vector<Handover>> ends;
  std::vector<std::vector<PeerNumber>>
      lost;  ///< at the end, and whether others may go on elsewhere
  std::vector<std::uint8_t> may_have_split;
  std::vector<std::string> last_losses;
  std::vector<SessionCounters> counters;
  std::vector<std::string> messages;
  std::vector<std::uint64_t> windows_played;
  std::atomic<std::uint64_t> sent_away = 0;
  std::atomic<bool> is_of_two = false;  ///< somebody went on alone after a loss
};

inline void expect_whole(Play& play) {
  for (const std::vector<Handover>& parts : play.ends)
    EXPECT_TRUE(parts.empty() || play.hash_of(parts) == play.truth());
  play.expect_one_owner_each();
}

}  // namespace rink::peer::test
