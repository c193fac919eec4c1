// A session whose players look beyond what their peers have, among threads, while others come,
// leave and die; and by brute force what they should have been told.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <deque>
#include <fstream>
#include <map>
#include <mutex>
#include <span>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "game/model/scene_file.h"
#include "game/net/peer/crowd.h"
#include "game/net/peer/interest/viewer.h"
#include "game/net/peer/network/seating.h"
#include "game/replication/region_sweep.h"
#include "tests/im/recount.h"
#include "tests/peer/lossy_mail.h"
#include "tests/peer_command/peer_processes.h"

namespace rink::game {

/// Mail between threads that carries asides in the same stream.
class AsideMail final : public peer::Mail, public SideChannel {
 public:
  using End = peer::test::End;
  AsideMail(peer::test::LossyOffice& office, End own, std::map<peer::PeerNumber, End> others,
            std::map<peer::PeerNumber, End> counted)
      : mail_(office, own, std::move(others), std::move(counted), [](std::uint64_t) {}) {}
  void send(peer::PeerNumber to, std::vector<std::uint8_t> bytes) override {
    say(to, std::move(bytes), false);
  }
  void send_aside(peer::PeerNumber to, std::vector<std::uint8_t> bytes) override {
    say(to, std::move(bytes), true);
  }
  std::vector<std::uint8_t> receive(peer::PeerNumber from) override {
    return receive_any({&from, 1}).second;
  }
  std::pair<peer::PeerNumber, std::vector<std::uint8_t>> receive_any(
      std::span<const peer::PeerNumber> from) override {
    for (;;) {
      pass_on();
      auto [sender, bytes] = mail_.receive_any(from);
      const bool is_aside = bytes.back() != 0;
      bytes.pop_back();
      if (is_aside) waiting_.emplace_back(sender, std::move(bytes));
      pass_on();
      if (!is_aside) return {sender, std::move(bytes)};
    }
  }
  void part(peer::PeerNumber peer, bool is_lost) override { mail_.part(peer, is_lost); }
  void rejoin(peer::PeerNumber peer) override { mail_.rejoin(peer); }
  std::vector<peer::Newcomer> callers() override { return mail_.callers(); }
  void refuse(std::uint64_t token, const std::string& reason, bool may_ask_again) override {
    mail_.refuse(token, reason, may_ask_again);
  }
  void expect(const peer::Candidate& candidate, bool has_asked_here,
              const peer::State& state) override {
    mail_.expect(candidate, has_asked_here, state);
  }
  bool reaches(peer::PeerNumber candidate) override { return mail_.reaches(candidate); }
  bool has_given_up(peer::PeerNumber candidate) override { return mail_.has_given_up(candidate); }
  void admit(peer::PeerNumber candidate, bool is_in) override { mail_.admit(candidate, is_in); }

 private:
  void say(peer::PeerNumber to, std::vector<std::uint8_t> bytes, bool is_aside) {
    bytes.push_back(is_aside ? 1 : 0);
    mail_.send(to, std::move(bytes));
  }
  void pass_on() {
    for (; receive_aside && !waiting_.empty(); waiting_.pop_front())
      EXPECT_TRUE(receive_aside(waiting_.front().first, waiting_.front().second))
          << "said by peer " << waiting_.front().first;
  }

  peer::test::LossyMail mail_;
  std::deque<std::pair<peer::PeerNumber, std::vector<std::uint8_t>>> waiting_;
};

class InterestPlay {
 public:
  using End = peer::test::End;
  static constexpr double window = 0.02, half_side = 0.45;

  /// Each peer that begins plays a bat of `scene_file`.
  InterestPlay(const std::string& scene_file, peer::PeerNumber peer_count,
               std::uint64_t window_count, const InterestTerms& interest)
      : scene_(load_scene(scene_file)),
        game_(scene_, {}),
        office_(peer_count),
        windows_(window_count) {
    terms_ = {.peer_count = peer_count,
              .until = window * static_cast<double>(window_count),
              .window = window,
              .balance_windows = 25,
              .interest = interest};
  }

  /// At the ends of windows [by the first peer's count]: who comes through peer 0, and whose ends
  /// of the lines are to leave or to die.
  std::vector<std::uint64_t> comings;
  std::map<End, std::uint64_t> leavings, deaths;

  void run() {
    for (peer::PeerNumber number = 0; number < terms_.peer_count; ++number)
      launch([this, number] { begin(number); });
    for (std::size_t k = 0;; ++k) {
      std::thread next;
      {
        const std::lock_guard lock(mutex_);
        if (k == threads_.size()) break;
        next = std::move(threads_[k]);
      }
      next.join();
    }
  }

  struct Recount {
    std::uint64_t sights = 0, seen = 0, far = 0;  ///< `far`: of those seen, told of by others
    std::uint64_t missing = 0, extra = 0;
    std::string wrong;  ///< the first ones
  };
  /// By the true states at the windows' ends: a body that `relevant` is at two ends of windows one
  /// after the other must be seen at the second, and one that is not at four may not be.
  Recount recount(const im::Relevant& relevant, const im::Relevant& stays) const {
    std::vector<im::Role> roles(places_.at(0).size());
    for (const Entity& entity : game_.start().entities())
      roles[entity.id.index].is_always_relevant =
          RelevantKinds::of_bits(terms_.interest.always).has(entity.kind);
    const auto near = [&](const Sight& sight, std::uint64_t at, std::uint32_t body, double grown) {
      const im::Body box{places_.at(at)[body], roles[body]};
      const im::Region bat = places_.at(at)[sight.bat];
      const double x = 0.5 * (bat.low_x + bat.high_x), y = 0.5 * (bat.low_y + bat.high_y),
                   reach = half_side + grown;
      const im::Region view{x - reach, y - reach, x + reach, y + reach};
      return grown < 0.0 ? relevant({view, {}, {}}, box) : stays({view, {}, {}}, box);
    };
    constexpr double doubt =
        0.05;  // m: how far off a bat may be believed to be that was hit in the last two windows
    Recount all;
    for (const Sight& sight : sights_) {
      if (turned_lately(sight)) continue;
      ++all.sights;
      all.seen += sight.bodies.size(), all.far += sight.told;
      for (std::uint32_t body = 0; body < places_.at(sight.window).size(); ++body) {
        const bool is_seen = std::binary_search(sight.bodies.begin(), sight.bodies.end(), body);
        bool must = true, may = false;
        for (std::uint64_t back = 0; back < 2; ++back)
          must = must && near(sight, sight.window - back, body, -doubt);
        for (std::uint64_t back = 0; back < 4; ++back)
          may = may || near(sight, sight.window - back, body, doubt);
        all.missing += must && !is_seen, all.extra += is_seen && !may;
        if (((must && !is_seen) || (is_seen && !may)) && all.wrong.size() < 1000)
          all.wrong += std::string(is_seen ? "extra" : "missing") + ": body " +
                       std::to_string(body) + " at peer " + std::to_string(sight.peer) +
                       " in window " + std::to_string(sight.window) +
                       ", which believes its bat to be " + std::to_string(1e3 * off_by(sight)) +
                       " mm off\n";
      }
    }
    return all;
  }

  /// Of those who were there to the end, and that of one engine with everybody's keys.
  std::vector<std::uint64_t> hashes;
  std::uint64_t truth = 0, goals = 0;
  std::vector<std::string> errors;
  std::vector<peer::PeerNumber> came;

  /// After `run`: what one engine says.
  void find_truth() {
    Game one(scene_);
    for (const InputEvent& key : keys_) one.submit(key);
    for (std::uint64_t k = 0; k <= windows_; ++k) {
      one.advance(k == windows_ ? terms_.until : window * static_cast<double>(k));
      for (std::uint32_t body = 0; body < one.world().body_count(); ++body)
        places_[k].push_back(
            bounding_box(one.world().position({body}), one.world().half_extent({body})));
    }
    truth = one.hash();
    goals = one.score().left + one.score().right;
  }
  std::size_t key_count() const { return keys_.size(); }

 private:
  struct Sight {
    peer::PeerNumber peer;
    std::uint32_t bat;
    std::uint64_t window;
    std::vector<std::uint32_t> bodies;
    std::size_t told;
    physics::Vector2 believed;  ///< m, where its bat was at the window's end
  };
  physics::Vector2 bat_at(const Sight& sight, std::uint64_t window) const {
    const im::Region bat = places_.at(window)[sight.bat];
    return {0.5 * (bat.low_x + bat.high_x), 0.5 * (bat.low_y + bat.high_y)};
  }
  double off_by(const Sight& sight) const {
    return (sight.believed - bat_at(sight, sight.window)).norm();
  }
  /// Whose bat was hit by something heavy looks for some windows where it would be without that:
  /// what was told of it is two windows old when others are told of the view.
  bool turned_lately(const Sight& sight) const {
    constexpr double told_ago = 2.0, turn = 0.03;  // windows; m, more than keys do in that time
    for (std::uint64_t back = 0; back < 4; ++back) {
      const std::uint64_t at = sight.window - back;
      if (at < 3) continue;
      const physics::Vector2 before = bat_at(sight, at - 2), step = before - bat_at(sight, at - 3);
      if ((before + told_ago * step - bat_at(sight, at)).norm() > turn) return true;
    }
    return false;
  }

  class Watch final : public WindowParticipant {
   public:
    Watch(InterestPlay& play, End own) : play_(play), own_(own) {}
    void before_window(peer::Session& session) override { play_.act(session.window(), own_); }

   private:
    InterestPlay& play_;
    End own_;
  };

  void launch(std::function<void()> run) {
    const std::lock_guard lock(mutex_);
    threads_.emplace_back(std::move(run));
  }
  /// Whoever comes is not to miss the whole game.
  void act(std::uint64_t at, End own) {
    if (const auto death = deaths.find(own); death != deaths.end() && death->second == at)
      throw peer::test::Killed{};
    if (own != 0) return;
    for (const std::uint64_t coming : comings)
      if (coming == at) {
        ++asked_;
        launch([this] { join(); });
      }
    bool are_all_in = false;
    {
      const std::lock_guard lock(mutex_);
      are_all_in = came.size() + errors.size() == asked_;
    }
    if (!are_all_in) std::this_thread::sleep_for(std::chrono::milliseconds(3));
  }

  void begin(peer::PeerNumber number) {
    std::map<peer::PeerNumber, End> others;
    std::vector<PeerInfo> peer_infos(terms_.peer_count);
    for (peer::PeerNumber peer = 0; peer < terms_.peer_count; ++peer) {
      if (peer != number) others[peer] = peer;
      peer_infos[peer] = info(peer);
    }
    AsideMail mail(office_, number, others, others);
    live(mail, number, number, peer_infos, {});
  }

  void join() {
    const auto [own, ticket] = office_.ask(0, {.bat_count = 1, .puck_count = 4});
    if (ticket.answer != peer::test::Ticket::Answer::number)
      return note("a newcomer is not let in");
    std::map<peer::PeerNumber, End> counted;
    for (const peer::PeerNumber peer : ticket.members) counted[peer] = ticket.others.at(peer);
    std::vector<PeerInfo> peer_infos(ticket.number + 1);
    peer_infos[ticket.number] = info(ticket.first_bat);
    AsideMail mail(office_, own, ticket.others, counted);
    live(mail, own, ticket.number, peer_infos, ticket.members);
  }

  static PeerInfo info(std::uint32_t bat) {
    return {.place = {}, .first_bat = bat, .bat_count = 1, .puck_count = 4};
  }

  void live(AsideMail& mail, End own, peer::PeerNumber number,
            const std::vector<PeerInfo>& peer_infos, const std::vector<peer::PeerNumber>& members) {
    Viewer viewer(game_, interest_settings(game_.start(), terms_, peer_infos, half_side, 0.0),
                  mail);
    std::vector<Sight> sights;
    std::uint64_t first = 0, valid_from = 0;
    // With this window's agreement all that others told of the one before has come.
    viewer.on_final = [&] {
      const std::uint64_t at = viewer.windows() + 1;
      if (first == 0) first = at, note_coming(number, !members.empty());
      // A newcomer does not know where its bat is until its owner shows it, within 0.05 s.
      if (at < std::max(valid_from, first + (members.empty() ? 4 : 8))) return;
      // Who leaves hands over what it has, and is not there any more when it is told of that again.
      if (leavings.contains(own) && viewer.windows() >= leavings.at(own)) return;
      Sight sight{
          number,
          viewer.interest().bat(),
          at,
          {},
          0,
          viewer.interest().position_at(viewer.interest().bat(), window * static_cast<double>(at))};
      viewer.interest().list_scope(sight.bodies);
      std::sort(sight.bodies.begin(), sight.bodies.end());
      sight.told = static_cast<std::size_t>(std::count_if(
          sight.bodies.begin(), sight.bodies.end(),
          [&](std::uint32_t body) { return viewer.interest().replicas().replica(body).is_there; }));
      sights.push_back(std::move(sight));
    };
    // All is told anew with the window after the one that is played when somebody is lost, the own
    // bat as well; from where that is then two windows on.
    const auto hear_of_loss = [&](const std::string& what) {
      if (what.find(" go on from ") != std::string::npos) valid_from = viewer.windows() + 4;
    };
    Watch watch(*this, own);
    PartOptions part_options;
    part_options.wants_to_leave = [&] {
      return leavings.contains(own) && viewer.windows() >= leavings.at(own);
    };
    part_options.notify = hear_of_loss;
    part_options.participant = &watch, part_options.members = members,
    part_options.observer = &viewer;
    try {
      const PlayedPart part = game_.play(terms_, peer_infos, number, mail, part_options);
      const std::lock_guard lock(mutex_);
      if (!part.has_left) hashes.push_back(part.hash), keys_ = part.keys;
    } catch (const peer::test::Killed&) {
      office_.kill(own);
      return;
    } catch (const std::exception& error) {
      office_.kill(own);
      return note("peer " + std::to_string(number) + ": " + error.what());
    }
    office_.finish(own);
    const std::lock_guard lock(mutex_);
    sights_.insert(sights_.end(), sights.begin(), sights.end());
  }
  void note_coming(peer::PeerNumber number, bool is_newcomer) {
    const std::lock_guard lock(mutex_);
    if (is_newcomer) came.push_back(number);
  }
  void note(const std::string& problem) {
    const std::lock_guard lock(mutex_);
    errors.push_back(problem);
  }

  Scene scene_;
  SharedGame game_;
  peer::test::LossyOffice office_;
  std::uint64_t windows_;
  Terms terms_;
  std::mutex mutex_;
  std::deque<std::thread> threads_;
  std::size_t asked_ = 0;
  std::vector<Sight> sights_;
  std::vector<InputEvent> keys_;
  std::map<std::uint64_t, std::vector<im::Region>> places_;  ///< by window's end, then by body
};

}  // namespace rink::game
