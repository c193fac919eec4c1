// A server's tick with few bodies in motion among many at rest: what the game, the publisher and
// the RTI's match cost then, and how much each of them did.
#include <benchmark/benchmark.h>

#include <cmath>
#include <cstdio>
#include <memory>
#include <string>

#include "game/model/random_stream.h"
#include "game/net/fom_file.h"
#include "game/net/server/serving.h"
#include "game/replication/trajectory_codec.h"

namespace rink::bench::publish_bench {
namespace {

using namespace rink;

constexpr double tick_s = 1.0 / 60.0;

/// Pucks of radius 0.04 m on a lattice of 0.2 m; `moving` of them in a corner move, fenced in by
/// posts, the rest lie still.
game::Scene resting(std::uint32_t count, std::uint32_t moving) {
  const auto columns = static_cast<std::uint32_t>(std::ceil(std::sqrt(count))),
             pen = static_cast<std::uint32_t>(std::ceil(std::sqrt(moving)));
  game::Scene scene;
  scene.world.field.length = scene.world.field.width = 0.2 * columns + 0.2;
  scene.world.cell_size = 0.25;  // the same cells around the pen, however large the field is
  game::RandomStream random(4);
  const auto place = [&](std::uint32_t index) { return 0.2 * index + (index < pen ? 0.1 : 0.3); };
  for (std::uint32_t k = 0; k < count; ++k) {
    game::Puck puck;
    puck.body.position = {place(k % columns), place(k / columns)};
    puck.body.radius = 0.04;
    if (k % columns < pen && k / columns * pen + k % columns < moving)
      puck.body.velocity = {random.uniform(-2.0, 2.0), random.uniform(-2.0, 2.0)};
    scene.bodies.pucks.push_back(puck);
  }
  const auto add_post = [&](double x, double y) {
    game::Post post;
    post.body.position = {x, y};
    post.body.radius = 0.05;
    scene.bodies.posts.push_back(post);
  };
  const double fence = 0.2 * pen + 0.1;
  for (double along = 0.05; along < fence - 0.1; along += 0.12)
    add_post(fence, along), add_post(along, fence);
  add_post(fence, fence);
  return scene;
}

game::ServerSettings server_settings(const std::string& policy) {
  game::ServerSettings settings;
  settings.policy = policy;
  settings.tick_s = tick_s;
  return settings;
}

/// A server without a network, all of whose entities are registered.
struct Rink {
  Rink(std::uint32_t count, std::uint32_t moving, const std::string& policy)
      : scene(resting(count, moving)),
        fom(game::load_rink_fom(game::fom_file())),
        serving(fom, scene, server_settings(policy),
                game::federation_settings(scene, "region", 0.0),
                {[] { return 0.0; }, [] { return 0.0; }}) {
    const std::size_t entities = count + scene.bodies.posts.size();
    for (int round = 0; round < 64 && serving.execution().object_count() < entities; ++round) {
      serving.exchange(0.0);
      if (serving.server().is_joined()) tick();
    }
  }
  void tick() { serving.tick(tick_s * static_cast<double>(++number), 0.0); }

  game::Scene scene;
  rti::Fom fom;
  game::Serving serving;
  std::uint64_t number = 0;
};

void tick_among_resting(benchmark::State& state, std::uint32_t count, const std::string& policy) {
  constexpr std::uint32_t moving = 100;
  static std::string name;
  static std::unique_ptr<Rink> rink;  // to make so many entities takes seconds
  if (const std::string wanted = std::to_string(count) + policy; name != wanted) {
    rink.reset();
    rink = std::make_unique<Rink>(count, moving, policy);
    name = wanted;
  }
  const game::PublisherCounters before = rink->serving.server().publisher().counters();
  const std::uint64_t touched = rink->serving.server().game().world().counters().bodies_touched;
  std::uint64_t ticks = 0;
  for (auto _ : state) rink->tick(), ++ticks;
  const auto per_tick = [&](std::uint64_t now, std::uint64_t then) {
    return static_cast<double>(now - then) / static_cast<double>(std::max<std::uint64_t>(1, ticks));
  };
  const game::PublisherCounters& after = rink->serving.server().publisher().counters();
  state.counters["sent"] = per_tick(after.motions_sent, before.motions_sent);
  state.counters["regions"] = per_tick(after.regions_moved, before.regions_moved);
  state.counters["looked_at"] = per_tick(after.entities_looked_at, before.entities_looked_at);
  state.counters["touched"] =
      per_tick(rink->serving.server().game().world().counters().bodies_touched, touched);
  state.counters["entities"] = static_cast<double>(rink->serving.execution().object_count());
}

const bool registered = [] {
  for (const char* policy : {"on-event", "snapshot"})
    for (const std::uint32_t count : {1'000u, 250'000u}) {
      char name[96];
      std::snprintf(name, sizeof name, "replication/tick/%s/resting:%u/moving:100", policy, count);
      benchmark::RegisterBenchmark(
          name, [=](benchmark::State& state) { tick_among_resting(state, count, policy); })
          ->UseRealTime()
          ->Unit(benchmark::kMicrosecond);
    }
  return true;
}();

}  // namespace
}  // namespace rink::bench::publish_bench
