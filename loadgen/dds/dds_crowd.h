// All bots of a process over DDS: waits for what comes and is due, measures, and takes samples for
// the evidence.
#pragma once

#include <cstdint>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "game/net/bots_trace.h"
#include "loadgen/dds/dds_bot.h"
#include "loadgen/dds/rtps_traffic.h"
#include "loadgen/run/bots/probe.h"

namespace rink::loadgen {

/// Keeps the evidence of some of the bots: what came into their replicas and left, and at drawn
/// instants what these hold.
class DdsBotsRecorder {
 public:
  static constexpr std::uint32_t state_bytes = 60;  ///< of a state's submessage and time stamp

  explicit DdsBotsRecorder(const DdsBotsOptions& options);

  void state_came(const DdsBot& bot, std::uint32_t body, double simulated_s);
  void scope_changed(const DdsBot& bot, std::uint32_t body, bool is_in, double simulated_s);
  /// Infinity if there is none.
  double next_sample_s() const;
  void sample(const std::vector<std::unique_ptr<DdsBot>>& bots, double simulated_s);
  game::BotsTrace trace(const std::vector<std::unique_ptr<DdsBot>>& bots) const;

 private:
  static constexpr std::uint32_t nobody = 0xffffffffu;
  static constexpr double window_s = 0.05;  ///< before a sample, in which updates are counted
  struct Received {
    double instant_s;
    std::uint32_t body;
  };

  void look_into(std::uint32_t place, const DdsBot& bot, double simulated_s);

  bool is_wanted_, extrapolates_;
  std::vector<std::uint32_t> place_;             ///< by bot: among the watched, or nobody
  std::vector<std::vector<Received>> received_;  ///< by place
  std::vector<std::uint32_t> watched_;
  std::vector<double> instants_;
  std::size_t next_instant_ = 0;
  game::BotsTrace trace_;
};

class DdsCrowd : private DdsBot::Listener {
 public:
  /// `plan` is ordered by time. Throws DdsError.
  DdsCrowd(const DdsBotsOptions& options, const std::vector<game::InputEvent>& plan,
           const DdsClock& now_s);

  /// Handles what came, waiting for it no longer than until something is due.
  void run_once();
  bool has_started() const { return origin_s_.has_value(); }
  /// True when the duration has passed, the server says so, or it has gone (`is_left`).
  bool is_over() const { return is_over_; }
  bool is_left() const { return is_left_; }

  /// Closes what is measured, if nothing else did.
  void end() {
    if (!is_over_) end_span();
  }
  nlohmann::ordered_json report(const std::string& why_invalid) const;
  game::BotsTrace trace() const { return recorder_.trace(bots_); }
  const Measurements& measurements() const { return measured_; }
  /// For tests: the bots, whose replicas can be compared with what was published.
  const std::vector<std::unique_ptr<DdsBot>>& bots() const { return bots_; }

 private:
  struct Counted {
    RtpsTraffic sent, received;
    std::vector<std::uint64_t> states;  ///< by bot
  };

  void state_came(const DdsBot& bot, std::uint32_t body, std::int64_t stamp_ns) override;
  void scope_changed(const DdsBot& bot, std::uint32_t body, bool is_in) override;

  double simulated_s() const;
  double next_due_s() const;
  void start_when_said();
  void measure_span();
  void end_span();
  void press_due_keys();
  Counted counted() const;

  DdsBotsOptions options_;
  DdsClock now_s_;
  DdsEntity waiting_;
  std::vector<std::unique_ptr<DdsBot>> bots_;
  std::vector<std::intptr_t> triggered_;
  KeySchedule keys_;
  Measurements measured_;
  std::vector<Probe> probes_;          ///< by bot
  std::vector<std::int64_t> told_ns_;  ///< by bot: the newest tick with news
  DdsBotsRecorder recorder_;
  std::optional<double> origin_s_, measured_from_s_;
  double begin_s_ = 0.0, span_s_ = 0.0, looked_s_ = 0.0;
  Counted begin_, end_;
  bool is_over_ = false, is_left_ = false;
};

}  // namespace rink::loadgen
