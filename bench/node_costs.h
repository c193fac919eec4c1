// What a few nodes are counted to need, as the model of many takes it (node_model.h), and a scene
// for any number of them.
#pragma once

#include <Eigen/Dense>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <random>
#include <span>
#include <vector>

#include "bench/node_model.h"
#include "tests/peer/many/counted_sessions.h"

namespace rink::bench::node_model {

inline constexpr double puck_radius = 0.04;                // m
inline constexpr std::uint32_t puck_count = 20;            // of each node, beside one bat
inline constexpr double window = 0.05, key_period = 0.25;  // s

/// Pucks and bats of the scene arena, spread over `area` [m^2] per node, with keys until then [s].
struct Arena {
  physics::World world;
  std::vector<peer::Key> keys{};
};

inline Arena arena_of(std::uint32_t nodes, double area, double until) {
  assert(nodes > 0 && area > 0.0);
  std::mt19937_64 random(nodes);
  const auto uniform = [&](double low, double high) {
    return low + (high - low) * static_cast<double>(random() >> 11) * 0x1p-53;
  };
  const double side = std::sqrt(area * nodes);
  physics::WorldSpec spec;
  spec.field = {
      .length = side, .width = side, .goal_width = 0.0, .wall = 0, .bats_keep_to_half = false};
  spec.restitution = physics::RestitutionTable(1, 0.98);
  spec.puck_drag = 0.25, spec.bat_drag = 3.0;
  Arena arena{physics::World(spec)};
  for (std::uint32_t k = 0; k < nodes; ++k) {
    for (;;) {
      const physics::BatSpec bat{.position = {uniform(0.2, side - 0.2), uniform(0.2, side - 0.2)},
                                 .half_extent = {0.05, 0.15},
                                 .mass = 5.0};
      if (!arena.world.is_free(bat.position, 0.4)) continue;
      const std::uint32_t number = arena.world.add(bat).index;
      for (double time = 0.0; time < until; time += key_period)
        arena.keys.push_back(
            {time + 0.001 * uniform(0.0, 200.0), number, {uniform(-5.0, 5.0), uniform(-5.0, 5.0)}});
      break;
    }
  }
  while (arena.world.body_count() < nodes * (puck_count + 1)) {
    const double angle = uniform(0.0, 2.0 * std::numbers::pi),
                 speed = std::sqrt(-std::log1p(-uniform(0.0, 0.999)) * 4.0 / std::numbers::pi);
    const physics::PuckSpec puck{.position = {uniform(0.1, side - 0.1), uniform(0.1, side - 0.1)},
                                 .velocity = {speed * std::cos(angle), speed * std::sin(angle)},
                                 .radius = puck_radius};
    if (arena.world.is_free(puck.position, puck.radius)) arena.world.add(puck);
  }
  std::ranges::sort(arena.keys, {}, &peer::Key::time);
  return arena;
}

/// What so many nodes were counted to need.
struct Sample {
  std::uint32_t nodes = 0;
  double area = 0.0;  ///< m^2 per node
  peer::test::CountedRun run;
};

inline Sample sample_of(std::uint32_t nodes, double area, std::uint64_t windows,
                        std::size_t tree_from = peer::SessionSettings{}.tree_from,
                        bool keeps_fields = false) {
  constexpr std::uint64_t warm_up = 20;
  const Arena arena = arena_of(nodes, area, window * static_cast<double>(warm_up + windows));
  return {nodes, area,
          peer::test::counted_run(arena.world, {.node_count = nodes,
                                                .window = window,
                                                .halo = 0.3,
                                                .warm_up = warm_up,
                                                .windows = windows,
                                                .tree_from = tree_from,
                                                .keeps_fields = keeps_fields,
                                                .keys = arena.keys})};
}

/// Sums over all nodes and windows of a sample.
struct Sums {
  double windows = 0.0, ghosts = 0.0, border = 0.0, own = 0.0, bytes = 0.0, messages = 0.0;
  double agreement_bytes = 0.0, agreement_messages = 0.0, records = 0.0, repeats = 0.0;
  double halo = 0.0, processor_s = 0.0, busiest_s = 0.0;
};

inline Sums sums_of(const Sample& sample) {
  Sums sums;
  for (const peer::test::NodeCost& node : sample.run.nodes) {
    const auto counted = [&](std::uint64_t peer::PeerCounters::*count) {
      return static_cast<double>(node.after.peer.*count - node.before.peer.*count);
    };
    const auto windows = static_cast<double>(node.windows());
    sums.windows += windows, sums.own += node.own * windows, sums.halo += node.halo * windows;
    sums.ghosts += counted(&peer::PeerCounters::ghost_windows);
    sums.border += counted(&peer::PeerCounters::border_windows);
    sums.repeats += counted(&peer::PeerCounters::repeats);
    sums.bytes += static_cast<double>(node.bytes);
    sums.messages += static_cast<double>(node.messages);
    sums.agreement_bytes += static_cast<double>(node.agreement_bytes);
    sums.agreement_messages += static_cast<double>(node.agreement_messages);
    sums.records += static_cast<double>(node.after.replica_bytes - node.before.replica_bytes);
    sums.processor_s += node.processor_s;
    sums.busiest_s = std::max(sums.busiest_s, node.processor_s / windows);
  }
  return sums;
}

/// Of samples in which each agrees with each.
inline Costs costs_of(std::span<const Sample> samples) {
  assert(!samples.empty());
  Costs costs;
  Sums all;
  std::size_t rows = 0;
  for (const Sample& sample : samples) {
    const Sums sums = sums_of(sample);
    all.windows += sums.windows, all.halo += sums.halo, all.repeats += sums.repeats;
    all.agreement_bytes += sums.agreement_bytes;
    all.agreement_messages += sums.agreement_messages;
    all.records += sums.records, all.own += sums.own, all.ghosts += sums.ghosts;
    rows += sample.run.nodes.size();
  }
  costs.radius = puck_radius, costs.reach = 0.15;
  costs.halo = all.halo / all.windows, costs.repeating = all.repeats / all.windows;
  constexpr double alone = 6.0;  // B: what a verdict has alone, and not in a bundle
  costs.verdict_bytes = all.agreement_bytes / all.agreement_messages - alone;
  costs.record_bytes = all.records / (all.own + all.ghosts);
  costs.bodies_per_m2 = (puck_count + 1) / samples.front().area;
  Eigen::MatrixXd needs(static_cast<Eigen::Index>(rows), 4),
      traffic(static_cast<Eigen::Index>(rows), 2);
  Eigen::VectorXd seconds(static_cast<Eigen::Index>(rows)), bytes(static_cast<Eigen::Index>(rows));
  Eigen::Index row = 0;
  for (const Sample& sample : samples)
    for (const peer::test::NodeCost& node : sample.run.nodes) {
      const peer::PeerCounters &now = node.after.peer, &then = node.before.peer;
      const auto windows = static_cast<double>(node.windows());
      needs.row(row) << 1.0, static_cast<double>(node.messages) / windows, node.own,
          static_cast<double>(now.ghost_windows - then.ghost_windows) / windows;
      seconds(row) = node.processor_s / windows;
      traffic.row(row) << static_cast<double>(now.border_windows - then.border_windows),
          static_cast<double>(node.messages - node.agreement_messages) - windows;
      bytes(row) = static_cast<double>(now.claim_bytes + now.arrival_bytes - then.claim_bytes -
                                       then.arrival_bytes);
      ++row;
    }
  const Eigen::Vector4d time = needs.colPivHouseholderQr().solve(seconds);
  costs.window_s = time(0), costs.message_s = time(1), costs.body_s = time(2),
  costs.ghost_s = time(3);
  const Eigen::Vector2d size = traffic.colPivHouseholderQr().solve(bytes);
  costs.border_bytes = size(0), costs.message_bytes = size(1);
  return costs;
}

}  // namespace rink::bench::node_model
