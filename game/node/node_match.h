// The matches of two players that nodes host together: the referee keeps to the rules around them,
// all follow what it says, and each match is a session of its own.
#pragma once

#include <array>
#include <cassert>
#include <cstdint>
#include <deque>
#include <mutex>
#include <optional>
#include <utility>
#include <vector>

#include "game/net/server/shared_play.h"
#include "game/node/match/match_rounds.h"
#include "game/node/match/match_words.h"

namespace rink::game {

/// Times are real ones since the nodes' start [s]. The server's thread wishes and looks; all else
/// is the session's thread's.
class NodeMatch final : public SharedMatch {
 public:
  explicit NodeMatch(const FlowTimes& times) : times_(times), flow_(times) {}

  /// That of a match until all of its session was shown, whatever follows.
  MatchState state() override;
  void pause(bool is_wanted) override {
    wish({.kind = is_wanted ? MatchWish::Kind::pause : MatchWish::Kind::go_on});
  }
  void ask_rematch(std::uint32_t player) override {
    wish({.kind = MatchWish::Kind::rematch, .player = player});
  }
  /// So many stretches of all sessions were shown.
  void note_shown(std::uint64_t stretches);
  /// No more of the match that is shown will follow.
  bool has_shown_all() const;

  std::vector<MatchWish> take_wishes();
  /// Another node is the referee now: rematches of which the news show nothing are asked again.
  void ask_again();
  MatchRounds& rounds() { return rounds_; }
  const MatchNews& news() const { return news_; }
  /// False for what the referee never says.
  bool follow(const MatchNews& news);

  /// True if the next session is to begin.
  bool begins() const { return news_.session > begun_; }
  std::uint64_t begun() const { return begun_; }
  void begin_session();
  /// True if the session that goes on ends after this window at the latest, won or not.
  bool is_last(std::uint64_t window) const { return last_window_ != 0 && window >= last_window_; }
  /// It came to `until_s` [s, simulated], in so many stretches.
  void end_session(double until_s, std::uint64_t stretches);

  /// No match follows the session that has ended last, which nobody may have won: it is over here,
  /// whatever the referee says.
  void close(std::optional<Team> winner);

  /// A side has won the session's game at `time` [s, simulated]: the referee says so.
  void note_won(Team winner, double time) { won_ = Won{match_, winner, time}; }

  // At the referee, which is node 0 at first.
  /// This node becomes it, and goes on from the news; whose seats are taken.
  void lead(std::array<bool, 2> are_seated, double now_s);
  /// A loss took time, in which nobody played: the match has come no further than that [s].
  void fall_behind(double now_s, double simulated_s);
  void take_part(std::uint32_t player, bool is_here, double now_s);
  void apply(const MatchWish& wish, double now_s);
  /// Lets time pass. Answers what the others are to be told: news, and now and then the old, for a
  /// node that waits for its players and says nothing would be taken for lost. While the match is
  /// played its rounds are heard.
  std::optional<MatchNews> advance(double now_s);
  /// A match waits for its session, which no other may hold up.
  bool wants_session() const;
  void call_session();
  /// The session's match is over, or was given up, while the session goes on.
  bool is_given_up() const;
  void end_after(std::uint64_t window) { next_.last_window = window; }
  /// Tells the flow who has won, if somebody has and it does not know.
  void follow_win();

 private:
  void wish(const MatchWish& wish);

  struct Session {
    std::uint32_t match = 0;
    bool has_ended = false;
    double until_s = 0.0;
    std::uint64_t stretches = 0;  ///< of all sessions when it has ended
  };

  struct Won {
    std::uint32_t match = 0;
    Team winner = Team::none;
    double time = 0.0;
  };

  FlowTimes times_;
  MatchFlow flow_;
  MatchRounds rounds_;
  std::optional<Won> won_;  ///< the last one
  MatchNews news_, next_;   ///< as told; and, at the referee, what is to be told, but for the state
  double told_s_ = 0.0;
  std::uint64_t begun_ = 0, ended_stretches_ = 0;  ///< sessions; and stretches of those that ended
  std::uint32_t match_ = 0;                        ///< of the session that began last
  std::uint64_t last_window_ = 0;                  ///< of the session that goes on; 0: not known
  std::vector<MatchWish> rematches_;  ///< that were passed on since the match was over
  mutable std::mutex mutex_;
  MatchState state_;              ///< guarded by `mutex_`, as are these:
  std::deque<Session> sessions_;  ///< that were not shown to their ends, and the last one
  std::uint64_t shown_ = 0;       ///< stretches
  std::vector<MatchWish> wishes_;
};

}  // namespace rink::game
