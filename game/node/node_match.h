// The matches of two players that nodes host together: node 0 keeps to the rules around them, all
// follow what it says, and each match is a session of its own.
#pragma once

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
  explicit NodeMatch(const FlowTimes& times) : flow_(times) {}

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
  MatchRounds& rounds() { return rounds_; }
  const MatchNews& news() const { return news_; }
  /// False for what node 0 never says.
  bool follow(const MatchNews& news);

  /// True if the next session is to begin.
  bool begins() const { return news_.session > begun_; }
  std::uint64_t begun() const { return begun_; }
  void begin_session();
  /// True if the session that goes on ends after this window at the latest, won or not.
  bool is_last(std::uint64_t window) const { return last_window_ != 0 && window >= last_window_; }
  /// It came to `until_s` [s, simulated], in so many stretches.
  void end_session(double until_s, std::uint64_t stretches);

  // At node 0.
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
  /// A side has won the session's game at `time` [s, simulated].
  void win(Team winner, double time);

 private:
  void wish(const MatchWish& wish);

  struct Session {
    std::uint32_t match = 0;
    bool has_ended = false;
    double until_s = 0.0;
    std::uint64_t stretches = 0;  ///< of all sessions when it has ended
  };

  MatchFlow flow_;
  MatchRounds rounds_;
  MatchNews news_, next_;  ///< as told; and, at node 0, what is to be told, but for the state
  double told_s_ = 0.0;
  std::uint64_t begun_ = 0, ended_stretches_ = 0;  ///< sessions; and stretches of those that ended
  std::uint64_t last_window_ = 0;                  ///< of the session that goes on; 0: not known
  mutable std::mutex mutex_;
  MatchState state_;              ///< guarded by `mutex_`, as are these:
  std::deque<Session> sessions_;  ///< that were not shown to their ends, and the last one
  std::uint64_t shown_ = 0;       ///< stretches
  std::vector<MatchWish> wishes_;
};

}  // namespace rink::game
