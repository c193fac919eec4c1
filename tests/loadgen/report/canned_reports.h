// Reports of a server and its bots as a healthy run of one cell writes them, for tests to spoil.
#pragma once

#include <nlohmann/json.hpp>

#include "loadgen/experiment/experiment.h"
#include "loadgen/measure/statistics/histogram.h"

namespace rink::loadgen {

inline nlohmann::json canned_server_report(const Cell& cell) {
  return {{"mode", cell.mode},
          {"scheme", cell.scheme},
          {"policy", cell.policy},
          {"clients", cell.clients},
          {"entities", 1100},
          {"seed", cell.seed},
          {"tick_rate_hz", 30.0},
          {"ticks", 60},
          {"ticks_on_time_fraction", 1.0},
          {"physics_us_per_tick", 300.0},
          {"filter_us_per_tick", 50.0},
          {"send_us_per_tick", 200.0},
          {"server_rss_bytes", 12'000'000},
          {"state_hash", "00112233445566aa"},
          {"measured_s", 2.0},
          {"bytes_sent", 400'000},
          {"bytes_received", 4'000},
          {"writes_sent", 600},
          {"segments_sent", 1'000},
          {"messages_sent", 5'000},
          {"kernel_segments_sent", 600},
          {"acknowledgements_sent", 40},
          {"kernel_bytes_sent", 500'000},
          {"kernel_bytes_received", 5'000},
          {"total_bytes_sent", 500'000},
          {"total_bytes_received", 5'000},
          {"lost_federates", 0},
          {"dropped_connections", 0},
          {"keys_received", 70},
          {"keys_applied", 700},
          {"valid", true},
          {"why_invalid", ""}};
}

inline nlohmann::json canned_bots_report(const Cell& cell) {
  Histogram ages, effects, lateness;
  ages.record(0.010, 2'000);
  effects.record(0.040, 30);
  lateness.record(0.0002, 70);
  return {{"clients", cell.clients},
          {"measured_s", 2.0},
          {"bytes_received", 400'000},
          {"bytes_sent", 4'000},
          {"segments_sent", 100},
          {"kernel_segments_sent", 100},
          {"acknowledgements_sent", 300},
          {"updates_received", 30'000},
          {"update_age_ms", ages.to_json()},
          {"key_to_effect_ms", effects.to_json()},
          {"keys_due", 70},
          {"keys_sent", 70},
          {"late_sends_fraction", 0.0},
          {"send_lateness_ms", lateness.to_json()},
          {"schedule_trouble", ""},
          {"federates_lost", 0},
          {"kernel_bytes_received", 500'000},
          {"kernel_bytes_sent", 5'000},
          {"total_bytes_received", 500'000},
          {"total_bytes_sent", 5'000},
          {"valid", true},
          {"why_invalid", ""}};
}

inline Experiment small_experiment() {
  Experiment experiment;
  experiment.name = "small";
  experiment.scene = "crowd";
  experiment.duration_s = 0.2;
  experiment.warm_up_s = 0.0;
  return experiment;
}

}  // namespace rink::loadgen
