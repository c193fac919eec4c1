// A discrete-event loop over arrivals, ticks and frames.
#include "loadgen/duel/duel.h"

#include <algorithm>
#include <cmath>

#include "loadgen/run/virtual_parts.h"

namespace rink::loadgen {

std::int64_t JitteredDelay::arrival_ns(std::uint32_t, std::int64_t now_ns, std::size_t) {
  const double late_s =
      jitter_s_ == 0.0 ? 0.0 : jitter_s_ * std::min(5.0, -std::log1p(-random_.uniform()));
  double lost_s = 0.0;
  while (loss_ > 0.0 && random_.uniform() < loss_) lost_s += 0.2 + 2.0 * delay_s_;
  return now_ns + nanoseconds(delay_s_ + late_s + lost_s);
}

Duel::Client::Client(rti::VirtualNetwork& network, const rti::Fom& fom,
                     const game::ObjectModel& model, const game::NetworkMatchSettings& settings)
    : end(network),
      match(std::make_unique<game::NetworkMatch>(fom, model, end, end.connect(server_name),
                                                 settings)) {}

Duel::Duel(const rti::Fom& fom, const game::Scene& scene, const std::string& scene_text,
           const DuelSettings& settings)
    : fom_(fom),
      model_(fom),
      settings_(settings),
      link_(settings.delay_s, settings.jitter_s, settings.loss, settings.seed),
      network_(link_, nanoseconds(1.0)),
      serving_(fom, scene,
               {.policy = "on-event",
                .tick_s = 1.0 / settings.rate_hz,
                .replay = {},
                .hosting = game::Hosting{settings.times, scene_text}},
               game::federation_settings(scene, "none", 0.0),
               {[this] { return network_.now_s(); }, [this] { return network_.now_s(); }}) {
  server_end_.listen(server_name);
  serving_.host().add(server_end_);
  ticks_ = {network_.now_ns(), nanoseconds(1.0 / settings.rate_hz)};
  const std::int64_t period_ns = nanoseconds(1.0 / settings.frame_hz);
  for (std::size_t k = 0; k < frames_.size(); ++k)
    frames_[k] = {network_.now_ns() + period_ns * static_cast<std::int64_t>(3 + 3 * k) / 10,
                  period_ns};
  run_until([this] { return serving_.server().is_joined(); }, 1.0);
}

void Duel::connect(std::size_t k) {
  clients_[k] =
      std::make_unique<Client>(network_, fom_, model_,
                               game::NetworkMatchSettings{.name = "client-" + std::to_string(k),
                                                          .only_watches = k == watcher});
  if (k != watcher && !settings_.players[k].empty())
    clients_[k]->bot.emplace(settings_.players[k], settings_.seed);
}

void Duel::leave(std::size_t k) {
  clients_[k]->match->leave(now_s());
  gone_.push_back(std::move(clients_[k]));
}

void Duel::kill(std::size_t k) { clients_[k].reset(); }

void Duel::run(double seconds) { step_to(network_.now_ns() + nanoseconds(seconds)); }

bool Duel::run_until(const std::function<bool()>& condition, double seconds) {
  const std::int64_t until_ns = network_.now_ns() + nanoseconds(seconds);
  while (!condition()) {
    if (network_.now_ns() >= until_ns) return false;
    step_to(std::min(until_ns, network_.now_ns() + ticks_.period_ns));
  }
  return true;
}

void Duel::step_to(std::int64_t until_ns) {
  while (true) {
    std::int64_t next_ns = ticks_.next_ns;
    for (const Frames& frames : frames_) next_ns = std::min(next_ns, frames.next_ns);
    if (const auto arrival_ns = network_.next_arrival_ns())
      next_ns = std::min(next_ns, *arrival_ns);
    if (next_ns > until_ns) break;
    network_.advance_to(next_ns);
    if (server_end_.has_arrivals()) serving_.exchange(0.0);
    if (ticks_.next_ns <= next_ns) tick();
    for (std::size_t k = 0; k < frames_.size(); ++k)
      if (frames_[k].next_ns <= next_ns) frame(k);
  }
  network_.advance_to(until_ns);
}

void Duel::tick() {
  ticks_.next_ns += ticks_.period_ns;
  serving_.exchange(0.0);
  if (!serving_.server().is_joined()) return;
  serving_.tick(serving_.server().follow_match(now_s()), now_s());
}

void Duel::frame(std::size_t k) {
  frames_[k].next_ns += frames_[k].period_ns;
  if (clients_[k] == nullptr) return;
  if (clients_[k]->bot) clients_[k]->bot->act(*clients_[k]->match, now_s());
  clients_[k]->match->advance(now_s());
  if (watch) watch(k);
}

}  // namespace rink::loadgen
