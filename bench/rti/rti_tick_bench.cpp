// One tick of a crowd inside the RTI, without any transport: take in, match, write out.
#include <benchmark/benchmark.h>

#include <array>
#include <chrono>
#include <cmath>
#include <deque>
#include <string>
#include <vector>

#include "bench/rti/entity_federation.h"

namespace rink::bench::rti_tick_bench {
namespace {

using namespace rink;
using namespace rink::rti;
using Clock = std::chrono::steady_clock;

/// Counts what would be sent.
struct Scales final : Outlet {
  std::uint64_t bytes = 0;
  void send(ConnectionId, std::span<const Bytes> parts) override {
    for (const Bytes part : parts) bytes += part.size();
  }
  void drop(ConnectionId, std::string_view) override {}
};

/// A crowd's tick without any transport: 5,500 entities drift over a square of 100 m, each client
/// sees 5 % of it around a point that drifts too.
void crowd_tick(benchmark::State& state, const char* filter) {
  constexpr int entity_count = 5500;
  static constexpr double side = 100.0, seen = 11.2;
  const int clients = static_cast<int>(state.range(0));
  FederationSettings settings;
  settings.filter = filter;
  settings.filter_settings.world = {0.0, 0.0, side, side};
  const Fom& model = reliable_entities();
  FederationExecution execution(model, settings);
  Scales scales;
  const ObjectClassHandle entity = *model.object_class("Entity");
  const AttributeSet position = model.attributes(entity);
  std::deque<CountingFederate> federates;
  const auto speak = [&](ConnectionId id) {
    execution.receive(id, federates[id].ambassador.outgoing());
    federates[id].ambassador.clear_outgoing();
  };
  struct ServerEnd final : Outlet {  // only the server needs its answer
    Ambassador* server = nullptr;
    void send(ConnectionId id, std::span<const Bytes> parts) override {
      for (const Bytes part : parts)
        if (id == 0) server->receive(part);
    }
    void drop(ConnectionId, std::string_view) override {}
  } server_end;
  for (int i = 0; i <= clients; ++i) {
    execution.connect(static_cast<ConnectionId>(i));
    federates.emplace_back(model).join("federate " + std::to_string(i), "bench");
    speak(static_cast<ConnectionId>(i));
  }
  Ambassador& server = federates[0].ambassador;
  server_end.server = &server;
  execution.flush(server_end);
  server.publish_object_class_attributes(entity, position);
  const auto drift = [](int number, double at) {
    const double x = 0.5 + 0.5 * std::sin(0.61803 * number + 0.05 * at),
                 y = 0.5 + 0.5 * std::cos(1.41421 * number + 0.05 * at);
    return im::Region{side * x, side * y, side * x, side * y};
  };
  std::vector<ObjectHandle> objects;
  std::vector<RegionBounds> regions;
  for (int i = 0; i < entity_count; ++i) {
    objects.push_back(server.register_object_instance(entity));
    regions.push_back({server.create_region(), {}});
    server.associate_regions_for_updates(objects.back(), regions.back().region);
  }
  speak(0);
  std::vector<RegionHandle> views{RegionHandle{}};
  for (int i = 1; i <= clients; ++i) {
    Ambassador& client = federates[static_cast<std::size_t>(i)].ambassador;
    views.push_back(client.create_region());
    client.subscribe_object_class_attributes(entity, position, views.back());
  }
  const std::array<std::byte, 8> value{};
  double now = 0.0, match_us = 0.0, flush_us = 0.0, take_us = 0.0;
  const auto move = [&] {
    for (int i = 0; i < entity_count; ++i)
      regions[static_cast<std::size_t>(i)].bounds = drift(i, now);
    server.commit_region_modifications(regions);
    for (const ObjectHandle object : objects)
      server.update_attribute_values(object, position, value, {now, 1});
    for (int i = 1; i <= clients; ++i) {
      const im::Region at = drift(7919 * i, now);
      const RegionBounds view{
          views[static_cast<std::size_t>(i)],
          {at.low_x - seen, at.low_y - seen, at.high_x + seen, at.high_y + seen}};
      federates[static_cast<std::size_t>(i)].ambassador.commit_region_modifications(
          std::span(&view, 1));
    }
    now += 1.0 / 30.0;
  };
  const auto since = [](Clock::time_point start) {
    return std::chrono::duration<double, std::micro>(Clock::now() - start).count();
  };
  const auto tick = [&] {
    auto start = Clock::now();
    for (int i = 0; i <= clients; ++i) speak(static_cast<ConnectionId>(i));
    take_us += since(start), start = Clock::now();
    execution.match();
    match_us += since(start), start = Clock::now();
    execution.flush(scales);
    flush_us += since(start);
  };
  for (int i = 0; i < 3; ++i) move(), tick();
  take_us = match_us = flush_us = 0.0;
  scales.bytes = 0;
  for (auto _ : state) {
    state.PauseTiming();
    move();
    state.ResumeTiming();
    tick();
  }
  const double ticks = static_cast<double>(state.iterations());
  state.counters["take_us"] = take_us / ticks;
  state.counters["match_us"] = match_us / ticks;
  state.counters["flush_us"] = flush_us / ticks;
  state.counters["bytes_per_client"] = static_cast<double>(scales.bytes) / ticks / clients;
}

BENCHMARK_CAPTURE(crowd_tick, none, "none")
    ->Name("rti/tick/none")
    ->ArgName("clients")
    ->Arg(500)
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(crowd_tick, grid, "grid")
    ->Name("rti/tick/grid")
    ->ArgName("clients")
    ->Arg(500)
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(crowd_tick, region, "region")
    ->Name("rti/tick/region")
    ->ArgName("clients")
    ->Arg(500)
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace rink::bench::rti_tick_bench
