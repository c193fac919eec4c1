// Bins boxes by counting sort, level by level, and finds the stretches of cells that a question must look at.
#include "im/matching/box_index.h"

#include <cassert>

namespace rink::im {
namespace {

constexpr std::size_t readable_past_the_end = 8;

}  // namespace

void BoxStore::resize(std::size_t count) {
  for (Buffer<float>* column : {&low_x_, &low_y_, &high_x_, &high_y_}) {
    column->resize(count + readable_past_the_end);
    for (std::size_t i = count; i < column->size(); ++i) (*column)[i] = 0.0f;
  }
}

void BoxIndex::begin(const Region& world, std::size_t count_max, bool is_moving) {
  assert(world.low_x < world.high_x && world.low_y < world.high_y);
  world_ = world;
  projection_ = Projection(world.low_x, world.low_y);
  is_moving_ = is_moving;
  is_exact_ = true;
  sizes_.clear();
  staged_ids_.clear(), staged_before_.clear(), staged_now_.clear();
  staged_ids_.reserve(count_max), staged_now_.reserve(count_max);
  if (is_moving) staged_before_.reserve(count_max);
}

FloatBox BoxIndex::hull(std::size_t staged) const { return is_moving_ ? hull_of(staged_before_[staged], staged_now_[staged]) : staged_now_[staged]; }

/// How much denser the boxes are around a box than on average, by a sample: the chance that two of them share one of 256 squares, 1/256 if even.
double BoxIndex::crowding() const {
  constexpr std::size_t squares_across = 16, sample_max = 1024;
  const std::size_t stride = staged_ids_.size() / sample_max + 1;
  const CellAxis x{static_cast<float>(squares_across / (world_.high_x - world_.low_x)), squares_across - 1}, y{static_cast<float>(squares_across / (world_.high_y - world_.low_y)), squares_across - 1};
  std::array<std::uint32_t, squares_across * squares_across> counts{};
  for (std::size_t i = 0; i < staged_ids_.size(); i += stride)
    ++counts[static_cast<std::size_t>(y.cell(staged_now_[i].low_y)) * squares_across + static_cast<std::size_t>(x.cell(staged_now_[i].low_x))];
  double pairs = 0.0, sampled = 0.0;
  for (const double count : counts) pairs += count * (count - 1.0), sampled += count;
  return sampled > 1.0 ? std::max(1.0, pairs / (sampled * (sampled - 1.0)) * static_cast<double>(counts.size())) : 1.0;
}

void BoxIndex::choose_levels() {
  sizes_.choose();
  levels_.clear();
  const double crowd = crowding();
  std::uint32_t cell_count = 0;
  for (std::size_t i = 0; i < sizes_.size(); ++i) {
    levels_.push_back(lay_out(sizes_.population(i), world_.high_x - world_.low_x, world_.high_y - world_.low_y, crowd));
    levels_.back().first_cell = cell_count;
    cell_count += levels_.back().cell_count();
  }
  starts_.fill(cell_count + std::size_t{1}, 0);
}

void BoxIndex::count_cells() {
  cells_.resize(staged_ids_.size());
  for (std::size_t i = 0; i < staged_ids_.size(); ++i) {
    const FloatBox box = hull(i);
    CellLevel& level = levels_[sizes_.size() == 1 ? 0 : sizes_.level(longer_side(box))];
    level.x.widest = std::max(level.x.widest, box.high_x - box.low_x);
    level.y.widest = std::max(level.y.widest, box.high_y - box.low_y);
    if (is_moving_) level.has_newcomers |= staged_before_[i].low_x > staged_before_[i].high_x;
    cells_[i] = level.cell(box.low_x, box.low_y);
    ++starts_[cells_[i]];
  }
}

void BoxIndex::sort() {
  std::uint32_t end = 0;
  for (std::size_t cell = 0; cell < starts_.size(); ++cell) starts_[cell] = end += starts_[cell];
  const std::size_t count = staged_ids_.size();
  ids_.reserve(count + readable_past_the_end);
  ids_.resize(count);
  for (std::size_t i = 0; i < readable_past_the_end; ++i) ids_.data()[count + i] = 0;
  now_.resize(count);
  if (is_moving_) before_.resize(count);
  for (std::size_t i = count; i-- > 0;) {
    const std::uint32_t place = --starts_[cells_[i]];
    ids_[place] = staged_ids_[i];
    now_.set(place, staged_now_[i]);
    if (is_moving_) before_.set(place, staged_before_[i]);
  }
}

void BoxIndex::build() {
  choose_levels();
  count_cells();
  sort();
}

/// The cells of `columns` and `rows` without those inside, row after row.
std::size_t BoxIndex::collect(const CellLevel& level, CellRange columns, CellRange rows, CellRange inner_columns, CellRange inner_rows, Buffer<Stretch>& stretches) const {
  std::size_t count = stretches.size(), candidates = 0;
  stretches.reserve(count + 2 * static_cast<std::size_t>(rows.last - rows.first + 1));
  Stretch* out = stretches.data();
  const auto add = [&](std::uint32_t first, std::uint32_t end) {
    out[count] = {first, end};
    count += first != end;
    candidates += end - first;
  };
  for (std::int32_t row = rows.first; row <= rows.last; ++row) {
    const std::uint32_t* starts = &starts_[level.first_cell + static_cast<std::size_t>(row) * level.columns()];
    if (!inner_columns.is_empty() && inner_rows.first <= row && row <= inner_rows.last) {
      add(starts[columns.first], starts[inner_columns.first]);
      add(starts[inner_columns.last + 1], starts[columns.last + 1]);
    } else {
      add(starts[columns.first], starts[columns.last + 1]);
    }
  }
  stretches.resize(count);
  return candidates;
}

std::size_t BoxIndex::find_overlaps(const FloatBox& box, Buffer<Stretch>& stretches) const {
  constexpr CellRange none{0, -1};
  std::size_t candidates = 0;
  for (const CellLevel& level : levels_)
    candidates += collect(level, level.x.touched(box.low_x, box.high_x), level.y.touched(box.low_y, box.high_y), none, none, stretches);
  return candidates;
}

std::size_t BoxIndex::find_changes(const Probe& probe, Buffer<Stretch>& stretches) const {
  const FloatBox &a = probe.before, &b = probe.now;
  const FloatBox outer = hull_of(a, b);
  std::size_t candidates = 0;
  for (const CellLevel& level : levels_) {
    CellRange inner_columns{0, -1}, inner_rows{0, -1};
    if (!level.has_newcomers) {
      inner_columns = level.x.within(std::max(a.low_x, b.low_x), std::min(a.high_x, b.high_x));
      inner_rows = level.y.within(std::max(a.low_y, b.low_y), std::min(a.high_y, b.high_y));
    }
    candidates += collect(level, level.x.touched(outer.low_x, outer.high_x), level.y.touched(outer.low_y, outer.high_y), inner_columns, inner_rows, stretches);
  }
  return candidates;
}

std::size_t BoxIndex::bytes() const {
  return sizeof(FloatBox) * (staged_before_.capacity() + staged_now_.capacity()) + sizeof(std::uint32_t) * (staged_ids_.capacity() + cells_.capacity() + starts_.capacity() + ids_.capacity()) +
         before_.bytes() + now_.bytes();
}

}  // namespace rink::im
