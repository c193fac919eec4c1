// rink serve while it runs: the clients' transport, the wall clock, and the loop that ticks.
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "game/control/match_records.h"
#include "game/net/server/overload/output_rates.h"
#include "game/net/server/overload/overload_control.h"
#include "game/net/server/serve_game.h"
#include "game/net/server/serve_options.h"
#include "game/net/server/serve_report.h"
#include "game/net/server/serving.h"
#include "game/net/server_trace.h"
#include "rti/second_core.h"
#include "rti/transport/socket_transport.h"
#include "rti/transport/staged/ledger_stage.h"
#include "rti/transport/staged/stagger.h"

namespace rink::game {

/// The costs of the run, summed over the measured ticks.
struct Costs {
  std::uint64_t ticks = 0, ticks_on_time = 0, ticks_left_out = 0;
  double physics_s = 0.0, filter_s = 0.0, send_s = 0.0, send_max_s = 0.0;
  double from_s = 0.0,
         span_s = 0.0;  ///< the measured span: when it began on the clock, and its length
  double game_from_s = 0.0, game_span_s = 0.0;  ///< the same of simulated time
  bool has_ended = false;
  ServingCounts begin, end;
};

/// The server process: the clients' transport, the wall clock, and the loop that ticks.
class ServerProcess {
 public:
  ServerProcess(const ServeOptions& options, const rti::Fom& fom, const ServedGame& played,
                const std::string& federation);

  /// Reports at once if matches cannot be recorded; they can be played all the same.
  void try_records();
  std::uint16_t listen() { return sockets_.listen(options_.address, options_.port); }

  /// Waits for the players and the start barrier; false if they did not all come in time.
  bool start();
  void run();
  /// Of a node: shows what is left of the game that all have played.
  void show_rest();
  /// Lets the clients resign.
  void end();

  const Server& server() const { return server_; }
  /// The federates in the federation file that have not joined, as a clause of an error; empty if
  /// none.
  std::string missing() const;
  nlohmann::ordered_json report() const;
  /// The trace of the run and of its filter's decisions, if `--evidence` asked for it.
  std::optional<ServerTrace> trace(const ServedGame& played) const;
  /// The traffic of all connections from first to last.
  rti::TransportCounters totals() const { return sockets_.totals(); }

 private:
  double simulated_now() const;
  void wait(double seconds);
  void exchange_until(double until_s);
  void await_turns();
  void await_window(double due_s, double until);
  std::uint64_t leave_out(std::uint64_t number, std::uint64_t last, bool is_counted);
  void tick(std::uint64_t number, bool is_counted);
  double catch_up(double simulated_s, double& physics_s);
  void follow_load(double due_s, double begin_s, double telling_s);
  void end_span();
  ServingCounts counts() const;
  double goal(std::uint64_t number) const;
  bool has_ended() const;
  void fall_behind(double elapsed_s, double simulated_s);
  void keep_records();
  void report_flood();

  ServeOptions options_;
  double begin_s_;  ///< simulated instant at which the game begins
  rti::SocketTransport sockets_;
  std::optional<rti::SecondCore> second_core_;
  Serving serving_;
  rti::StagedTransport clients_;
  rti::LedgerStage* ledger_;  ///< null unless the report says where the bytes go
  rti::Stagger& stagger_;
  Server& server_;
  MatchRecords records_;
  SharedPlay* shared_;  ///< null: this server alone plays
  double start_s_ = 0.0;
  double behind_s_ = 0.0;            ///< simulated time that was lost to the physics' budget
  std::uint64_t ticks_put_off_ = 0;  ///< under time management: it, in ticks
  mutable double latest_s_ = 0.0;    ///< that simulated_now() has returned
  bool is_flood_reported_ = false;
  std::optional<OverloadControl> overload_;  ///< unless clients need every tick
  OutputRates output_rates_;
  Costs costs_;
};

}  // namespace rink::game
