// Bins boxes by counting sort, level by level, and finds the stretches of cells that a query must
// look at.
#include "im/matching/index/box_index.h"

#include <cassert>
#include <cmath>
#include <utility>

#include "im/basics/checked.h"
#include "im/matching/ring.h"

namespace rink::im {
namespace {

/// With more boxes to a square, rows hold too many candidates; with fewer, a question visits too
/// many rows. Columns are cheap: the cells of a row lie one after the other.
constexpr CellShape cell_shape_for_one{32.0, 6.0, 2.0};
/// Eight neighbours share a visit: the smaller the squares, the nearer together the eight are.
constexpr CellShape cell_shape_for_groups{6.0, 3.0, 2.0};

/// Boxes keep their cells until they may be this part of a column away from them: farther, queries
/// look at so many more that binning anew is cheaper.
constexpr float drift_max = 0.65f;
/// Nor do they keep cells when their hulls have become so many times as wide.
constexpr float growth_max = 1.25f;
/// The rounding of a drift is bounded for as many.
constexpr std::uint32_t follow_max = 100;

}  // namespace

void BoxIndex::begin(const Region& world, std::size_t count_max, Boxes kind) {
  assert(world.low_x < world.high_x && world.low_y < world.high_y);
  assert(is_valid(world) && count_max <= RegionHistory::id_max);
  world_ = world;
  projection_ = Projection(world.low_x, world.low_y);
  is_moving_ = kind != Boxes::resting;
  is_for_groups_ = kind == Boxes::moving_for_groups;
  is_exact_ = true;
  sizes_.clear();
  staged_count_ = 0;
  staged_ids_.resize(count_max), staged_now_.resize(count_max);
  if (is_moving_) staged_before_.resize(count_max);
}

FloatBox BoxIndex::hull(std::size_t staged) const {
  return is_moving_ ? hull_of(staged_before_[staged], staged_now_[staged]) : staged_now_[staged];
}

void BoxIndex::count_cells() {
  starts_.fill(levels_.cell_count() + std::size_t{1}, 0);
  cells_.resize(staged_count_);
  // Nearly always there is one level. As a local copy it stays in registers; the counts could be
  // anyone's memory.
  if (levels_.size() > 1)
    return count_cells(
        [this](const FloatBox& box) -> CellLevel& { return levels_.of(sizes_, box); });
  CellLevel only = levels_[0];
  count_cells([&only](const FloatBox&) -> CellLevel& { return only; });
  levels_.replace_only(only);
}

template <class LevelOf>
void BoxIndex::count_cells(const LevelOf& level_of) {
  std::uint32_t* const counts = starts_.data();
  std::uint32_t* const cells = cells_.data();
  for (std::size_t i = 0, count = staged_count_; i < count; ++i) {
    const FloatBox box = hull(i);
    CellLevel& level = level_of(box);
    level.widen(box);
    if (is_moving_) level.has_newcomers |= staged_before_[i].low_x > staged_before_[i].high_x;
    ++counts[cells[i] = level.cell(box.low_x, box.low_y)];
  }
}

void BoxIndex::sort() {
  std::uint32_t end = 0;
  for (std::size_t cell = 0; cell < starts_.size(); ++cell) starts_[cell] = end += starts_[cell];
  const std::size_t count = staged_count_;
  assert(end == count);  // each box was counted in one cell
  ids_.reserve(count + BoxStore::readable_past_the_end);
  ids_.resize(count);
  for (std::size_t i = 0; i < BoxStore::readable_past_the_end; ++i) ids_.data()[count + i] = 0;
  now_.resize(count);
  if (is_moving_) before_.resize(count);
  for (std::size_t i = count; i-- > 0;) {
    const std::uint32_t place = --starts_[cells_[i]];
    ids_[place] = staged_ids_[i];
    now_.set(place, staged_now_[i]);
    if (is_moving_) before_.set(place, staged_before_[i]);
  }
  assert(starts_[0] == 0 && starts_[starts_.size() - 1] == count);
}

void BoxIndex::build() {
  levels_.choose(sizes_, staged_now_.span().first(staged_count_), world_,
                 is_for_groups_ ? cell_shape_for_groups : cell_shape_for_one);
  count_cells();
  sort();
  follow_count_ = 0;
  may_follow_ = true;
  if constexpr (checks_whole_structures) check();
}

bool BoxIndex::follow(const RegionHistory& regions, Instructions instructions) {
  assert(is_moving_ && regions.present_count() == size());
  if (++follow_count_ > follow_max || !may_follow_) return false;
  std::swap(before_, now_);
  const Advancing boxes{ids_.data(), regions, projection_, std::as_const(before_).columns(),
                        now_.columns()};
  for (std::size_t i = 0; i < levels_.size(); ++i) {
    CellLevel& level = levels_[i];
    const CellLevel built = level;
    take_up(advance(instructions)(boxes, starts_[built.first_cell],
                                  starts_[built.first_cell + built.cell_count()], is_exact_),
            level);
    const auto is_worth_it = [](const CellAxis& axis, const CellAxis& before) {
      return axis.drift * axis.cells_per_metre <= drift_max &&
             axis.widest <= growth_max * before.widest;
    };
    if (!is_worth_it(level.x, built.x) || !is_worth_it(level.y, built.y)) return false;
    // One step more like this and the next pass over all would be for nothing.
    const auto leaves_room = [](const CellAxis& axis, const CellAxis& before) {
      return (2.0f * axis.drift - before.drift) * axis.cells_per_metre <= drift_max;
    };
    may_follow_ = may_follow_ && leaves_room(level.x, built.x) && leaves_room(level.y, built.y);
  }
  if constexpr (checks_whole_structures) check();
  return true;
}

void BoxIndex::take_up(const Advanced& advanced, CellLevel& level) {
  assert(advanced.widest_x >= 0.0f && advanced.widest_y >= 0.0f);
  assert(advanced.shift_x >= 0.0f && advanced.shift_y >= 0.0f);
  assert(advanced.begun_x >= 0.0f && advanced.begun_y >= 0.0f);
  is_exact_ = is_exact_ && advanced.is_exact;
  level.has_newcomers = false;
  level.x.widest = advanced.widest_x, level.y.widest = advanced.widest_y;
  // The cell is that of the hull's low corner, so at first a box may be beyond it by the step that
  // was binned.
  const bool is_first = follow_count_ == 1;
  level.x.drift += is_first ? advanced.shift_x + advanced.begun_x : advanced.shift_x;
  level.y.drift += is_first ? advanced.shift_y + advanced.begun_y : advanced.shift_y;
}

template <class Query>
std::size_t BoxIndex::collect(const CellLevel& level, const Query& query,
                              Buffer<Stretch>& stretches) const {
  assert(query.rows.first <= query.rows.last);
  std::size_t count = stretches.size(), candidates = 0;
  stretches.reserve(count + 2 * static_cast<std::size_t>(query.rows.last - query.rows.first + 1));
  Stretch* out = stretches.data();
  query.for_each_run(level, [&](std::uint32_t first_cell, std::uint32_t last_cell) {
    const std::uint32_t first = starts_[first_cell], end = starts_[last_cell + 1];
    out[count] = {first, end};
    count += first != end;
    candidates += end - first;
  });
  stretches.resize(count);
  return candidates;
}

std::size_t BoxIndex::find_overlaps(const FloatBox& box, Buffer<Stretch>& stretches) const {
  std::size_t candidates = 0;
  for (const CellLevel& level : levels_)
    candidates += collect(level, cells_touched(level, box), stretches);
  return candidates;
}

std::size_t BoxIndex::find_changes(const FloatBox& hull, const FloatBox& core,
                                   Buffer<Stretch>& stretches) const {
  std::size_t candidates = 0;
  for (const CellLevel& level : levels_)
    candidates += collect(level, cells_changed(level, hull, core), stretches);
  return candidates;
}

std::size_t BoxIndex::find_disc_changes(const Probe& probe, Buffer<Stretch>& stretches) const {
  const Ring ring(probe.before, probe.now);
  if (!ring.is_plain()) return find_overlaps(hull_of(probe.before, probe.now), stretches);
  std::size_t candidates = 0;
  for (const CellLevel& level : levels_)
    candidates += collect(level, RingQuery(level, ring), stretches);
  return candidates;
}

void BoxIndex::check() const {
  levels_.check();
  assert(starts_.size() == levels_.cell_count() + std::size_t{1});
  assert(starts_[0] == 0 && starts_[starts_.size() - 1] == ids_.size());
  assert(std::is_sorted(starts_.data(), starts_.data() + starts_.size()));
  assert(ids_.size() == staged_count_);
  // A rearrangement of those staged has their sum, of the ids and of a function of them.
  [[maybe_unused]] std::uint64_t staged = 0, held = 0;
  for (std::size_t i = 0; i < staged_count_; ++i) {
    staged += (std::uint64_t{staged_ids_[i]} << 32) + staged_ids_[i] % 65'521u;
    held += (std::uint64_t{ids_[i]} << 32) + ids_[i] % 65'521u;
  }
  assert(staged == held);
  for (const CellLevel& level : levels_) check(level);
}

/// A query at a box's place finds its cell.
void BoxIndex::check(const CellLevel& level) const {
  for (std::uint32_t cell = 0; cell < level.cell_count(); ++cell)
    for (std::uint32_t i = starts_[level.first_cell + cell];
         i < starts_[level.first_cell + cell + 1]; ++i) {
      const FloatBox box = is_moving_ ? hull_of(before_[i], now_[i]) : now_[i];
      assert(box.high_x - box.low_x <= level.x.widest && box.high_y - box.low_y <= level.y.widest);
      [[maybe_unused]] const CellQuery query = cells_touched(level, box);
      [[maybe_unused]] const auto column = static_cast<std::int32_t>(cell % level.columns()),
                                  row = static_cast<std::int32_t>(cell / level.columns());
      assert(query.columns.first <= column && column <= query.columns.last);
      assert(query.rows.first <= row && row <= query.rows.last);
    }
}

std::size_t BoxIndex::bytes() const {
  return sizeof(FloatBox) * (staged_before_.capacity() + staged_now_.capacity()) +
         sizeof(std::uint32_t) *
             (staged_ids_.capacity() + cells_.capacity() + starts_.capacity() + ids_.capacity()) +
         before_.bytes() + now_.bytes();
}

}  // namespace rink::im
