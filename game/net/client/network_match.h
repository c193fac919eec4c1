// A match on a server, shown and played in this process.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "game/match/match_source.h"
#include "game/match/noises.h"
#include "game/match/predicted_rink.h"
#include "game/match/shown_delay.h"
#include "game/match/sight.h"
#include "game/match/traffic_rate.h"
#include "game/net/client/client.h"
#include "game/net/client/host_link.h"
#include "game/net/client/hosted_scene.h"
#include "game/net/client/inspected_interest.h"

namespace rink::game {

struct NetworkMatchSettings {
  std::string federation = "rink", name = "player";
  bool only_watches = false;  ///< takes no bat; any federation of Rink can be watched, also one
                              ///< without matches
};

/// Owns the client federate and its link, and shows the match that they receive as PredictedRink
/// predicts it (docs/play.md). Reads no clock. A server that is gone, refuses, or sends an invalid
/// match ends in the phase `lost`, with the reason as `notice`.
class NetworkMatch final : public MatchSource {
 public:
  /// `connection` was opened by `transport`, which is polled here and has no other listener; it and
  /// the two others must outlive the match.
  NetworkMatch(const rti::Fom& fom, const ObjectModel& model, rti::Transport& transport,
               rti::ConnectionId connection, const NetworkMatchSettings& settings);

  void advance(double now_s) override;
  const MatchSight& sight() const override { return sight_; }
  std::uint32_t hand_count() const override { return settings_.only_watches ? 0 : 1; }
  /// Every hand moves the own bat.
  void press(std::uint32_t hand, Key key, bool is_down) override;
  void reach(std::uint32_t, const std::optional<Vector2>& place) override { hand_.reach(place); }
  std::string why_keys_alone() const override;
  void pause(bool is_wanted) override;
  void rematch() override;
  /// In a crowd only; the server is asked ten times a second.
  void inspect(std::uint32_t thing) override { inspected_.inspect(thing); }
  /// Resigns; nothing may follow.
  void leave(double now_s);

  const Client& client() const { return client_; }
  /// Null while no match is known.
  const PredictedRink* prediction() const { return rink_ ? &*rink_ : nullptr; }
  /// The scene that is played; null before it is known.
  const Scene* scene() const { return scene_.scene(); }
  /// The own player's number, once it is known.
  std::optional<std::uint32_t> player() const {
    const std::optional<SeatOffer>& seat = client_.joining().seat();
    return seat && !settings_.only_watches ? std::optional(seat->bat) : std::nullopt;
  }

 private:
  struct PressedKey {
    Key key;
    bool is_down;
  };

  static ClientSettings client_settings(const NetworkMatchSettings& settings);
  void receive(double now_s);
  bool read_scene();
  void press_keys(double instant);
  void push_bat(double now_s);
  void predict(double now_s);
  void move_delay(double dt);
  void show(double now_s);
  void show_bodies();
  void show_replicas(double now_s);
  void show_state(double now_s);
  void show_interest(double now_s);
  void show_link(double now_s);

  NetworkMatchSettings settings_;
  Client client_;
  HostLink host_;
  HostedScene scene_;
  std::optional<PredictedRink> rink_;
  MatchState state_;                ///< as last received
  std::uint32_t match_number_ = 0;  ///< that rink_ predicts
  std::uint64_t received_updates_ = 0;
  std::uint32_t caught_up_ = 0;  ///< stamps, in this frame
  std::vector<PressedKey> pressed_;
  HandSpring hand_;
  ShownDelay delay_;
  MatchSight sight_;
  NoiseDetector noises_;
  GoalWatch goals_;
  InspectedInterest inspected_;
  TrafficRate traffic_;
  double now_s_ = 0.0;
  double received_s_ = 0.0;  ///< real time of the newest stamp
  bool has_left_ = false;
};

}  // namespace rink::game
