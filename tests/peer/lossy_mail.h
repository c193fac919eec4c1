// Mail between peers in threads that die in the middle of a word, are cut off from each other, or
// come later.
#pragma once

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <deque>
#include <functional>
#include <map>
#include <mutex>
#include <span>
#include <utility>
#include <vector>

#include "game/peer/protocol.h"
#include "game/peer/session/session_state.h"

namespace rink::peer::test {

/// What ends a thread that is killed.
struct Killed {};

/// One thread's end of all lines; those who begin have their numbers as ends, whoever comes later
/// has the next one that is free.
using End = std::size_t;

/// What a newcomer is told.
struct Ticket {
  enum class Answer : std::uint8_t { none, number, again, never } answer = Answer::none;
  PeerNumber number = 0;
  std::map<PeerNumber, End> others;  ///< whom it must reach
  std::vector<PeerNumber> members;   ///< of these
  std::uint32_t first_bat = 0;       ///< that it plays
};

class LossyOffice {
 public:
  static constexpr End ends_max = 32;
  static constexpr End nobody = ends_max;  ///< for whom a liar may ask
  /// With one whose word is due; changed before anybody waits.
  std::chrono::milliseconds patience = std::chrono::hours(1);
  explicit LossyOffice(PeerNumber peer_count)
      : lines_((nobody + 1) * (nobody + 1)),
        is_dead_(nobody + 1),
        has_finished_(nobody + 1),
        is_connected_(nobody + 1),
        tickets_(nobody + 1),
        callers_(nobody + 1),
        begin_count_(peer_count),
        end_count_(peer_count) {}

  void kill(End peer) {
    const std::lock_guard lock(mutex_);
    is_dead_[peer] = true;
    has_come_.notify_all();
  }
  /// No word goes any more between those for whom `is_one` is true and the others.
  void cut_off(const std::function<bool(End)>& is_one) {
    const std::lock_guard lock(mutex_);
    for (End a = 0; a < ends_max; ++a)
      for (End b = 0; b < ends_max; ++b)
        if (is_one(a) != is_one(b)) line(a, b).is_cut = true;
    has_come_.notify_all();
  }
  /// No word of those for whom `is_one` is true comes to the others any more.
  void mute(const std::function<bool(End)>& is_one) {
    const std::lock_guard lock(mutex_);
    for (End a = 0; a < ends_max; ++a)
      for (End b = 0; b < ends_max; ++b)
        if (is_one(a) && !is_one(b)) line(a, b).is_cut = true;
    has_come_.notify_all();
  }
  void finish(End peer) {
    const std::lock_guard lock(mutex_);
    has_finished_[peer] = true;
    has_come_.notify_all();
  }
  void part(End own, End peer, bool is_lost) {
    const std::lock_guard lock(mutex_);
    line(peer, own).is_parted = true;
    if (is_lost) line(own, peer).is_cut = true;
    has_come_.notify_all();
  }
  void rejoin(End own, End peer) {
    const std::lock_guard lock(mutex_);
    line(peer, own).is_parted = false;
  }
  void send(End from, End to, std::vector<std::uint8_t> bytes) {
    const std::lock_guard lock(mutex_);
    if (!line(from, to).is_cut) line(from, to).waiting.push_back(std::move(bytes));
    has_come_.notify_all();
  }
  /// `counted`: those whose loss matters to `own`.
  std::pair<PeerNumber, std::vector<std::uint8_t>> receive(
      End own, std::span<const std::pair<PeerNumber, End>> from,
      const std::map<PeerNumber, End>& counted) {
    std::unique_lock lock(mutex_);
    for (;;) {
      for (const auto& [number, end] : counted) {
        if (line(end, own).is_sent_away)
          throw SentAway("peer " + std::to_string(number) + " sent this one away");
        if (!line(end, own).is_parted && (is_dead_[end] || line(end, own).is_cut))
          throw PeerGone(number, false, "peer " + std::to_string(number) + " is gone");
      }
      for (const auto& [number, end] : from) {
        Line& mail = line(end, own);
        if (mail.waiting.empty()) continue;
        std::vector<std::uint8_t> bytes = std::move(mail.waiting.front());
        mail.waiting.pop_front();
        return {number, std::move(bytes)};
      }
      for (const auto& [number, end] : from)
        if (has_finished_[end])
          throw PeerGone(number, true, "peer " + std::to_string(number) + " has left");
      if (has_come_.wait_for(lock, patience) == std::cv_status::timeout)
        throw PeerGone(from.front().first, false,
                       "peer " + std::to_string(from.front().first) + " has said nothing");
    }
  }

  /// A newcomer asks `to`, and waits for the answer; with it comes its end.
  std::pair<End, Ticket> ask(End to, Newcomer newcomer) {
    std::unique_lock lock(mutex_);
    if (end_count_ == ends_max)
      return {0, {.answer = Ticket::Answer::never, .number = 0, .others = {}, .members = {}}};
    const End own = end_count_++;
    newcomer.token = own;
    callers_[to].push_back(newcomer);
    const auto is_over = [&] {
      return tickets_[own].answer != Ticket::Answer::none || is_dead_[to] || has_finished_[to] ||
             line(to, own).is_cut;
    };
    has_come_.wait(lock, is_over);
    Ticket ticket = tickets_[own];
    if (ticket.answer == Ticket::Answer::none) ticket.answer = Ticket::Answer::again;
    is_connected_[own] = ticket.answer == Ticket::Answer::number;
    if (!is_connected_[own]) is_dead_[own] = true;
    return {own, ticket};
  }
  void answer(End own, Ticket ticket) {
    const std::lock_guard lock(mutex_);
    tickets_[own] = std::move(ticket);
    has_come_.notify_all();
  }
  std::vector<Newcomer> callers(End own) {
    const std::lock_guard lock(mutex_);
    return std::exchange(callers_[own], {});
  }
  bool reaches(End own, End peer) {
    const std::lock_guard lock(mutex_);
    return is_connected_[peer] && !is_dead_[peer] && !line(peer, own).is_cut;
  }
  bool has_given_up(End own, End peer) {
    const std::lock_guard lock(mutex_);
    return is_dead_[peer] || line(peer, own).is_cut;
  }
  void send_away(End own, End peer) {
    const std::lock_guard lock(mutex_);
    line(own, peer).is_sent_away = true;
    if (tickets_[peer].answer == Ticket::Answer::none)
      tickets_[peer].answer = Ticket::Answer::again;
    has_come_.notify_all();
  }
  bool is_there(End end) {
    const std::lock_guard lock(mutex_);
    return end < end_count_ && (end < begin_count_ || is_connected_[end]) && !is_dead_[end] &&
           !has_finished_[end];
  }

 private:
  struct Line {
    std::deque<std::vector<std::uint8_t>> waiting;
    bool is_cut = false, is_parted = false, is_sent_away = false;
  };
  Line& line(End from, End to) { return lines_[from * (nobody + 1) + to]; }

  std::vector<Line> lines_;
  std::vector<bool> is_dead_, has_finished_, is_connected_;
  std::vector<Ticket> tickets_;
  std::vector<std::vector<Newcomer>> callers_;
  End begin_count_, end_count_;
  std::mutex mutex_;
  std::condition_variable has_come_;
};

class LossyMail final : public Mail {
 public:
  /// With every word that is said or awaited, `before_word` is called with its number; it may
  /// throw. `others`: those who are there, of whom the `counted` are no candidates.
  LossyMail(LossyOffice& office, End own, std::map<PeerNumber, End> others,
            std::map<PeerNumber, End> counted, std::function<void(std::uint64_t)> before_word)
      : office_(office),
        own_(own),
        ends_(std::move(others)),
        counted_(std::move(counted)),
        before_word_(std::move(before_word)) {}
  /// What is said may be changed on its way.
  std::function<void(std::vector<std::uint8_t>&)> on_the_way = [](std::vector<std::uint8_t>&) {};
  /// And what arrives.
  std::function<void(std::vector<std::uint8_t>&)> on_arrival = [](std::vector<std::uint8_t>&) {};
  /// How often it then arrives.
  std::function<int(PeerNumber, std::span<const std::uint8_t>)> copies =
      [](PeerNumber, std::span<const std::uint8_t>) { return 1; };
  void send(PeerNumber to, std::vector<std::uint8_t> bytes) override {
    before_word_(++words_);
    on_the_way(bytes);
    for (int left = copies(to, bytes); left > 0; --left) office_.send(own_, ends_.at(to), bytes);
  }
  std::vector<std::uint8_t> receive(PeerNumber from) override {
    return receive_any({&from, 1}).second;
  }
  std::pair<PeerNumber, std::vector<std::uint8_t>> receive_any(
      std::span<const PeerNumber> from) override {
    before_word_(++words_);
    std::vector<std::pair<PeerNumber, End>> ends;
    for (const PeerNumber peer : from) ends.emplace_back(peer, ends_.at(peer));
    auto word = office_.receive(own_, ends, counted_);
    on_arrival(word.second);
    return word;
  }
  void part(PeerNumber peer, bool is_lost) override {
    if (ends_.contains(peer)) office_.part(own_, ends_.at(peer), is_lost);
  }
  void rejoin(PeerNumber peer) override { office_.rejoin(own_, ends_.at(peer)); }
  std::vector<Newcomer> callers() override { return office_.callers(own_); }
  void refuse(std::uint64_t token, const std::string&, bool may_ask_again) override {
    office_.answer(ticket_of(token),
                   {.answer = may_ask_again ? Ticket::Answer::again : Ticket::Answer::never,
                    .number = 0,
                    .others = {},
                    .members = {}});
  }
  void expect(const Candidate& candidate, bool has_asked_here, const State& state) override {
    if (has_asked_here) {
      Ticket ticket{.answer = Ticket::Answer::number,
                    .number = candidate.number,
                    .others = ends_,
                    .members = state.members,
                    .first_bat = candidate.first_bat};
      ticket.others[own_number(state)] = own_;
      office_.answer(ticket_of(candidate.newcomer.token), std::move(ticket));
    }
    ends_[candidate.number] = ticket_of(candidate.newcomer.token);
  }
  bool reaches(PeerNumber candidate) override { return office_.reaches(own_, ends_.at(candidate)); }
  bool has_given_up(PeerNumber candidate) override {
    return office_.has_given_up(own_, ends_.at(candidate));
  }
  void admit(PeerNumber candidate, bool is_in) override {
    if (is_in) {
      counted_[candidate] = ends_.at(candidate);
      return;
    }
    counted_.erase(candidate);
    office_.send_away(own_, ends_.at(candidate));
    office_.part(own_, ends_.at(candidate), true);
  }

 private:
  /// Whoever a liar asks for is nowhere.
  static End ticket_of(std::uint64_t token) {
    return std::min<std::uint64_t>(token, LossyOffice::nobody);
  }
  /// The one of the members that is no other.
  PeerNumber own_number(const State& state) const {
    for (const PeerNumber peer : state.members)
      if (!ends_.contains(peer)) return peer;
    return 0;
  }

  LossyOffice& office_;
  End own_;
  std::map<PeerNumber, End> ends_, counted_;
  std::function<void(std::uint64_t)> before_word_;
  std::uint64_t words_ = 0;
};

}  // namespace rink::peer::test
