// Combines the reports of several nodes and of their bots into those of one server and its bots.
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <span>
#include <string>

namespace rink::loadgen {

/// What a node and the bots that play at it have written.
struct NodeResults {
  std::uint32_t number = 0;
  nlohmann::json server, bots;
};

/// The hash of the state in which the node has ended. Throws Failure if it told none.
std::string end_hash(const NodeResults& node);

/// Sums over nodes, which are in the order of their numbers; the worst of what cannot be summed;
/// and beside these the busiest link, of a node to its clients and all other nodes, and all that
/// nodes sent each other, both with headers. Null is what nodes do not tell: the cost of physics,
/// which they play beside their ticks. Throws Failure.
nlohmann::ordered_json nodes_report(std::span<const NodeResults> nodes);
nlohmann::ordered_json bots_report_of(std::span<const NodeResults> nodes);

}  // namespace rink::loadgen
