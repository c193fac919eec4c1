// As the RTI's server keeps it.
#include <algorithm>
#include <iterator>

#include "game/net/sampling.h"
#include "loadgen/dds/dds_server.h"

namespace rink::loadgen {

DdsServerRecorder::DdsServerRecorder(const DdsServeOptions& options, const game::ServedGame& played,
                                     const game::Game& game)
    : takes_decisions_(!options.trace.empty()) {
  const double from_s = game.now() + options.warm_up_s, until_s = game.now() + options.duration_s;
  const game::SamplingSettings sampling{
      .seed = options.seed, .clients = options.clients, .from_s = from_s, .until_s = until_s};
  watched_ = game::sampled_players(sampling), instants_ = game::sampled_instants(sampling, 1);
  trace_.choice = played.choice;
  trace_.state_file = options.from_state, trace_.state = played.state;
  trace_.scheme = options.scheme, trace_.policy = "periodic";
  trace_.clients = options.clients, trace_.rate_hz = options.rate_hz;
  trace_.from_s = from_s, trace_.until_s = until_s;
  trace_.keys = *played.replay;
  for (const game::Entity& entity : game.entities())
    trace_.objects.push_back({entity.id.index, entity.id.index});
}

void DdsServerRecorder::note(const game::ServerTrace::Tick& tick, StateWriters& writers) {
  const double until_s = tick.simulated_s + 1.0 / trace_.rate_hz;
  trace_.end_s = tick.simulated_s;
  if (tick.simulated_s >= trace_.from_s && tick.simulated_s < trace_.until_s)
    trace_.ticks.push_back(tick);
  for (; takes_decisions_ && next_instant_ < instants_.size() && instants_[next_instant_] < until_s;
       ++next_instant_) {
    if (instants_[next_instant_] < tick.simulated_s) continue;
    auto scopes = writers.scopes();
    for (const std::uint32_t player : watched_) {
      const std::size_t first = trace_.in_scope.size();
      std::ranges::copy(scopes[player], std::back_inserter(trace_.in_scope));
      trace_.decisions.push_back({instants_[next_instant_], player, first, trace_.in_scope.size()});
    }
  }
}

}  // namespace rink::loadgen
