// An estimate of what to look at the neighbours costs, for each way to divide bodies into small and
// wide.
#include "game/physics/grid/size_classes.h"

#include <cassert>
#include <cmath>

#include "game/physics/grid/wide_bodies.h"

namespace rink::physics {

namespace {
/// Wide ones take their part of memory and of the time of all that cross cells.
constexpr std::uint32_t smalls_per_wide = 4;
}  // namespace

std::uint32_t SizeClasses::count_from(std::size_t first) const {
  std::uint32_t count = 0;
  for (std::size_t k = first; k < class_count; ++k) count += classes_[k].count;
  return count;
}

/// By a body, on the average; to visit a cell counts as much as to look at a body.
double SizeClasses::looked_at(std::size_t smalls_end, double area, double side) const {
  const double wide = count_from(smalls_end), small = count_from(0) - wide,
               reach = classes_[smalls_end - 1].reach, in_cell = small * side * side / area;
  double sum = small * 9.0 * in_cell;
  for (std::size_t k = smalls_end; k < class_count; ++k) {
    if (classes_[k].count == 0) continue;
    const double span = 1.0 + std::ceil(2.0 * (classes_[k].reach + reach) / side + 5.0 / 64.0),
                 cells = span * span;
    sum += classes_[k].count * cells * (2.0 * in_cell + 1.0);  // these look, and are looked at
  }
  return sum / (small + wide);
}

SizeClasses::Choice SizeClasses::choose(double area,
                                        const std::function<double(double)>& side_of) const {
  assert(area > 0.0);
  Choice best;
  double least = 0.0;
  for (std::size_t end = class_count; end > 0; --end) {
    const Class& widest = classes_[end - 1];
    if (widest.count == 0) continue;
    const std::uint32_t wide = count_from(end);
    if (wide > WideBodies::slot_max / 2 || smalls_per_wide * wide > count_from(0) - wide) break;
    const double looked = looked_at(end, area, side_of(widest.reach));
    if (wide > 0 && looked >= least) continue;
    least = looked;
    best = {widest.reach, wide};
  }
  return best;
}

}  // namespace rink::physics
