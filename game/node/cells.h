// The cells of the field in which a node's clients look, as other nodes are told of them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "game/physics/body.h"
#include "im/region.h"

namespace rink::game {

/// Squares of one side over the field, some of them marked. Those at the rim extend without end,
/// so that no place is outside.
class Cells {
 public:
  static constexpr std::uint32_t count_max = 1u << 16;

  /// Whether cells of `side` [m] are a grid, and not too many.
  static bool fit(const physics::Field& field, double side);
  /// None is marked. They must fit (asserted).
  Cells(const physics::Field& field, double side);
  /// One cell, which is marked.
  static Cells all_of(const physics::Field& field);

  double side() const { return side_; }
  std::size_t count() const { return is_marked_.size(); }
  bool contains(const physics::Vector2& place) const {
    return is_marked_[index(column(place.x()), row(place.y()))];
  }
  /// Marks all that `region` meets.
  void mark(const im::Region& region);
  /// Marks those that are marked in both; all have one side (asserted).
  void mark_common(const Cells& a, const Cells& b);
  friend bool operator==(const Cells&, const Cells&) = default;

  /// The lengths of runs of cells, row by row, that are by turns not marked and marked.
  std::vector<std::uint32_t> runs() const;
  /// Nothing unless the runs are of a grid of that side.
  static std::optional<Cells> of_runs(const physics::Field& field, double side,
                                      const std::vector<std::uint32_t>& runs);

 private:
  std::uint32_t column(double x) const;
  std::uint32_t row(double y) const;
  std::size_t index(std::uint32_t column, std::uint32_t row) const {
    return std::size_t{row} * columns_ + column;
  }

  double side_;
  std::uint32_t columns_, rows_;
  std::vector<bool> is_marked_;  ///< row by row
};

/// Sent before a window: from the change that leads to `step` on, the sender wants to be told of
/// the bodies in these cells.
struct WantedCells {
  std::uint64_t step = 0;
  double side = 0.0;  ///< m
  std::vector<std::uint32_t> runs;
};

template <class Stream>
bool exchange(Stream& stream, WantedCells& wanted) {
  if (!stream.numbers(wanted.step, wanted.side) || !stream.short_size(wanted.runs)) return false;
  for (std::uint32_t& run : wanted.runs)
    if (!stream.varint(run)) return false;
  return true;
}

}  // namespace rink::game
