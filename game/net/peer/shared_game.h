// A scene and its keys as peers share them: the division, the windows, and the hash of the whole in
// the end.
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

/// What one peer had of it.
struct PlayedPart {
  peer::SessionCounters counters;
  bool has_left = false;        ///< before the end, in good order: then there is no hash
  bool was_last = false;        ///< and nobody else was left
  bool may_have_split = false;  ///< another part of the session may have gone on without this one
  std::uint64_t members = 0;    ///< how many played on in the end
  std::vector<peer::PeerNumber> lost;   ///< who was
  double time = 0.0;                    ///< how far it came [s]
  std::uint64_t owned = 0, ghosts = 0;  ///< at the end
  double halo = 0.0;                    ///< at the end [m]
  std::uint64_t result_bytes = 0;       ///< sent, with the own bodies' last states
  std::uint64_t hash = 0;               ///< of the whole: Game::hash(), as rink simulate prints it
  std::uint64_t presses = 0;            ///< of the own bots
  Score score;
  std::vector<InputEvent> keys;  ///< of all live players, as their owners stamped them, and all
                                 ///< recorded ones; ordered by time, then player
};

/// Who looks on while a peer plays, and may press keys of its bats.
class WindowParticipant {
 public:
  virtual ~WindowParticipant() = default;
  /// The time has come to play the window that is prepared; what is pressed now goes with its
  /// claims.
  virtual void before_window(peer::Session&) {}
  /// A window is final, and the next one prepared.
  virtual void after_window(const peer::Session&) {}
};

/// Told of the windows of a session while they are played.
class WindowObserver {
 public:
  virtual ~WindowObserver() = default;
  /// Before the first window. The session's peer and division stay where they are, though they may
  /// be made anew there.
  virtual void begin(const peer::Session& session) = 0;
  /// See peer::WindowHooks.
  virtual void when_played() {}
  virtual void when_told() {}
  virtual void when_sending(peer::Subject) {}
  /// A window is committed; before it, peers may have been lost, and windows undone.
  virtual void when_stepped() = 0;
  /// After the last one: the session is asked no more.
  virtual void end() {}
};

/// How a peer plays: with which bots, and what it does before it plays a window from the simulated
/// time that it is given, such as wait for the clock.
struct PartOptions {
  std::vector<std::string> players{"chaser"};  ///< kinds, as rink simulate's
  std::function<void(double)> before_window;
  std::function<bool()> wants_to_leave;
  std::function<void(const std::string&)> notify;  ///< the user, of losses and newcomers
  WindowParticipant* participant = nullptr;        ///< or nobody
  std::vector<peer::PeerNumber>
      members{};                       ///< of a newcomer while others play: whom it was told of
  std::function<void()> when_taken{};  ///< where bodies are at the start is asked for no more:
                                       ///< SharedGame::forget_start may be called
  WindowObserver* observer = nullptr;
};

/// The same for all who are given the same scene and keys.
class SharedGame {
 public:
  /// `recorded` keys come beside the scene's own. Throws SceneError for what peers cannot share:
  /// players who enter or leave, and pucks that would come back sooner than agreed upon.
  SharedGame(Scene scene, const std::vector<InputEvent>& recorded);

  Fingerprint session_fingerprint() const;
  std::uint32_t bat_count() const { return start_.player_count(); }
  /// Whether all keys are known before the start; then nobody can play live.
  bool has_keys() const { return !keys_.empty(); }
  const Scene& scene() const { return scene_; }
  /// That all know.
  const std::vector<InputEvent>& keys() const { return keys_; }
  peer::Cuts cuts(peer::PeerNumber peer_count) const;
  /// Plays the part of peer `number` of `peer_infos` to the end of `terms`; of those who come later
  /// `peer_infos` need not tell. Throws peer::ProtocolError, peer::Halt (of a newcomer that is not
  /// in yet peer::SentAway: it may ask again), and what `mail` throws.
  PlayedPart play(const Terms& terms, std::span<const PeerInfo> peer_infos, peer::PeerNumber number,
                  peer::Mail& mail, const PartOptions& part_options) const;

  /// Throws SceneError if windows are too long [s] for pucks that come back after a goal.
  void require_window(double window) const { goal_rules(window); }
  /// Everybody's keys as a log from which one engine plays the same game; `scene_text` is the
  /// scene's file.
  KeyLog record_of(const PlayedPart& part, const std::string& scene_text) const;

  /// What playing it is made of, for those who do so step by step: the game at its start; a peer
  /// that owns its part by `division` and knows all keys, whose first window ends with the first
  /// `window` [s]; and Game::hash() of a world that has come to `until` [s] under the keys that all
  /// know.
  const Game& start() const { return start_; }
  /// Gives up where bodies are at the start. Until the end of a play() that has called `when_taken`
  /// that is all it takes; nothing else may be begun with this game.
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
  std::vector<peer::Player> players(const Terms& terms, std::span<const PeerInfo> peer_infos) const;
  std::vector<peer::Seat> seats(const peer::Player& player) const;
  std::vector<InputEvent> keys_with(std::span<const peer::Handover> logs) const;
  std::uint64_t hash(std::uint64_t world, std::span<const InputEvent> keys, double until,
                     const peer::Scoring& scoring) const;
  void end(peer::Session& session, PlayedPart& part) const;

  Scene scene_;
  std::vector<InputEvent> keys_;  ///< in the order in which a Game applies them
  Game start_;                    ///< never advanced; without pucks once it is given up
  std::uint32_t forgotten_ = 0;   ///< then: how many entities there were, numbered from 0
  double extent_max_ = 0.0, speed_max_ = 0.0;  ///< of all bodies then [m, m/s]
};

}  // namespace rink::game
