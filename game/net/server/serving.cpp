// The order of a tick: play, publish, match, flush.
#include "game/net/server/serving.h"

#include <algorithm>
#include <cassert>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <set>
#include <utility>
#include <vector>

#include "game/net/plugins.h"
#include "game/net/server/interest_report.h"
#include "game/net/server/push_exact.h"
#include "game/net/server/push_filter_hints.h"
#include "game/replication/filter_setup.h"

namespace rink::game {
namespace {

/// Pairs of a new subscription and an object that one match looks at.
constexpr std::size_t newcomer_pairs_max = 1u << 18;

std::chrono::nanoseconds nanoseconds(double seconds) {
  return std::chrono::nanoseconds(static_cast<std::int64_t>(seconds * 1e9));
}

/// Players of matches are to notice soon that their host is silent (HostLink).
rti::FederationSettings match_federation(const ServerSettings& server,
                                         rti::FederationSettings settings) {
  if (server.hosting) settings.timeouts.heartbeat_s = 0.2;
  return settings;
}

/// Adds the time since it was made or last read to a sum.
class Stopwatch {
 public:
  explicit Stopwatch(const Serving::Clock& now_s) : now_s_(now_s), since_(now_s()) {}
  void add_to(double& sum) {
    const double now = now_s_();
    sum += now - since_;
    since_ = now;
  }

 private:
  const Serving::Clock& now_s_;
  double since_;
};

}  // namespace

Serving::Serving(const rti::Fom& fom, const Scene& scene, const ServerSettings& server,
                 const rti::FederationSettings& federation, Clocks clocks)
    : now_s_(std::move(clocks.now_s)),
      execution_(fom, match_federation(server, federation)),
      host_(execution_),
      server_(fom, scene, server, std::move(clocks.simulated_now)),
      link_(server_.ambassador(), endpoint_, (hub_.listen("rti"), endpoint_.connect("rti"))),
      shared_(server.shared) {
  execution_.advance_clock(now_s_());  // before any connection: silence counts from then on
  links_.add(link_);
  host_.add(hub_);
  if (execution_.filter().traits().uses_flights) server_.hand_in_flights();
  if (server.policy != exact_policy) return;
  assert(!server.hosting && !server.shared && !server.is_synchronous && !server.is_time_managed);
  exact_.emplace(server_.game(), scene, fom, server.tick_s);
}

void Serving::exchange(double longest_wait_s) {
  host_.poll(nanoseconds(std::max(0.0, longest_wait_s)));
  host_.flush();
  endpoint_.poll({}, links_);
  link_.flush(now_s_());
  if (!server_.take_urgent()) return;
  host_.poll(hub_);
  host_.flush();
}

TickCosts Serving::tick(double simulated_s, double due_s) {
  TickCosts costs;
  Stopwatch watch(now_s_);
  const double played_s = server_.simulate(simulated_s);
  if (exact_) exact_->look();
  watch.add_to(costs.physics_s);
  if (send(played_s, due_s, costs)) {
    for (const Inspections::Question& each : server_.inspections().take())
      server_.send_interest(each.federate, interest_report(server_, execution_, each.object));
    if (recorder_)
      recorder_->look(server_, execution_,
                      {played_s, costs.physics_s, costs.filter_s, costs.send_s});
  }
  host_.advance_clock(now_s_());
  return costs;
}

std::optional<ServerTrace> Serving::trace() const {
  if (!recorder_) return std::nullopt;
  return recorder_->trace(server_);
}

bool Serving::send(double simulated_s, double due_s, TickCosts& costs) {
  Stopwatch watch(now_s_);
  const bool is_hosting =
      server_.hosted() !=
      nullptr;  // players of matches ask for the time instead, which saves the bytes of the tag
  const rti::Stamp stamp{
      .time = simulated_s,
      .tag = is_hosting ? 0 : static_cast<std::uint64_t>(std::llround(due_s * 1e9))};
  const bool is_published = server_.publish(stamp);
  link_.flush(now_s_());
  host_.poll({});
  if (is_published) {
    push_filter_hints(server_, execution_, facts_);
    watch.add_to(costs.send_s);
    host_.match();
    if (shared_ != nullptr) look_around();
    watch.add_to(costs.filter_s);
    if (exact_) push_exact(server_, *exact_, stamp, execution_);
  }
  host_.flush();
  watch.add_to(costs.send_s);
  return is_published;
}

/// The others tell of what the clients look at. Who has no region, as a watcher, sees everything.
void Serving::look_around() {
  std::vector<rti::SubscribedRegion> subscribed;
  execution_.list_subscribed_regions(subscribed);
  std::vector<im::Region> regions;
  std::set<std::uint32_t> looking{server_.ambassador().federate().value};
  for (const rti::SubscribedRegion& each : subscribed) {
    regions.push_back(each.bounds);
    looking.insert(each.federate.value);
  }
  shared_->look(regions, looking.size() < execution_.federate_count());
}

rti::FederationSettings federation_settings(const Scene& scene, const std::string& scheme,
                                            double cell_size) {
  rti::FederationSettings settings;
  settings.filter = scheme;
  settings.filter_settings = filter_settings(scene, cell_size);
  settings.filter_settings.plugins = loaded_plugins();
  settings.newcomer_pairs_per_match_max = newcomer_pairs_max;
  return settings;
}

rti::UpdateRate update_rate_of(double output_rate_hz, double tick_rate_hz) {
  assert(0.0 <= output_rate_hz && output_rate_hz <= tick_rate_hz);
  if (output_rate_hz == 0.0) return {};
  const auto thousandths = [](double rate) {
    return static_cast<std::uint32_t>(std::max(1ll, std::llround(1e3 * rate)));
  };
  return {thousandths(output_rate_hz), thousandths(tick_rate_hz)};
}

double cell_size_of_nodes(const Scene& scene, const std::string& scheme, double cell_size) {
  if (cell_size > 0.0 || !im::takes_cell_size(scheme)) return cell_size;
  return im::cell_size_of(federation_settings(scene, scheme, 0.0).filter_settings);
}

}  // namespace rink::game
