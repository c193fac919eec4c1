// As that of bots over the RTI keeps it.
#include <algorithm>
#include <limits>

#include "game/net/sampling.h"
#include "loadgen/dds/dds_crowd.h"

namespace rink::loadgen {

DdsBotsRecorder::DdsBotsRecorder(const DdsBotsOptions& options)
    : is_wanted_(!options.trace.empty()), extrapolates_(options.extrapolates) {
  trace_.clients = options.count;
  trace_.from_s = options.start_s + options.warm_up_s;
  trace_.until_s = options.start_s + options.duration_s;
  const game::SamplingSettings sampling{.seed = options.seed,
                                        .clients = options.count,
                                        .from_s = trace_.from_s,
                                        .until_s = trace_.until_s};
  place_.assign(options.count, nobody);
  if (!is_wanted_) return;
  watched_ = game::sampled_players(sampling), instants_ = game::sampled_instants(sampling, 2);
  for (std::uint32_t place = 0; place < watched_.size(); ++place) place_[watched_[place]] = place;
  received_.resize(watched_.size());
  trace_.bots.resize(watched_.size());
}

double DdsBotsRecorder::next_sample_s() const {
  return next_instant_ < instants_.size() ? instants_[next_instant_]
                                          : std::numeric_limits<double>::infinity();
}

void DdsBotsRecorder::state_came(const DdsBot& bot, std::uint32_t body, double simulated_s) {
  const std::uint32_t place = place_[bot.number()];
  if (place != nobody && simulated_s >= next_sample_s() - window_s)
    received_[place].push_back({simulated_s, body});
}

void DdsBotsRecorder::scope_changed(const DdsBot& bot, std::uint32_t body, bool is_in,
                                    double simulated_s) {
  const std::uint32_t place = place_[bot.number()];
  if (place != nobody) trace_.bots[place].changes.push_back({simulated_s, body, is_in});
}

void DdsBotsRecorder::sample(const std::vector<std::unique_ptr<DdsBot>>& bots, double simulated_s) {
  if (simulated_s < next_sample_s()) return;
  for (std::uint32_t place = 0; place < watched_.size(); ++place)
    look_into(place, *bots[watched_[place]], simulated_s);
  while (next_sample_s() <= simulated_s) ++next_instant_;
}

void DdsBotsRecorder::look_into(std::uint32_t place, const DdsBot& bot, double simulated_s) {
  std::vector<std::uint32_t> updates(bot.replicas().size());
  for (const Received& each : received_[place])
    if (each.instant_s > simulated_s - window_s && each.body < updates.size()) ++updates[each.body];
  received_[place].clear();
  const double matched_s = 1e-9 * static_cast<double>(bot.newest_ns());
  const std::size_t first = trace_.replicas.size();
  for (std::uint32_t body = 0; body < bot.replicas().size(); ++body) {
    const DdsReplica& replica = bot.replicas()[body];
    if (!replica.is_known && updates[body] == 0) continue;
    game::BotsTrace::Replica seen{
        .object = body, .bytes = state_bytes * updates[body], .is_in_scope = replica.is_known};
    if (replica.is_known)
      seen.matched = replica.position_at(matched_s, extrapolates_),
      seen.displayed = replica.position_at(simulated_s, extrapolates_);
    trace_.replicas.push_back(seen);
  }
  trace_.samples.push_back({.bot = place,
                            .displayed_s = simulated_s,
                            .matched_s = matched_s,
                            .window_s = window_s,
                            .first = first,
                            .last = trace_.replicas.size()});
}

game::BotsTrace DdsBotsRecorder::trace(const std::vector<std::unique_ptr<DdsBot>>& bots) const {
  game::BotsTrace result = trace_;
  for (std::size_t place = 0; place < watched_.size(); ++place)
    if (const auto& session = bots[watched_[place]]->session())
      result.bots[place].object = session->body;
  return result;
}

}  // namespace rink::loadgen
