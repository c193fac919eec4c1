// Chooses the cells of a level by how many boxes there are and how they crowd.
#include "im/matching/cell_level.h"

namespace rink::im {
namespace {

/// Boxes in a square as high as a row, where boxes are: with more, rows hold too many candidates; with fewer, a question visits too many rows.
constexpr double boxes_per_square = 16.0;
/// Columns are cheap, since the cells of a row lie one after the other.
constexpr double columns_per_row = 3.0;
constexpr double cells_per_box_max = 2.0;
constexpr double cell_max = 1 << 28;

/// Finite also for a world that is tiny.
CellAxis axis(double cells, double length) {
  const double bounded = std::min(std::max(1.0, std::floor(cells)), 1e9);
  return {static_cast<float>(std::min(bounded / length, static_cast<double>(float_max))), static_cast<std::int32_t>(bounded) - 1, 0.0f};
}

}  // namespace

CellLevel lay_out(std::size_t box_count, double width, double height, double crowding) {
  const double boxes = std::max(1.0, static_cast<double>(box_count));
  const double squares = std::min({boxes * crowding / boxes_per_square, boxes * cells_per_box_max / columns_per_row, cell_max});
  // A world that is long and thin has one row.
  const double rows = std::clamp(std::floor(std::sqrt(squares * (height / width))), 1.0, std::max(1.0, squares));
  CellLevel level;
  level.y = axis(rows, height);
  level.x = axis(squares * columns_per_row / rows, width);
  return level;
}

}  // namespace rink::im
