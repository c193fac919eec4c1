// The server of a game over DDS: waits for its bots, plays a tick when it is due, publishes, and
// counts.
#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "game/net/server/serve_game.h"
#include "game/net/server_trace.h"
#include "loadgen/dds/dds_engine.h"
#include "loadgen/dds/domain.h"
#include "loadgen/dds/partition_grid.h"
#include "loadgen/dds/rtps_traffic.h"
#include "loadgen/dds/state_writers.h"

namespace rink::loadgen {

/// The field that `scene` is cut into cells over.
im::Region field_of(const game::Scene& scene);

/// The size of the cells that the options mean for `scene` [m]; 0: no partitions. Throws DdsError
/// if there would be too many.
double cell_size_of(const DdsServeOptions& options, const game::Scene& scene);

/// Keeps the server's evidence: ticks, and at drawn instants what the partitions let through.
class DdsServerRecorder {
 public:
  DdsServerRecorder(const DdsServeOptions& options, const game::ServedGame& played,
                    const game::Game& game);

  void note(const game::ServerTrace::Tick& tick, StateWriters& writers);
  void end(std::uint64_t state_hash) { trace_.state_hash = state_hash; }
  const game::ServerTrace& trace() const { return trace_; }

 private:
  bool takes_decisions_;
  game::ServerTrace trace_;
  std::vector<std::uint32_t> watched_;
  std::vector<double> instants_;
  std::size_t next_instant_ = 0;
};

class DdsServer {
 public:
  /// Throws DdsError, and DomainInUse.
  DdsServer(const DdsServeOptions& options, game::ServedGame& played, const DdsClock& now_s);

  std::uint32_t domain() const { return domain_.number(); }
  /// Waits for the bots; false if they did not come, or the user interrupted.
  bool gather();
  /// Plays to the end, or until the user interrupts.
  void run();

  std::size_t ready() const { return ready_.size(); }
  const game::Game& game() const { return game_; }
  nlohmann::ordered_json report(const std::string& why_invalid) const;
  const game::ServerTrace& trace() const { return recorder_.trace(); }

 private:
  struct Counted {
    RtpsTraffic sent, received;
    std::uint64_t states = 0, crossings = 0, loopback = 0;
  };
  struct Costs {
    double physics_s = 0.0, filter_s = 0.0, send_s = 0.0, from_s = 0.0, span_s = 0.0;
    std::uint64_t ticks = 0, on_time = 0, left_out = 0;
    Counted begin, end;
  };

  void say_session(double origin_s, bool is_over);
  void hear_until(double until_s);
  void hear();
  std::uint32_t present_count() const;
  void count_present();
  std::uint64_t ticks_left_out(std::uint64_t number, std::uint64_t last) const;
  void end_span();
  void bid_farewell();
  void tick(std::uint64_t number, bool is_counted);
  Counted counted() const;

  DdsServeOptions options_;
  game::ServedGame& played_;
  DdsClock now_s_;
  game::Game game_;
  double begin_s_;
  PartitionGrid grid_;
  Domain domain_;
  StateWriters writers_;
  Endpoint sessions_, inputs_;
  DdsEntity waiting_ = 0;
  std::set<std::uint32_t> ready_;
  std::uint64_t keys_ = 0;
  std::uint32_t lost_ = 0;
  double start_s_ = 0.0, gathering_s_ = 0.0;
  Costs costs_;
  RtpsTraffic gathering_;  ///< both ways, until the game began
  DdsServerRecorder recorder_;
};

}  // namespace rink::loadgen
