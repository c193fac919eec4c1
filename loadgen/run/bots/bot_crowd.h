// Any number of headless clients over one transport, each with a connection, a federate and a key
// plan of its own.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "game/control/key_log.h"
#include "game/net/client/client.h"
#include "game/net/exit_status.h"
#include "loadgen/run/bots/bots_witness.h"
#include "loadgen/run/bots/live_player.h"
#include "loadgen/run/bots/probe.h"
#include "rti/transport/federate_link.h"
#include "rti/transport/socket_transport.h"
#include "rti/transport/transport.h"

namespace rink::loadgen {

struct BotCrowdSettings {
  std::string federation = "rink";
  std::uint32_t first = 0;           ///< the bots play bats first, first + 1, ...
  std::vector<std::string> names{};  ///< by bat, of those that bear others than the bats' own
  double view_fraction = 0.05, view_area = 0.0, view_margin = 0.0;  ///< see game::ClientSettings
  bool declares_regions = true;                                     ///< likewise
  bool extrapolates = true;                                         ///< likewise
  double start_s = 0.0;  ///< simulated time at which the game begins: what the plan says up to then
                         ///< has been pressed
  double warm_up_s = 0.0;    ///< simulated time from which on things are counted
  double duration_s = 10.0;  ///< simulated time at which the bots stop
  LivePlayers players{};     ///< unless they are random, they decide for themselves and the plan is
                             ///< not looked at
};

/// What the connections of a crowd carried, summed.
struct CrowdTraffic {
  std::uint64_t bytes_sent = 0, bytes_received = 0, segments_sent = 0, kernel_bytes_sent = 0,
                kernel_bytes_received = 0, updates_received = 0;
  std::uint64_t acknowledgements_sent = 0, kernel_segments_sent = 0;
};

/// Drives the bots: connects them, presses their keys when due, and measures. Reads no clock: it is
/// handed `now_s` [s], the clock that the server's stamps use.
class BotCrowd : public rti::TransportListener {
 public:
  using Connect = std::function<rti::ConnectionId(std::uint32_t bot)>;
  using Clock = std::function<double()>;

  /// `plan`: the keys of all players, ordered by time; each bot takes those of its bat, unless it
  /// decides for itself.
  BotCrowd(const rti::Fom& fom, rti::Transport& transport, const BotCrowdSettings& settings,
           std::uint32_t count, const std::vector<game::InputEvent>& plan, Clock now_s);

  /// Watches some of the bots, drawn from `seed`; to be called before `connect`.
  void collect_evidence(std::uint64_t seed);
  /// What they heard and believed, if it was asked for.
  std::optional<BotsEvidence> evidence() const;
  std::size_t evidence_bytes() const { return witness_ ? witness_->memory_bytes() : 0; }

  /// Opens the connections and sends the joins.
  void connect(const Connect& connect);

  /// Waits for the transport, at most until the next key or decision is due, and handles what came;
  /// then presses what is due. Call it until `is_over`.
  void run_once();
  /// The instant on the clock [s] from which on `run_once` has something to do though nothing came;
  /// nothing if it only waits. Heartbeats, which are not urgent, are left out.
  std::optional<double> next_due_s() const;

  /// True when the duration has passed, or when no bot is left.
  bool is_over() const;
  /// Makes every bot resign, so that the server sees an orderly end.
  void resign();

  std::uint32_t bot_count() const { return static_cast<std::uint32_t>(bots_.size()); }
  std::uint32_t lost_count() const { return lost_; }
  /// Why the first bot that was lost or refused was; empty if none was.
  const std::string& first_trouble() const { return first_trouble_; }
  game::ExitStatus first_status() const { return first_status_; }
  /// True from the beginning of the measured span to its end.
  bool is_measuring() const { return span_begin_s_.has_value() && !is_measured_; }
  bool has_started() const { return origin_s_.has_value(); }

  const Measurements& measurements() const { return measurements_; }
  std::uint64_t unanswered_keys() const;
  /// Within the measured span, and its length on the clock [s].
  const CrowdTraffic& traffic() const { return measured_; }
  double measured_s() const { return measured_s_; }
  /// Payload received by each bot within the measured span.
  const std::vector<std::uint64_t>& bytes_received_by_bot() const { return received_by_bot_; }
  /// Since the start, now.
  CrowdTraffic total_traffic() const;
  /// What all clients keep of the world, with their buffers [bytes].
  std::size_t client_memory_bytes() const;

 private:
  struct Bot {
    Bot(const rti::Fom& fom, const game::ObjectModel& model, const game::ClientSettings& settings,
        Measurements& measurements)
        : client(fom, model, settings), probe(measurements) {}
    game::Client client;
    Probe probe;
    rti::ConnectionId connection = 0;
    std::array<std::uint64_t, 16> seen_tags{};  ///< of the ticks that brought news last
    std::size_t next_seen = 0;
    bool is_lost = false;
    std::optional<LivePlayer> player;
    game::KeysHeld held;           ///< by a player who decides
    std::size_t next_key = 0;      ///< of the plan, where the server waits for turns
    double next_decision_s = 0.0;  ///< the same
  };
  struct KeyChange {
    game::Key key;
    bool is_down;
  };
  struct DueKey {
    double time;
    std::uint32_t bot;
    KeyChange change;
  };

  void on_open(rti::ConnectionId connection) override;
  void on_bytes(rti::ConnectionId connection, rti::Bytes bytes) override;
  void on_datagram(rti::ConnectionId connection, rti::Bytes datagram) override;
  void on_close(rti::ConnectionId connection, rti::CloseReason reason,
                const std::string& detail) override;

  void note_news(Bot& bot, const rti::Stamp& stamp);
  void after_receiving(Bot& bot);
  void send(Bot& bot);
  void lose(Bot& bot, const std::string& why, game::ExitStatus status);
  void advance_clocks();
  void start_clock(double origin_s, double simulated_s);
  void act_when_due();
  void press_due_keys();
  void decide_when_due();
  void decide(Bot& bot, double instant);
  void press(Bot& bot, std::span<const KeyChange> changes, double instant);
  void take_turn(Bot& bot);
  bool has_come(double simulated_s) const;
  double simulated_now() const;
  double next_decision() const;
  void follow_bats();
  void measure_span();
  void sample_when_due();
  std::vector<std::uint64_t> received_by_bot() const;
  double due_s(double simulated_s) const { return *origin_s_ + simulated_s; }

  const game::ObjectModel model_;
  rti::Transport& transport_;
  BotCrowdSettings settings_;
  Clock now_s_;
  Measurements measurements_;
  std::vector<std::unique_ptr<Bot>> bots_;
  std::vector<std::uint32_t> bot_of_connection_;
  std::vector<DueKey> plan_;
  std::size_t next_key_ = 0;
  std::vector<std::uint32_t>
      decision_order_;              ///< bots by the phase of their decisions; empty if none decides
  std::uint64_t next_turn_ = 0;     ///< decisions made by all; bots take turns
  std::optional<double> origin_s_;  ///< the clock at simulated time 0, from the first stamp
  bool is_synchronous_ = false;     ///< the server waits for turns: simulated time is that of the
                                    ///< newest, no matter the clock
  double turn_s_ = 0.0;
  std::optional<double> span_begin_s_;
  CrowdTraffic at_begin_, measured_;
  std::vector<std::uint64_t> received_by_bot_;  ///< at the span's begin, then within it
  std::optional<BotsWitness> witness_;
  double measured_s_ = 0.0;
  bool is_measured_ = false;
  std::uint32_t lost_ = 0;
  std::string first_trouble_;
  game::ExitStatus first_status_ = game::ExitStatus::no_server;
  double clocks_advanced_s_ = 0.0, bats_followed_s_ = 0.0;
};

}  // namespace rink::loadgen
