// Samples decisions at seeded instants, of as many players as the limit of memory allows.
#include "game/net/server/server_recorder.h"

#include <algorithm>

namespace rink::game {

ServerRecorder::ServerRecorder(const SamplingSettings& settings, double rate_hz)
    : settings_(settings),
      tick_s_(1.0 / rate_hz),
      players_(sampled_players(settings)),
      instants_(sampled_instants(settings, 1)) {
  trace_.clients = settings.clients;
  trace_.rate_hz = rate_hz;
  trace_.from_s = settings.from_s;
  trace_.until_s = settings.until_s;
  trace_.ticks.reserve(static_cast<std::size_t>(
      std::min((settings.until_s - settings.from_s) * rate_hz + 2.0, 1e6)));
}

void ServerRecorder::look(const Server& server, const rti::FederationExecution& execution,
                          const ServerTrace::Tick& tick) {
  name_objects(server);
  trace_.end_s = tick.simulated_s;
  const bool is_measured =
      tick.simulated_s >= settings_.from_s && tick.simulated_s < settings_.until_s;
  if (is_measured && trace_.ticks.size() < settings_.record_max) trace_.ticks.push_back(tick);
  for (; next_instant_ < instants_.size() && instants_[next_instant_] < tick.simulated_s + tick_s_;
       ++next_instant_)
    if (instants_[next_instant_] >= tick.simulated_s)
      note_decisions(server, execution, instants_[next_instant_]);
}

/// Names all entities at first, then new ones; a bat that comes back is another body and another
/// object.
void ServerRecorder::name_objects(const Server& server) {
  const auto name = [&](const Entity& entity) {
    trace_.objects.push_back({server.publisher().object(entity.id).value, entity.id.index});
  };
  if (!are_named_) {
    for (const Entity& entity : server.game().entities()) name(entity);
    trace_.in_scope.reserve(
        std::min(settings_.record_max, instants_.size() * players_.size() * trace_.objects.size()));
  } else {
    for (const Entity& entity : server.game().spawned())
      if (server.game().is_there(entity.id)) name(entity);
  }
  are_named_ = true;
}

void ServerRecorder::note_decisions(const Server& server, const rti::FederationExecution& execution,
                                    double instant_s) {
  if (players_.empty()) return;
  const std::size_t largest = std::max<std::size_t>(1, instants_.size() * trace_.objects.size());
  const std::size_t at_once =
      std::clamp<std::size_t>(settings_.record_max / largest, 1, players_.size());
  for (std::size_t i = 0; i < at_once; ++i, ++next_player_) {
    const std::uint32_t player = players_[next_player_ % players_.size()];
    const auto federate = server.seats().federate_of(player);
    if (!federate || !server.game().bat(player)) continue;
    listed_.clear();
    execution.list_scope(*federate, listed_);
    if (trace_.in_scope.size() + listed_.size() > 2 * settings_.record_max) return;
    const std::size_t first = trace_.in_scope.size();
    for (const rti::ObjectHandle object : listed_) trace_.in_scope.push_back(object.value);
    trace_.decisions.push_back({instant_s, player, first, trace_.in_scope.size()});
  }
}

ServerTrace ServerRecorder::trace(const Server& server) const {
  ServerTrace result = trace_;
  result.state_hash = server.game().hash();
  result.keys = server.keys().recorded();
  for (const ServerTrace::Decision& decision : result.decisions)
    std::sort(result.in_scope.begin() + static_cast<std::ptrdiff_t>(decision.first),
              result.in_scope.begin() + static_cast<std::ptrdiff_t>(decision.last));
  return result;
}

std::size_t ServerRecorder::memory_bytes() const {
  const ServerTrace& held = trace_;
  return held.ticks.capacity() * sizeof(ServerTrace::Tick) +
         held.objects.capacity() * sizeof(ServerTrace::Naming) +
         held.decisions.capacity() * sizeof(ServerTrace::Decision) +
         held.in_scope.capacity() * sizeof(std::uint32_t);
}

}  // namespace rink::game
