// A game that peers share, shown and played in a window of one of them.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "game/match/match_source.h"
#include "game/match/noises.h"
#include "game/match/predicted_rink.h"
#include "game/match/server_clock.h"
#include "game/match/shown_delay.h"
#include "game/match/sight.h"
#include "game/match/traffic_rate.h"
#include "game/net/peer/input_queue.h"
#include "game/net/peer/shared_game.h"

namespace rink::game {

/// Shows the bodies and replicas of the peer on the other side of `input`, and the own bat at the
/// instant at which a key that is pressed now takes effect (docs/play.md, "Among peers"). Never
/// waits for a window, and reads no clock.
class PeerMatch final : public MatchSource {
 public:
  /// Both must outlive it.
  PeerMatch(const SharedGame& game, InputQueue& input);

  void advance(double now_s) override;
  const MatchSight& sight() const override { return sight_; }
  std::uint32_t hand_count() const override { return 1; }
  void press(std::uint32_t hand, Key key, bool is_down) override;
  /// Without effect, since others play on.
  void pause(bool) override {}
  void rematch() override {}

  /// Null before the first window's end.
  const PredictedRink* prediction() const { return rink_ ? &*rink_ : nullptr; }

 private:
  static constexpr std::uint32_t nobody = 0xffffffffu;
  /// A body of the scene, and its newest state.
  struct Known {
    physics::BodyKind kind = physics::BodyKind::post;
    std::uint32_t number = 0;  ///< among its kind
    std::uint64_t window = 0;  ///< of its newest state; 0: none yet
    bool is_in_play = true, is_near = false;
    double near_since = 0.0;         ///< s: since then it is predicted
    physics::Motion motion, before;  ///< the newest, and that of the window before
    Vector2 at(double instant) const;
  };
  struct PressedKey {
    Key key;
    bool is_down;
  };

  void receive(PeerSight news);
  ReceivedRink received();
  void add_body(const KnownBody& body, ReceivedRink& received);
  void predict(double now_s);
  void press_keys(double instant);
  void move_delay(double dt);
  void show(double now_s);
  void show_things();
  void show_thing(std::uint32_t body);
  void show_stage(double now_s);
  void show_link(double now_s);
  bool is_playing() const { return stage_.step == PeerStage::Step::playing; }

  const SharedGame& game_;
  InputQueue& input_;
  PeerStage stage_;
  ServerClock clock_;
  ShownDelay delay_;
  std::optional<PredictedRink> rink_;
  std::optional<PeerSight> news_;
  std::vector<Known> known_;       ///< by body
  std::vector<Thing> all_things_;  ///< by body
  std::vector<PressedKey> pressed_;
  MatchSight sight_;
  NoiseDetector noises_;
  GoalWatch goals_;
  TrafficRate traffic_;
  double now_s_ = 0.0;
  double received_s_ = 0.0;  ///< real time of the newest news
  double stage_s_ = 0.0, notice_s_ = -1e9;
  std::uint32_t notice_count_ = 0;
};

}  // namespace rink::game
