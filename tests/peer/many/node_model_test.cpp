// The model of many nodes (bench/node_model.h), from what a few nodes were counted to need, against
// 64 nodes that are counted.
#include <gtest/gtest.h>

#include <iostream>
#include <vector>

#include "bench/node_costs.h"

namespace rink::bench::node_model {
namespace {

using peer::test::NodeCost;

/// A field of 4 m times 4 m in quarters, with 100 bodies per square metre.
TEST(NodeModel, CountsWhatIsNearABorder) {
  const physics::Field field{
      .length = 4.0, .width = 4.0, .goal_width = 0.0, .wall = 0, .bats_keep_to_half = false};
  const peer::Division quarters(field,
                                {{{0.0, 0.0, 2.0, 2.0}, 0},
                                 {{2.0, 0.0, 4.0, 2.0}, 1},
                                 {{0.0, 2.0, 2.0, 4.0}, 2},
                                 {{2.0, 2.0, 4.0, 4.0}, 3}},
                                4);
  const Costs costs{.bodies_per_m2 = 100.0,
                    .halo = 0.5,
                    .repeating = 0.0,
                    .border_bytes = 10.0,
                    .message_bytes = 8.0,
                    .verdict_bytes = 7.0,
                    .record_bytes = 1.0};
  const std::vector<Need> needs = needs_of(quarters, field, costs, 5);
  for (const Need& need : needs) {
    EXPECT_DOUBLE_EQ(need.bodies, 400.0);
    EXPECT_DOUBLE_EQ(need.border, 100.0 + 100.0 + 25.0);
    EXPECT_DOUBLE_EQ(need.ghosts, need.border);
    EXPECT_DOUBLE_EQ(need.neighbours, 3.0);
    EXPECT_DOUBLE_EQ(need.messages, 3.0 * 2.0 + 3.0 + 1.0);
    EXPECT_DOUBLE_EQ(need.bytes, 10.0 * 225.0 + 3.0 * 2.0 * 8.0 + 3.0 * 13.0 + 625.0);
    EXPECT_DOUBLE_EQ(need.received, need.bytes);
  }
  const std::vector<Need> tree = needs_of(quarters, field, costs, 2);
  EXPECT_DOUBLE_EQ(tree[0].messages, 3.0 * 2.0 + 3.0 + 1.0) << "the root";
  EXPECT_DOUBLE_EQ(tree[1].messages, 3.0 * 2.0 + 1.0 + 1.0);
  EXPECT_DOUBLE_EQ(delays_of(4, 5), 3.0);
  EXPECT_DOUBLE_EQ(delays_of(4, 2), 4.0);
  EXPECT_DOUBLE_EQ(delays_of(64, 2), 6.0);
  EXPECT_NEAR(rounds_of({.repeating = 0.01}, 64), 1.0 + 1.0 - std::pow(0.99, 64.0), 1e-12);
}

/// Messages within 8 %, bytes within 15 %, those of the busiest within 25 %.
TEST(NodeModel, ForetellsWhat64NodesSend) {
  std::vector<Sample> samples;
  for (const std::uint32_t few : {4u, 9u, 16u})
    samples.push_back(sample_of(few, 4.0, 40, peer::members_max + 1));
  const Costs costs = costs_of(samples);
  constexpr std::uint32_t nodes = 64;
  const Sample many = sample_of(nodes, 4.0, 20);
  const Arena arena = arena_of(nodes, 4.0, 0.0);
  std::vector<physics::Vector2> places;
  for (std::uint32_t body = 0; body < arena.world.body_count(); ++body)
    places.push_back(arena.world.position({body}));
  const physics::Field& field = arena.world.spec().field;
  const std::vector<Need> needs =
      needs_of(peer::Cuts::by_count(field, places, nodes).division(nodes), field, costs);
  double messages = 0.0, bytes = 0.0, busiest = 0.0, counted_messages = 0.0, counted_bytes = 0.0,
         counted_busiest = 0.0, windows = 0.0;
  for (const Need& need : needs) {
    messages += need.messages, bytes += need.bytes;
    busiest = std::max(busiest, need.bytes + headers * need.messages);
  }
  for (const NodeCost& node : many.run.nodes) {
    const auto own_windows = static_cast<double>(node.windows());
    windows = own_windows;
    counted_messages += static_cast<double>(node.messages) / own_windows;
    counted_bytes += static_cast<double>(node.bytes) / own_windows;
    counted_busiest = std::max(counted_busiest, (static_cast<double>(node.bytes) +
                                                 headers * static_cast<double>(node.messages)) /
                                                    own_windows);
  }
  std::cout << "64 nodes in " << windows << " windows: " << counted_messages / nodes
            << " messages of each, foretold " << messages / nodes << "; " << counted_bytes / nodes
            << " B, foretold " << bytes / nodes << "; of the busiest with headers "
            << counted_busiest << " B, foretold " << busiest << '\n';
  EXPECT_NEAR(messages / counted_messages, 1.0, 0.08);
  EXPECT_NEAR(bytes / counted_bytes, 1.0, 0.15);
  EXPECT_NEAR(busiest / counted_busiest, 1.0, 0.25);
}

}  // namespace
}  // namespace rink::bench::node_model
