// A scene and its keys as peers share them: the division, the windows, and the final hash of the
// whole.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "game/control/game.h"
#include "game/control/key_log.h"
#include "game/net/peer/network/greetings.h"
#include "game/peer/session/session.h"

namespace rink::game {

/// The part that one peer played.
struct PlayedPart {
  peer::SessionCounters counters;
  bool has_left = false;        ///< before the end, in good order: then there is no hash
  bool was_last = false;        ///< and no other was left
  bool may_have_split = false;  ///< another part of the session may have continued without this one
  std::uint64_t members = 0;    ///< how many played on in the end
  std::vector<peer::PeerNumber> lost;   ///< the peers that were lost
  double time = 0.0;                    ///< the time that it reached [s]
  std::uint64_t owned = 0, ghosts = 0;  ///< at the end
  double halo = 0.0;                    ///< at the end [m]
  std::uint64_t result_bytes = 0;       ///< sent, with the own bodies' last states
  std::uint64_t hash = 0;               ///< of the whole: Game::hash(), as rink simulate prints it
  std::uint64_t presses = 0;            ///< of the own bots
  Score score;
  std::vector<InputEvent> keys;  ///< of all live players, as their owners stamped them, and all
                                 ///< recorded ones; ordered by time, then player
};

/// An observer of a peer's windows that may press keys of its bats.
class WindowParticipant {
 public:
  virtual ~WindowParticipant() = default;
  /// The prepared window is about to be played; keys pressed now are sent with its claims.
  virtual void before_window(peer::Session&) {}
  /// A window is final, and the next one prepared.
  virtual void after_window(const peer::Session&) {}
  /// The same, before it, of each stretch of a window that is cut where a puck comes back.
  virtual void after_stretch(const peer::Session&) {}
};

/// Who keeps more of a session than the session does, and goes back with it after a loss: see
/// peer::LossHooks.
class LossParticipant {
 public:
  virtual ~LossParticipant() = default;
  virtual void take_over(peer::PeerNumber lost, const peer::Part& part,
                         std::span<const peer::Key> keys) = 0;
  virtual void seat_again(peer::Session& session, peer::Peer& peer) = 0;
  virtual void go_back(peer::Session& session, std::span<const peer::Key> pending) = 0;
};

/// An observer of a session's windows while they are played.
class WindowObserver {
 public:
  virtual ~WindowObserver() = default;
  /// Called before the first window. The addresses of the session's peer and division stay valid,
  /// though both may be made anew there.
  virtual void begin(const peer::Session& session) = 0;
  /// See peer::WindowHooks.
  virtual void when_played() {}
  virtual void when_told() {}
  virtual void when_sending(peer::Subject) {}
  /// A window is committed; before it, peers may have been lost, and windows undone.
  virtual void when_stepped() = 0;
  /// Called after the last window; the session may no longer be used.
  virtual void end() {}
};

/// Options of a peer: its bots, and callbacks, such as one that waits for the clock before a window
/// from the given simulated time.
struct PartOptions {
  std::vector<std::string> players{"chaser"};  ///< kinds, as rink simulate's
  std::function<void(double)> before_window;
  std::function<bool()> wants_to_leave;
  std::function<void(const std::string&)> notify;  ///< the user, of losses and newcomers
  WindowParticipant* participant = nullptr;        ///< or null
  std::vector<peer::PeerNumber> members{};  ///< of a newcomer while others play: the members at
                                            ///< that time
  std::function<void()> when_taken{};  ///< the start is no longer needed: SharedGame::forget_start
                                       ///< may be called
  WindowObserver* observer = nullptr;
  LossParticipant* losses = nullptr;                ///< or null; of a replicated session
  std::function<bool(std::uint64_t)> is_stopped{};  ///< as peer::SessionSettings'
  bool takes_latecomers = false;  ///< the participant seats players while others play
};

/// How many windows the game has; the last one ends at its end, whatever the length of the others.
std::uint64_t window_count_of(const Terms& terms);
/// The end of the `window`th [s], counted from 1; of 0, the start. One after the last, which is
/// prepared and never played, ends a window later.
double end_of_window(const Terms& terms, std::uint64_t window);

/// Equal for all peers with the same scene and keys.
class SharedGame {
 public:
  /// `recorded` keys come beside the scene's own. Throws SceneError for scenes that peers cannot
  /// share: players that enter or leave, and pucks that would come back sooner than agreed.
  SharedGame(Scene scene, const std::vector<InputEvent>& recorded);

  Fingerprint session_fingerprint() const;
  std::uint32_t bat_count() const { return start_.player_count(); }
  /// True if all keys are known before the start; then no player can be live.
  bool has_keys() const { return !keys_.empty(); }
  const Scene& scene() const { return scene_; }
  /// The players of the first peers. Throws peer::ProtocolError naming a bat that is not there, or
  /// that two peers play.
  std::vector<peer::Player> players(const Terms& terms, std::span<const PeerInfo> peer_infos) const;
  /// The widest half of a body's bounding box [m].
  double extent_max() const { return extent_max_; }
  /// The keys that all know.
  const std::vector<InputEvent>& keys() const { return keys_; }
  peer::Cuts cuts(peer::PeerNumber peer_count) const;
  /// Plays the part of peer `number` of `peer_infos` to the end of `terms`; `peer_infos` need not
  /// have later peers. Throws peer::ProtocolError, peer::Halt (peer::SentAway for a newcomer that
  /// is not admitted yet and may try again), and what `mail` throws.
  PlayedPart play(const Terms& terms, std::span<const PeerInfo> peer_infos, peer::PeerNumber number,
                  peer::Mail& mail, const PartOptions& part_options) const;

  /// Throws SceneError if windows are too long [s] for pucks that come back after a goal.
  void require_window(double window) const { goal_rules(window); }
  /// Throws SceneError for rules that only a peer keeps that plays the whole.
  void require_divisible() const;
  /// The keys of all peers as a log from which one engine plays the same game; `scene_text` is the
  /// scene's file.
  KeyLog record_of(const PlayedPart& part, const std::string& scene_text) const;

  /// The parts of `play`, for callers that play step by step: the game at its start; a peer that
  /// owns its part by `division` and knows all keys, whose first window ends with the first
  /// `window` [s]; and Game::hash() of a world that has come to `until` [s] under the keys that all
  /// know.
  const Game& start() const { return start_; }
  /// Frees the bodies of the start. A play() that has called `when_taken` needs them no more; no
  /// other play may begin afterwards.
  void forget_start();
  bool has_start() const { return forgotten_ == 0; }
  std::unique_ptr<peer::Peer> peer(const peer::Division& division, peer::PeerNumber number,
                                   double window) const;
  std::uint64_t hash(std::uint64_t world, double until) const {
    return hash(world, keys_, until, {});
  }

 private:
  double first_halo(double window) const;
  std::optional<peer::GoalRules> goal_rules(double window) const;
  std::vector<peer::Key> thrusts() const;
  std::vector<peer::Seat> seats(const peer::Player& player) const;
  std::vector<InputEvent> keys_with(std::span<const peer::Handover> logs) const;
  std::uint64_t hash(std::uint64_t world, std::span<const InputEvent> keys, double until,
                     const peer::Scoring& scoring) const;
  bool end(peer::Session& session, PlayedPart& part) const;

  Scene scene_;
  std::vector<InputEvent> keys_;  ///< in the order in which a Game applies them
  Game start_;                    ///< never advanced; without pucks once it is given up
  std::uint32_t forgotten_ = 0;   ///< after forget_start: the number of entities, numbered from 0
  double extent_max_ = 0.0, speed_max_ = 0.0;  ///< of all bodies then [m, m/s]
};

}  // namespace rink::game
