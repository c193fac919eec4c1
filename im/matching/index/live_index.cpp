// Keeps boxes in blocks of lanes, cell by cell.
#include "im/matching/index/live_index.h"

#include <bit>
#include <cassert>

#include "im/basics/checked.h"
#include "im/matching/ring.h"

namespace rink::im {
namespace {

/// Half of the lanes are in use, so that few cells overflow.
constexpr CellShape live_cell_shape{4.0, 1.0, 0.5};

/// How many movers ahead memory is asked for.
constexpr std::size_t movers_ahead = 8;

}  // namespace

void LiveIndex::build(const Region& world, const RegionHistory& regions, Region Motion::*place) {
  assert(world.low_x < world.high_x && world.low_y < world.high_y);
  projection_ = Projection(world.low_x, world.low_y);
  is_built_ = true;
  has_grown_ = false;
  sizes_.clear();
  staged_.clear(), staged_ids_.clear();
  for (Buffer<std::uint32_t>& runs : free_) runs.clear();
  staged_.reserve(regions.size()), staged_ids_.reserve(regions.size());
  for (std::uint32_t id = 0; id < regions.size(); ++id) {
    const Region& region = regions[id].*place;
    if (is_nowhere(region)) continue;
    const FloatBox box = projection_(region);
    sizes_.count(longer_side(box));
    staged_.push_back(box);
    staged_ids_.push_back(id);
  }
  levels_.choose(sizes_, staged_.span(), world, live_cell_shape);
  for (const FloatBox& box : staged_.span()) levels_.of(sizes_, box).widen(box);
  place_of_.fill(regions.size(), none);
  blocks_.clear();
  add_blocks(levels_.cell_count());
  heads_.fill(levels_.cell_count(), {0, 0});
  for (std::size_t i = 0; i < staged_.size(); ++i)
    insert(levels_.of(sizes_, staged_[i]).cell(staged_[i].low_x, staged_[i].low_y), staged_ids_[i],
           staged_[i]);
  size_ = built_size_ = staged_.size();
  if constexpr (checks_whole_structures) check();
}

FloatBox LiveIndex::box(std::uint32_t place) const {
  const Block& block = blocks_[place / lanes];
  const std::uint32_t lane = place % lanes;
  return {block.low_x[lane], block.low_y[lane], block.high_x[lane], block.high_y[lane]};
}

void LiveIndex::set(std::uint32_t place, const FloatBox& box) {
  Block& block = blocks_[place / lanes];
  const std::uint32_t lane = place % lanes;
  block.low_x[lane] = box.low_x, block.low_y[lane] = box.low_y, block.high_x[lane] = box.high_x,
  block.high_y[lane] = box.high_y;
}

void LiveIndex::set(std::uint32_t place, std::uint32_t id, const FloatBox& box) {
  set(place, box);
  blocks_[place / lanes].ids[place % lanes] = id;
  place_of_[id] = place;
}

void LiveIndex::clear(std::uint32_t place) {
  set(place, float_nowhere);
  blocks_[place / lanes].ids[place % lanes] = nobody;
}

void LiveIndex::add_blocks(std::uint32_t count) {
  const std::size_t first = blocks_.size();
  assert(first + count < none / stride);  // places and stretches are counted in 32 bits
  blocks_.resize(first + count);
  for (std::size_t block = first; block < first + count; ++block)
    empty(static_cast<std::uint32_t>(block));
}

void LiveIndex::empty(std::uint32_t block) {
  for (std::uint32_t place = block * lanes; place < (block + 1) * lanes; ++place) clear(place);
  blocks_[block].run = blocks_[block].run_size = blocks_[block].run_capacity = 0;
  blocks_[block].cell = block;
}

/// Blocks of no cell; `size` is a power of two.
std::uint32_t LiveIndex::take_run(std::uint32_t size) {
  assert(std::has_single_bit(size));
  Buffer<std::uint32_t>& runs = free_[static_cast<std::size_t>(std::countr_zero(size))];
  if (!runs.empty()) {
    const std::uint32_t run = runs[runs.size() - 1];
    runs.resize(runs.size() - 1);
    return run;
  }
  const auto run = static_cast<std::uint32_t>(blocks_.size());
  add_blocks(size);
  return run;
}

/// Of a full block, to another of the same cell.
void LiveIndex::copy_boxes(std::uint32_t from, std::uint32_t to) {
  const Block old = blocks_[to];
  blocks_[to] = blocks_[from];
  blocks_[to].run = old.run, blocks_[to].run_size = old.run_size,
  blocks_[to].run_capacity = old.run_capacity;
  for (std::uint32_t lane = 0; lane < lanes; ++lane)
    place_of_[blocks_[to].ids[lane]] = to * lanes + lane;
}

/// Makes room for one block more. A run never shrinks, since boxes that leave a crowd often come
/// back.
void LiveIndex::grow_run(std::uint32_t cell) {
  const std::uint32_t run = blocks_[cell].run, size = blocks_[cell].run_size,
                      capacity = blocks_[cell].run_capacity;
  if (size < capacity) return;
  const std::uint32_t wider = take_run(std::max(1u, 2 * capacity));
  for (std::uint32_t block = 0; block < size; ++block) copy_boxes(run + block, wider + block);
  if (capacity != 0) free_[static_cast<std::size_t>(std::countr_zero(capacity))].push_back(run);
  blocks_[cell].run = wider;
  blocks_[cell].run_capacity = std::max(1u, 2 * capacity);
}

void LiveIndex::insert(std::uint32_t cell, std::uint32_t id, const FloatBox& box) {
  assert(cell < heads_.size() && id < place_of_.size() && !holds(id));
  if (heads_[cell].count == lanes) {
    grow_run(cell);
    copy_boxes(cell, blocks_[cell].run + blocks_[cell].run_size++);
    for (std::uint32_t place = cell * lanes; place < (cell + 1) * lanes; ++place) clear(place);
    heads_[cell] = {0, 1};
  }
  set(cell * lanes + heads_[cell].count++, id, box);
}

/// Widens the level to hold the box.
std::uint32_t LiveIndex::cell_for(const FloatBox& box) {
  CellLevel& level = levels_.of(sizes_, box);
  // Wider boxes make every question wider; a level is meant to hold sides within a factor of eight.
  has_grown_ |= longer_side(box) > 2.0f * std::max(level.x.widest, level.y.widest);
  level.widen(box);
  return level.cell(box.low_x, box.low_y);
}

void LiveIndex::put(std::uint32_t id, const Region& region) {
  const FloatBox box = projection_(region);
  const std::uint32_t cell = cell_for(box);
  if (holds(id)) {
    if (blocks_[place_of_[id] / lanes].cell == cell) return set(place_of_[id], box);
    remove(id);
  }
  while (place_of_.size() <= id) place_of_.push_back(none);
  insert(cell, id, box);
  ++size_;
}

void LiveIndex::put(std::span<const std::uint32_t> ids, const RegionHistory& regions) {
  assert(is_built_);
  for (std::size_t i = 0; i < ids.size(); ++i) {
    if (i + 2 * movers_ahead < ids.size() && ids[i + 2 * movers_ahead] < place_of_.size())
      __builtin_prefetch(&place_of_[ids[i + 2 * movers_ahead]]);
    if (i + movers_ahead < ids.size()) {
      const std::uint32_t next = ids[i + movers_ahead];
      regions.prefetch(next);
      if (holds(next))
        for (std::uint32_t part = 0; part < sizeof(Block); part += 64)
          __builtin_prefetch(
              reinterpret_cast<const char*>(&blocks_[place_of_[next] / lanes]) + part, 1);
    }
    assert(regions.contains(ids[i]));
    put(ids[i], regions[ids[i]].now);
  }
  if constexpr (checks_whole_structures) check();
}

void LiveIndex::remove(std::uint32_t id) {
  if (!holds(id)) return;
  const std::uint32_t cell = blocks_[place_of_[id] / lanes].cell;
  if (heads_[cell].count == 0) {
    assert(blocks_[cell].run_size > 0);
    copy_boxes(blocks_[cell].run + --blocks_[cell].run_size, cell);
    heads_[cell] = {lanes, blocks_[cell].run_size != 0};
  }
  const std::uint32_t place = place_of_[id], last = cell * lanes + --heads_[cell].count;
  if (place != last) set(place, blocks_[cell].ids[last % lanes], box(last));
  clear(last);
  place_of_[id] = none;
  --size_;
}

bool LiveIndex::is_outgrown() const {
  return !is_built_ || has_grown_ || size_ > 2 * built_size_ + 64;
}

Candidates LiveIndex::candidates() const {
  assert(is_built_);
  const Block& first = blocks_[0];
  const BoxColumns columns{first.low_x, first.low_y, first.high_x, first.high_y};
  return {columns, columns, first.ids, stride};
}

template <class Query>
std::size_t LiveIndex::collect(const CellLevel& level, const Query& query,
                               Buffer<Stretch>& stretches) const {
  std::size_t candidates = 0;
  query.for_each_run(level, [&](std::uint32_t first, std::uint32_t last) {
    stretches.push_back({first * stride, (last + 1) * stride});
    for (std::uint32_t cell = first; cell <= last; ++cell) {
      candidates += heads_[cell].count;
      for (std::uint32_t line = 0; line < sizeof(Block); line += 64)
        __builtin_prefetch(reinterpret_cast<const char*>(&blocks_[cell]) + line);
      if (heads_[cell].has_more) {
        const Block& head = blocks_[cell];
        stretches.push_back({head.run * stride, (head.run + head.run_size) * stride});
        candidates += head.run_size * lanes;
      }
    }
  });
  return candidates;
}

std::size_t LiveIndex::find_changes(const Probe& probe, Buffer<Stretch>& stretches) const {
  std::size_t candidates = 0;
  for (const CellLevel& level : levels_)
    candidates += collect(
        level,
        cells_changed(level, hull_of(probe.before, probe.now), core_of(probe.before, probe.now)),
        stretches);
  return candidates;
}

std::size_t LiveIndex::find_disc_changes(const Probe& probe, Buffer<Stretch>& stretches) const {
  const Ring ring(probe.before, probe.now);
  std::size_t candidates = 0;
  for (const CellLevel& level : levels_)
    candidates +=
        ring.is_plain()
            ? collect(level, RingQuery(level, ring), stretches)
            : collect(level, cells_touched(level, hull_of(probe.before, probe.now)), stretches);
  return candidates;
}

void LiveIndex::check() const {
  levels_.check();
  const std::uint32_t cells = levels_.cell_count();
  assert(heads_.size() == cells);
  [[maybe_unused]] std::size_t boxes = 0, run_blocks = 0, known = 0;
  for (std::uint32_t cell = 0; cell < cells; ++cell)
    boxes += check(cell), run_blocks += blocks_[cell].run_capacity;
  for (const std::uint32_t place : place_of_.span()) known += place != none ? 1u : 0u;
  assert(boxes == size_ && known == size_);
  for (std::size_t power = 0; power < free_.size(); ++power)
    run_blocks += free_[power].size() << power;
  assert(blocks_.size() == cells + run_blocks);  // each is of a cell, of its run, or free
}

/// Returns how many boxes there are in the cell.
std::size_t LiveIndex::check(std::uint32_t cell) const {
  const Block& head = blocks_[cell];
  const std::uint32_t count = heads_[cell].count;
  assert(head.cell == cell && count <= lanes);
  assert((heads_[cell].has_more != 0) == (head.run_size != 0));
  assert(head.run_size <= head.run_capacity);
  for (std::uint32_t lane = 0; lane < count; ++lane) check_place(cell * lanes + lane, cell);
  for (std::uint32_t lane = count; lane < lanes; ++lane)
    assert(head.ids[lane] == nobody && head.low_x[lane] > head.high_x[lane]);
  for (std::uint32_t place = head.run * lanes; place < (head.run + head.run_size) * lanes; ++place)
    check_place(place, cell);
  return count + std::size_t{head.run_size} * lanes;
}

void LiveIndex::check_place(std::uint32_t place, [[maybe_unused]] std::uint32_t cell) const {
  const FloatBox at = box(place);
  [[maybe_unused]] const CellLevel& level =
      levels_[levels_.size() == 1 ? 0 : sizes_.level(longer_side(at))];
  assert(blocks_[place / lanes].cell == cell);
  assert(place_of_[blocks_[place / lanes].ids[place % lanes]] == place);
  assert(level.cell(at.low_x, at.low_y) == cell);
  assert(at.high_x - at.low_x <= level.x.widest && at.high_y - at.low_y <= level.y.widest);
}

std::size_t LiveIndex::bytes() const {
  return sizeof(Block) * blocks_.capacity() + sizeof(Head) * heads_.capacity() +
         sizeof(FloatBox) * staged_.capacity() +
         sizeof(std::uint32_t) * (place_of_.capacity() + staged_ids_.capacity());
}

}  // namespace rink::im
