// What a player is shown of a match over a delayed network, beside the truth (docs/play.md):
// errors, visible corrections and bytes are the counters.
#include <benchmark/benchmark.h>

#include <cstdio>

#include "game/model/scene_file.h"
#include "game/net/fom_file.h"
#include "game/replication/trajectory_codec.h"
#include "loadgen/duel/feel.h"

namespace rink::bench::play_bench {
namespace {

using namespace rink;

/// Two minutes between two chasers, each on what it is shown; the time is that of server, network
/// and both clients together.
void feel(benchmark::State& state, double delay_s, double jitter_s) {
  const rti::Fom fom = game::load_rink_fom(game::fom_file());
  const game::Scene scene = game::load_scene("paper");
  loadgen::Feel feel;
  for (auto _ : state)
    feel = loadgen::feel_of(
        fom, scene, game::scene_text("paper"),
        {.delay_s = delay_s, .jitter_s = jitter_s, .players = {"chaser", "chaser"}}, 120.0);
  if (!feel.is_replayed) state.SkipWithError("the record led to another hash");
  state.counters["played_s"] = feel.played_s;
  state.counters["own_p50_mm"] = 1e3 * feel.own.p50;
  state.counters["own_p90_mm"] = 1e3 * feel.own.p90;
  state.counters["own_p99_mm"] = 1e3 * feel.own.p99;
  state.counters["own_max_mm"] = 1e3 * feel.own.greatest;
  state.counters["corrections_per_min"] = feel.corrections_per_min;
  state.counters["correction_mm"] = 1e3 * feel.correction_mean;
  state.counters["correction_max_mm"] = 1e3 * feel.correction_greatest;
  state.counters["other_p99_mm"] = 1e3 * feel.other.p99;
  state.counters["other_corrections_per_min"] = feel.other_corrections_per_min;
  state.counters["puck_p50_mm"] = 1e3 * feel.puck.p50;
  state.counters["puck_p90_mm"] = 1e3 * feel.puck.p90;
  state.counters["puck_p99_mm"] = 1e3 * feel.puck.p99;
  state.counters["puck_corrections_per_min"] = feel.puck_corrections_per_min;
  state.counters["puck_correction_mm"] = 1e3 * feel.puck_correction_mean;
  state.counters["lead_ms"] = 1e3 * feel.lead_s;
  state.counters["bytes_per_s"] = feel.payload_bytes_per_s;
  state.counters["keys"] = static_cast<double>(feel.keys);
  state.counters["late_keys"] = static_cast<double>(feel.late_keys);
}

const bool registered = [] {
  for (const int delay_ms : {0, 50, 100, 200})
    for (const int jitter_ms : {0, 20}) {
      char text[96];
      std::snprintf(text, sizeof text, "play/feel/delay_ms:%d/jitter_ms:%d", delay_ms, jitter_ms);
      benchmark::RegisterBenchmark(
          text, [=](benchmark::State& state) { feel(state, 1e-3 * delay_ms, 1e-3 * jitter_ms); })
          ->Iterations(1)
          ->UseRealTime()
          ->Unit(benchmark::kMillisecond);
    }
  return true;
}();

}  // namespace
}  // namespace rink::bench::play_bench
