// Samples every n-th entity, from a drawn one on, of a replica set with more than a sample may
// have.
#include "loadgen/run/bots/bots_recorder.h"

#include <algorithm>
#include <limits>

#include "game/model/random_stream.h"

namespace rink::loadgen {

BotsRecorder::BotsRecorder(const game::SamplingSettings& settings,
                           const std::vector<game::Client*>& clients)
    : settings_(settings),
      place_(clients.size(), nobody),
      instants_(game::sampled_instants(settings, 2)) {
  for (const std::uint32_t bot : game::sampled_players(settings)) {
    place_[bot] = static_cast<std::uint32_t>(clients_.size());
    clients_.push_back(clients[bot]);
    clients[bot]->received().watch();
  }
  received_.resize(clients_.size());
  matched_s_.resize(clients_.size());
  awaited_.resize(clients_.size());
  trace_.bots.resize(clients_.size());
  trace_.clients = settings.clients;
  trace_.from_s = settings.from_s;
  trace_.until_s = settings.until_s;
  trace_.samples.reserve(instants_.size() * clients_.size());
}

void BotsRecorder::listen(std::uint32_t bot, std::optional<double> simulated_s) {
  const std::uint32_t place = place_[bot];
  game::Client& client = *clients_[place];
  const double instant_s = simulated_s.value_or(-1.0);
  std::vector<rti::ObjectHandle>& awaited = awaited_[place];
  for (const game::ReceiptLog::Scope& scope : client.received().scopes()) {
    if (scope.is_in) awaited.push_back(scope.object);
    else if (std::erase(awaited, scope.object) == 0)
      note(place, {instant_s, scope.object.value, false});
  }
  std::erase_if(awaited, [&](rti::ObjectHandle object) {
    const game::EntityReplica* const entity = client.replicas().find(object);
    if (entity != nullptr && !entity->is_placed) return false;
    note(place, {instant_s, object.value, true});
    return true;
  });
  if (next_instant_ < instants_.size() && instant_s >= instants_[next_instant_] - window_s)
    for (const game::ReceiptLog::Update& update : client.received().updates())
      received_[place].push_back({instant_s, update.object.value, update.bytes});
  if (simulated_s) matched_s_[place] = std::max(matched_s_[place], client.replicas().newest().time);
  client.received().forget();
}

void BotsRecorder::note(std::uint32_t place, const game::BotsTrace::ScopeChange& change) {
  if (++change_count_ > settings_.record_max) trace_.is_complete = false;
  else trace_.bots[place].changes.push_back(change);
}

double BotsRecorder::next_sample_s() const {
  return next_instant_ < instants_.size() ? instants_[next_instant_]
                                          : std::numeric_limits<double>::infinity();
}

void BotsRecorder::sample(double simulated_s) {
  if (simulated_s < next_sample_s()) return;
  for (std::uint32_t place = 0; place < clients_.size(); ++place) look_into(place, simulated_s);
  while (next_instant_ < instants_.size() && instants_[next_instant_] <= simulated_s)
    ++next_instant_;
}

void BotsRecorder::look_into(std::uint32_t place, double simulated_s) {
  std::vector<Received>& received = received_[place];
  std::erase_if(received,
                [&](const Received& update) { return update.instant_s <= simulated_s - window_s; });
  std::sort(received.begin(), received.end(),
            [](const Received& a, const Received& b) { return a.object < b.object; });
  constexpr std::size_t replicas_max = 150'000;  // with 60 bytes each: 9 MB of file
  const std::size_t room = std::max<std::size_t>(
      8, replicas_max / std::max<std::size_t>(1, instants_.size() * clients_.size()));
  const game::ReplicaSet& replica_set = clients_[place]->replicas();
  const auto in_scope = static_cast<std::size_t>(
      std::count_if(replica_set.entities().begin(), replica_set.entities().end(),
                    [](const auto& entity) { return entity.in_scope; }));
  const auto step = static_cast<std::uint32_t>((in_scope + room - 1) / room);
  std::uint32_t skipped =
      step > 1 ? game::RandomStream(settings_.seed, next_instant_ * 65'536 + place).below(step) : 0;
  const std::size_t first = trace_.replicas.size();
  for (const game::EntityReplica& entity : replica_set.entities()) {
    // Skipped entities of a large replica set are not looked up, since bots have little time to
    // sample.
    if (entity.in_scope && ++skipped < step) continue;
    const std::uint32_t bytes = bytes_of(received, entity.object.value);
    if (!entity.in_scope && (bytes == 0 || ++skipped < step)) continue;
    skipped = 0;
    game::BotsTrace::Replica replica{.object = entity.object.value,
                                     .bytes = bytes,
                                     .is_in_scope = entity.in_scope && entity.is_placed};
    if (replica.is_in_scope)
      replica.matched = entity.position_at(matched_s_[place]),
      replica.displayed = entity.position_at(simulated_s);
    trace_.replicas.push_back(replica);
  }
  if (clients_[place]->computed() != nullptr) display_computed(place, simulated_s, first);
  trace_.samples.push_back({.bot = place,
                            .displayed_s = simulated_s,
                            .matched_s = matched_s_[place],
                            .window_s = window_s,
                            .first = first,
                            .last = trace_.replicas.size()});
  received.clear();
}

/// Who computes displays what it plays on to without news, which the next news take back.
void BotsRecorder::display_computed(std::uint32_t place, double simulated_s, std::size_t first) {
  clients_[place]->computed()->look_ahead(simulated_s);
  for (std::size_t k = first; k < trace_.replicas.size(); ++k) {
    game::BotsTrace::Replica& replica = trace_.replicas[k];
    if (replica.is_in_scope)
      replica.displayed = clients_[place]
                              ->replicas()
                              .find(rti::ObjectHandle{replica.object})
                              ->position_at(simulated_s);
  }
  clients_[place]->computed()->look_back();
}

std::uint32_t BotsRecorder::bytes_of(std::span<const Received> received,
                                     std::uint32_t object) const {
  std::uint32_t bytes = 0;
  auto update = std::lower_bound(received.begin(), received.end(), object,
                                 [](const Received& a, std::uint32_t b) { return a.object < b; });
  for (; update != received.end() && update->object == object; ++update) bytes += update->bytes;
  return bytes;
}

game::BotsTrace BotsRecorder::trace() const {
  game::BotsTrace result = trace_;
  for (std::size_t place = 0; place < clients_.size(); ++place)
    if (const game::EntityReplica* bat = clients_[place]->bat())
      result.bots[place].object = bat->object.value;
  return result;
}

std::size_t BotsRecorder::memory_bytes() const {
  std::size_t bytes = trace_.samples.capacity() * sizeof(game::BotsTrace::Sample) +
                      trace_.replicas.capacity() * sizeof(game::BotsTrace::Replica);
  for (const game::BotsTrace::Bot& bot : trace_.bots)
    bytes += bot.changes.capacity() * sizeof(game::BotsTrace::ScopeChange);
  for (const auto& received : received_) bytes += received.capacity() * sizeof(Received);
  return bytes;
}

}  // namespace rink::loadgen
