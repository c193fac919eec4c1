// Any number of headless clients over one transport, each with a connection, a federate and a key
// plan of its own.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "game/model/key.h"
#include "loadgen/run/bots/bots_recorder.h"
#include "loadgen/run/bots/crowd.h"
#include "loadgen/run/bots/crowd_clock.h"
#include "loadgen/run/bots/decision_schedule.h"
#include "loadgen/run/bots/key_schedule.h"
#include "loadgen/run/bots/live_player.h"
#include "loadgen/run/bots/meter.h"
#include "rti/transport/transport.h"

namespace rink::loadgen {

struct BotCrowdSettings {
  std::string federation = "rink";
  std::uint32_t first = 0, count = 0;  ///< bots for bats first, first + 1, ...
  std::vector<std::string> names{};    ///< by bat, of those that bear others than the bats' own
  double view_fraction = 0.05, view_area = 0.0, view_margin = 0.0;  ///< see game::ClientSettings
  bool declares_regions = true;                                     ///< see game::ClientSettings
  bool extrapolates = true;                                         ///< see game::ClientSettings
  double start_s = 0.0;  ///< simulated time at which the game begins: earlier keys of the plan have
                         ///< been pressed
  double warm_up_s = 0.0;    ///< simulated time from which on things are counted
  double duration_s = 10.0;  ///< simulated time at which the bots stop
  LivePlayers players{};     ///< unless they are random, they decide for themselves and the plan is
                             ///< not looked at
  Crowd::Totals totals{};    ///< of connections that share sockets; null: each has its own
};

/// Drives the bots: connects them, presses their keys when due, and measures. Reads no clock
/// itself: `now_s` [s] returns the time that the server's stamps use.
class BotCrowd : public rti::TransportListener {
 public:
  using Clock = std::function<double()>;

  /// `plan`: the keys of all players, ordered by time; each bot takes those of its bat, unless it
  /// decides for itself.
  BotCrowd(const rti::Fom& fom, rti::Transport& transport, const BotCrowdSettings& settings,
           const std::vector<game::InputEvent>& plan, Clock now_s);

  /// Watches some of the bots, drawn from `seed`; call it before `connect`.
  void collect_trace(std::uint64_t seed);
  /// The trace of watched bots, if `collect_trace` was called.
  std::optional<game::BotsTrace> trace() const;
  std::size_t evidence_bytes() const { return recorder_ ? recorder_->memory_bytes() : 0; }

  /// Opens the connections and sends the joins.
  void connect(const Crowd::Connect& connect) { crowd_.connect(connect); }

  /// Waits for the transport, at most until the next key or decision is due, and handles what came;
  /// then presses what is due. Call it until `is_over`.
  void run_once();
  /// The next instant on the clock [s] at which `run_once` has something to do without an arrival;
  /// nothing if it only waits. Heartbeats, which are not urgent, are left out.
  std::optional<double> next_due_s() const;

  /// Simulated time 0 is `origin_s` on the clock; bots learn that from the first update otherwise,
  /// which a game in which little happens may send late.
  void start(double origin_s) {
    if (!has_started()) start_clock(origin_s, settings_.start_s);
  }
  bool has_started() const { return clock_.has_started(); }
  /// True when the duration has passed, or when no bot is left.
  bool is_over() const { return meter_.has_ended() || crowd_.are_all_lost(); }
  /// Makes every bot resign, so that the server sees an orderly end.
  void resign() { crowd_.resign(); }

  const Crowd& bots() const { return crowd_; }
  const Meter& meter() const { return meter_; }

 private:
  void on_open(rti::ConnectionId connection) override;
  void on_bytes(rti::ConnectionId connection, rti::Bytes bytes) override;
  void on_datagram(rti::ConnectionId connection, rti::Bytes datagram) override;
  void on_close(rti::ConnectionId connection, rti::CloseReason reason,
                const std::string& detail) override;

  game::ClientSettings client_settings(std::uint32_t bot) const;
  void note_news(Bot& bot, const rti::Stamp& stamp);
  void after_receiving(Bot& bot);
  void lose_if_over(Bot& bot);
  void advance_clocks();
  void start_clock(double origin_s, double simulated_s);
  void act_when_due();
  void press_due_keys();
  void decide_when_due();
  void decide(Bot& bot, double instant);
  void press(Bot& bot, std::span<const KeyChange> changes, double instant);
  void take_turn(Bot& bot);
  void follow_bats();
  void measure_span();
  void sample_when_due();

  const game::ObjectModel model_;
  rti::Transport& transport_;
  BotCrowdSettings settings_;
  Clock now_s_;
  Meter meter_;
  Crowd crowd_;
  CrowdClock clock_;
  KeySchedule keys_;
  DecisionSchedule decisions_;
  std::optional<BotsRecorder> recorder_;
  double clocks_advanced_s_ = 0.0, bats_followed_s_ = 0.0;
};

}  // namespace rink::loadgen
