// The least of many numbers that change one at a time.
#pragma once

#include <algorithm>
#include <bit>
#include <cassert>
#include <cstddef>
#include <limits>
#include <vector>

#include "im/basics/checked.h"

namespace rink::rti {

/// A tournament: each inner node holds the lesser of its two children, so a change costs as many
/// steps as the tree is high, and the least is at the root. Absent numbers are infinite. (A binary
/// heap would have to be told where each number lies; a sorted tree allocates.)
class LeastTree {
 public:
  static constexpr double none = std::numeric_limits<double>::infinity();

  double least() const { return nodes_[1]; }
  double operator[](std::size_t index) const {
    return index < width() ? nodes_[width() + index] : none;
  }
  /// The leftmost index that holds the least; 0 if all are infinite.
  std::size_t where() const {
    if (least() == none) return 0;
    std::size_t node = 1;
    while (node < width()) node = 2 * node + (nodes_[2 * node] == nodes_[node] ? 0 : 1);
    return node - width();
  }
  void set(std::size_t index, double value) {
    assert(value == value);  // what is not a number is neither less nor greater
    if (index >= width()) widen(index + 1);
    std::size_t node = width() + index;
    if (nodes_[node] == value) return;
    nodes_[node] = value;
    for (node /= 2; node != 0; node /= 2) {
      const double least =
          nodes_[2 * node] < nodes_[2 * node + 1] ? nodes_[2 * node] : nodes_[2 * node + 1];
      if (nodes_[node] == least) return;
      nodes_[node] = least;
    }
  }
  /// For a walk from the root, node 1: node k has the children 2k and 2k + 1, and the leaf of index
  /// i is node `width() + i`. Nodes of trees of one width correspond.
  double node(std::size_t node) const { return nodes_[node]; }
  std::size_t width() const { return nodes_.size() / 2; }
  void widen(std::size_t count) {
    if (count <= width()) return;
    const std::vector<double> leaves(nodes_.begin() + static_cast<std::ptrdiff_t>(width()),
                                     nodes_.end());
    nodes_.assign(2 * std::bit_ceil(count), none);
    for (std::size_t i = 0; i < leaves.size(); ++i) set(i, leaves[i]);
    if constexpr (checks_whole_structures) check();
  }
  /// Asserts that each inner node holds the lesser of its two children.
  void check() const {
    assert(std::has_single_bit(nodes_.size()));
    for (std::size_t node = 1; node < width(); ++node)
      assert(nodes_[node] == std::min(nodes_[2 * node], nodes_[2 * node + 1]));
  }

 private:
  std::vector<double> nodes_ = {none, none};  ///< the root is number 1, number 0 is not used
};

}  // namespace rink::rti
