// Which bodies may come near each other during a frame: a uniform grid of the boxes that their
// paths sweep.
#pragma once

#include <cassert>
#include <cstdint>
#include <vector>

#include "game/physics/body.h"

namespace rink::physics::paper {

/// An axis-aligned box [m].
struct Extent {
  Vector2 low{0.0, 0.0}, high{0.0, 0.0};
};

/// Every body stands in each cell that its box covers. Boxes may reach beyond the field or be no
/// numbers: they count for the cells at the rim.
class FrameGrid {
 public:
  /// Empties the grid and fits it to `count` bodies: about one cell for each.
  void clear(const Field& field, std::uint32_t count);
  /// Adds a box for `body`, besides those it has already.
  void insert(std::uint32_t body, const Extent& box);
  /// Calls visit(body) once for each body that may overlap `box`, in no particular order.
  template <class Visit>
  void around(const Extent& box, const Visit& visit);

 private:
  struct Range {
    std::uint32_t left, right, bottom, top;
  };
  static constexpr std::uint32_t none = 0xffffffff;
  static std::uint32_t cell(double place, double per_metre, std::uint32_t count);
  Range range(const Extent& box) const;

  struct Entry {
    std::uint32_t body, next;
  };
  std::uint32_t columns_ = 0, rows_ = 0;
  double columns_per_metre_ = 0.0, rows_per_metre_ = 0.0;
  std::vector<std::uint32_t> first_;  ///< of each cell's list
  std::vector<Entry> entries_;
  std::vector<std::uint32_t> asked_;  ///< the question that last met each body
  std::uint32_t question_ = 0;
};

template <class Visit>
void FrameGrid::around(const Extent& box, const Visit& visit) {
  const Range cells = range(box);
  ++question_;
  assert(question_ != 0);  // else whoever was never asked would seem to have been
  for (std::uint32_t row = cells.bottom; row <= cells.top; ++row)
    for (std::uint32_t column = cells.left; column <= cells.right; ++column)
      for (std::uint32_t entry = first_[row * columns_ + column]; entry != none;
           entry = entries_[entry].next) {
        const std::uint32_t body = entries_[entry].body;
        if (asked_[body] == question_) continue;
        asked_[body] = question_;
        visit(body);
      }
}

}  // namespace rink::physics::paper
