// What a simulation takes in memory, in one engine and in each of several nodes, by what is
// allocated.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <numbers>
#include <random>
#include <vector>

#if defined(__GLIBC__)
#include <malloc.h>
#endif

#include "game/peer/assembly.h"
#include "game/peer/cuts.h"

namespace rink::peer::test {

/// 0 where this build cannot tell: a sanitizer has an allocator of its own.
#if defined(__GLIBC__)
inline std::uint64_t allocated_bytes() {
  const struct mallinfo2 now = mallinfo2();
  return now.uordblks + now.hblkhd;
}
#else
inline std::uint64_t allocated_bytes() { return 0; }
#endif

/// Elastic pucks of radius 0.04 m and 1 m/s at `packing`, whose numbers say nothing about their
/// places.
inline physics::World mixed_gas(std::uint32_t count, double packing) {
  constexpr double radius = 0.04;  // m
  const double distance = std::sqrt(std::numbers::pi * radius * radius / packing);
  const auto columns = static_cast<std::uint32_t>(std::ceil(std::sqrt(count)));
  physics::WorldSpec spec;
  const double side = (columns + 1) * distance;
  spec.field = {
      .length = side, .width = side, .goal_width = 0.0, .wall = 0, .bats_keep_to_half = false};
  spec.restitution = physics::RestitutionTable(1, 1.0);
  std::vector<std::uint32_t> places(count);
  for (std::uint32_t k = 0; k < count; ++k) places[k] = k;
  std::mt19937_64 random(7);
  std::ranges::shuffle(places, random);
  physics::World world(spec);
  for (const std::uint32_t place : places) {
    const double angle =
        2.0 * std::numbers::pi * static_cast<double>(random() % 100'000) / 100'000.0;
    world.add(physics::PuckSpec{
        .position = {(place % columns + 1) * distance, (place / columns + 1) * distance},
        .velocity = {std::cos(angle), std::sin(angle)},
        .radius = radius});
  }
  return world;
}

/// Per node, on average [B].
struct NodeMemory {
  std::uint64_t share = 0;   ///< what it plays
  std::uint64_t copies = 0;  ///< a snapshot of its own part, and one of another's
  double held = 0.0;         ///< bodies in its share
  std::uint64_t all() const { return share + copies; }
};

/// After so many windows [s] of a whole that is at its start.
inline NodeMemory memory_of_nodes(const physics::World& whole, PeerNumber node_count, double window,
                                  int windows) {
  std::vector<Vector2> places;
  for (std::uint32_t body = 0; body < whole.body_count(); ++body)
    places.push_back(whole.position({body}));
  const Cuts cuts = Cuts::by_count(whole.spec().field, places, node_count);
  const std::uint64_t before = allocated_bytes();
  const auto assembly = std::make_unique<Assembly>(whole, cuts.division(node_count), 0.3, window);
  for (int k = 0; k < windows; ++k) assembly->advance();
  const std::uint64_t owners = whole.body_count() * sizeof(PeerNumber);  // the assembly's own
  NodeMemory memory{.share = (allocated_bytes() - before - owners) / node_count};
  for (const Peer& peer : assembly->peers())
    memory.held += static_cast<double>(peer.owned().size() + peer.ghosts().size()) / node_count;
  const Validator scene(whole);
  std::vector<PartSnapshot> copies;
  copies.reserve(node_count);
  const std::uint64_t without_copies = allocated_bytes();
  for (Peer& peer : assembly->peers()) {
    peer.part_log().begin(scene);
    copies.push_back(peer.part_log().snapshot());
  }
  memory.copies = 2 * (allocated_bytes() - without_copies) / node_count;
  return memory;
}

/// Of one engine that has come as far [B]; `make` makes the whole at its start.
template <class Make>
std::uint64_t memory_of_engine(Make&& make, double until) {
  const std::uint64_t before = allocated_bytes();
  physics::World world = make();
  world.advance(until);
  return allocated_bytes() - before;
}

}  // namespace rink::peer::test
