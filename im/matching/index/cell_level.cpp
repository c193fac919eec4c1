// Chooses the cells of each level by how many boxes there are and how they crowd.
#include "im/matching/index/cell_level.h"

#include <array>
#include <cassert>

#include "im/basics/checked.h"

namespace rink::im {
namespace {

constexpr double cell_max = 1 << 28;

/// Cells are numbered in single precision, which counts no further.
constexpr double cells_across_max = 0x1p24;

/// Finite also for a world that is tiny.
CellAxis axis(double cells, double length) {
  assert(length > 0.0 && !std::isnan(cells));
  const double bounded = std::min(std::max(1.0, std::floor(cells)), cells_across_max);
  return {static_cast<float>(std::min(bounded / length, static_cast<double>(float_max))),
          static_cast<std::int32_t>(bounded) - 1, 0.0f};
}

CellLevel lay_out(std::size_t box_count, double width, double height, double crowding,
                  const CellShape& shape) {
  assert(crowding >= 1.0);  // no denser than even is even
  const double boxes = std::max(1.0, static_cast<double>(box_count));
  const double squares =
      std::min({boxes * crowding / shape.boxes_per_square,
                boxes * shape.cells_per_box_max / shape.columns_per_row, cell_max});
  // A world that is long and thin has one row.
  const double rows =
      std::clamp(std::floor(std::sqrt(squares * (height / width))), 1.0, std::max(1.0, squares));
  CellLevel level;
  level.y = axis(rows, height);
  level.x = axis(squares * shape.columns_per_row / rows, width);
  return level;
}

/// How much denser the boxes are around a box than on average, by a sample: the chance that two of
/// them share one of 256 squares, 1/256 if even.
double crowding(std::span<const FloatBox> boxes, double width, double height) {
  constexpr std::int32_t squares_across = 16;
  constexpr std::size_t sample_max = 1024;
  const CellAxis x = axis(squares_across, width), y = axis(squares_across, height);
  std::array<std::uint32_t, squares_across * squares_across> counts{};
  for (std::size_t i = 0; i < boxes.size(); i += boxes.size() / sample_max + 1)
    ++counts[static_cast<std::size_t>(y.cell(boxes[i].low_y)) * squares_across +
             static_cast<std::size_t>(x.cell(boxes[i].low_x))];
  double pairs = 0.0, sampled = 0.0;
  for (const double count : counts) pairs += count * (count - 1.0), sampled += count;
  return sampled > 1.0 ? std::max(1.0, pairs / (sampled * (sampled - 1.0)) *
                                           static_cast<double>(counts.size()))
                       : 1.0;
}

}  // namespace

void CellLevels::choose(SizeLevels& sizes, std::span<const FloatBox> boxes, const Region& world,
                        const CellShape& shape) {
  assert(is_valid(world));
  sizes.choose();
  assert(sizes.size() >= 1);
  const double width = world.high_x - world.low_x, height = world.high_y - world.low_y,
               crowd = crowding(boxes, width, height);
  levels_.clear();
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    const std::uint32_t first = levels_.empty() ? 0 : cell_count();
    levels_.push_back(lay_out(sizes.population(i), width, height, crowd, shape));
    levels_.back().first_cell = first;
  }
  if constexpr (checks_whole_structures) check();
}

void CellLevels::check() const {
  assert(!levels_.empty() && levels_.size() <= SizeLevels::level_max);
  [[maybe_unused]] std::uint64_t first = 0;
  for (const CellLevel& level : levels_) {
    assert(level.first_cell == first);
    assert(level.x.last >= 0 && level.y.last >= 0);
    assert(level.x.cells_per_metre >= 0.0f && level.y.cells_per_metre >= 0.0f);
    assert(level.x.widest >= 0.0f && level.y.widest >= 0.0f);
    assert(level.x.drift >= 0.0f && level.y.drift >= 0.0f);
    first += std::uint64_t{level.columns()} * (static_cast<std::uint64_t>(level.y.last) + 1);
    assert(first <= std::numeric_limits<std::uint32_t>::max());  // cells are counted in 32 bits
  }
}

}  // namespace rink::im
