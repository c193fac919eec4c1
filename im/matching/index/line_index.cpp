// Keeps boxes in lines, cell by cell, and reads those lines for many askers at a time, so that one
// load hides behind the other.
#include "im/matching/index/line_index.h"

#include <algorithm>
#include <bit>
#include <cassert>

#include "im/basics/checked.h"
#include "im/matching/index/line_scan.h"

namespace rink::im {
namespace {

/// Half of the lanes are in use, so that few cells overflow. Two cells to a box at most, for a
/// crowd in 1 % of the world: with half a cell to a box they hold 180 there, and a mover reads 130
/// lines.
constexpr CellShape line_cell_shape{4.0, 1.0, 2.0};
/// With more columns or rows, edges would not fit into 32 bits; the last ones are wide then.
constexpr std::int32_t last_max = (1 << 21) - 1;
static_assert(std::int64_t{last_max} * EdgeCoding::steps < (1 << 30));
/// How many movers are in flight, and lines at most before they are read.
constexpr std::size_t in_flight_max = 32, visit_max = 512;

}  // namespace

void LineIndex::build(const Region& world, const RegionHistory& regions, Region Motion::*place) {
  assert(world.low_x < world.high_x && world.low_y < world.high_y);
  projection_ = Projection(world.low_x, world.low_y);
  is_built_ = true;
  has_grown_ = false;
  sizes_.clear();
  staged_.clear(), staged_ids_.clear();
  for (Buffer<std::uint32_t>& runs : free_) runs.clear();
  staged_.reserve(regions.size()), staged_ids_.reserve(regions.size());
  for (std::uint32_t id = 0; id < regions.size(); ++id) {
    if (is_nowhere(regions[id].*place)) continue;
    const FloatBox box = projection_(regions[id].*place);
    sizes_.count(longer_side(box));
    staged_.push_back(box);
    staged_ids_.push_back(id);
  }
  levels_.choose(sizes_, staged_.span(), world, line_cell_shape);
  for (const FloatBox& box : staged_.span()) levels_.of(sizes_, box).widen(box);
  codings_.clear();
  for (std::size_t i = 0; i < levels_.size(); ++i) {
    CellLevel& level = levels_[i];
    level.x.last = std::min(level.x.last, last_max),
    level.y.last = std::min(level.y.last, last_max);
    codings_.emplace_back(level.x.cells_per_metre, level.y.cells_per_metre, level.x.widest,
                          level.y.widest);
  }
  further_place_of_.resize(regions.size());
  lines_.resize(levels_.cell_count());
  for (std::size_t i = 0; i < lines_.size(); ++i) lines_[i].clear();
  runs_.fill(levels_.cell_count(), {0, 0, 0});
  for (std::size_t i = 0; i < staged_.size(); ++i)
    insert(staged_ids_[i], place_of(level_of(staged_[i]), staged_[i]));
  size_ = built_size_ = staged_.size();
  if constexpr (checks_whole_structures) check();
}

LineIndex::Place LineIndex::place_of(std::size_t level, const FloatBox& box) const {
  const CellLevel& cells = levels_[level];
  const std::int32_t column = cells.x.cell(box.low_x), row = cells.y.cell(box.low_y);
  const EdgeCoding& coding = codings_[level];
  const Edges edges = coding.held(box) + coding.offset(column, row);
  return {cells.first_cell + static_cast<std::uint32_t>(row) * cells.columns() +
              static_cast<std::uint32_t>(column),
          static_cast<std::uint32_t>(pack(edges, edges))};
}

/// Lines of no cell; `size` is a power of two.
std::uint32_t LineIndex::take_run(std::uint32_t size) {
  assert(std::has_single_bit(size));
  Buffer<std::uint32_t>& runs = free_[static_cast<std::size_t>(std::countr_zero(size))];
  if (!runs.empty()) {
    const std::uint32_t run = runs[runs.size() - 1];
    runs.resize(runs.size() - 1);
    return run;
  }
  const std::size_t run = lines_.size();
  assert(run + size < (std::size_t{1} << 29));  // places are counted in 32 bits
  lines_.resize(run + size);
  return static_cast<std::uint32_t>(run);
}

/// Of a full line, to a further one.
void LineIndex::copy(std::uint32_t from, std::uint32_t to) {
  assert(lines_[from].count() == lanes && to >= levels_.cell_count());
  lines_[to] = lines_[from];
  for (std::uint32_t lane = 0; lane < lanes; ++lane)
    further_place_of_[lines_[to].id(lane)] = to * lanes + lane;
}

/// Makes room for one line more. A run never shrinks, since boxes that leave a crowd often come
/// back.
void LineIndex::grow_run(std::uint32_t cell) {
  const Run old = runs_[cell];
  if (old.size < old.capacity) return;
  const std::uint32_t capacity = std::max(1u, 2 * old.capacity), wider = take_run(capacity);
  for (std::uint32_t line = 0; line < old.size; ++line) copy(old.first + line, wider + line);
  if (old.capacity != 0)
    free_[static_cast<std::size_t>(std::countr_zero(old.capacity))].push_back(old.first);
  runs_[cell] = {wider, old.size, capacity};
}

void LineIndex::insert(std::uint32_t id, const Place& place) {
  assert(id < Line::nobody && place.cell < runs_.size());
  if (id >= further_place_of_.size()) further_place_of_.resize(id + std::size_t{1});
  std::uint32_t count = lines_[place.cell].count();
  if (count == lanes) {
    grow_run(place.cell);
    copy(place.cell, runs_[place.cell].first + runs_[place.cell].size++);
    lines_[place.cell].clear();
    lines_[place.cell].set_more(true);
    count = 0;
  }
  lines_[place.cell].set(count, id, place.packed);
  lines_[place.cell].set_count(count + 1);
}

void LineIndex::remove(std::uint32_t id, std::uint32_t cell) {
  assert(cell < runs_.size());
  Line& line = lines_[cell];
  if (line.count() == 0) {
    assert(line.has_more());
    line = lines_[runs_[cell].first + --runs_[cell].size];
    line.set_count(lanes), line.set_more(runs_[cell].size != 0);
  }
  const std::uint32_t last = line.count() - 1, last_id = line.id(last), lane = line.find(id);
  if (lane < lanes) {
    line.set(lane, last_id, line.packed(last));
  } else {
    const std::uint32_t place = further_place_of_[id];
    Line& further = lines_[place / lanes];
    assert(line.has_more() && further.id(place % lanes) == id);
    further.set(place % lanes, last_id, line.packed(last));
    further_place_of_[last_id] = place;
  }
  line.clear(last);
  line.set_count(last);
}

void LineIndex::move(std::uint32_t id, std::uint32_t from, const Place& to) {
  if (from != to.cell) {
    remove(id, from);
    return insert(id, to);
  }
  if (const std::uint32_t lane = lines_[from].find(id); lane < lanes)
    return lines_[from].set(lane, to.packed);
  const std::uint32_t place = further_place_of_[id];
  assert(lines_[place / lanes].id(place % lanes) == id);
  lines_[place / lanes].set(place % lanes, to.packed);
}

void LineIndex::put(const ProbeList& moved) {
  assert(is_built_);
  constexpr std::uint32_t nowhere_yet = 0xFFFFFFFF;
  std::array<std::uint32_t, in_flight_max> from;
  std::array<Place, in_flight_max> to;
  for (std::size_t first = 0; first < moved.size(); first += in_flight_max) {
    const std::size_t count = std::min(in_flight_max, moved.size() - first);
    for (std::size_t i = 0; i < count; ++i) {
      const Probe& probe = moved.probe(first + i);
      const std::size_t level = level_of(probe.now);
      CellLevel& cells = levels_[level];
      // Wider boxes make every question wider; a level is meant to hold sides within a factor of
      // eight.
      has_grown_ |= longer_side(probe.now) > 2.0f * std::max(cells.x.widest, cells.y.widest);
      cells.widen(probe.now);
      to[i] = place_of(level, probe.now);
      const CellLevel& cells_before = levels_[level_of(probe.before)];
      from[i] = probe.before.low_x <= probe.before.high_x
                    ? cells_before.cell(probe.before.low_x, probe.before.low_y)
                    : nowhere_yet;
      __builtin_prefetch(&lines_[to[i].cell], 1);
      if (from[i] != to[i].cell && from[i] != nowhere_yet) __builtin_prefetch(&lines_[from[i]], 1);
    }
    for (std::size_t i = 0; i < count; ++i) {
      const std::uint32_t id = moved.probe(first + i).id;
      if (from[i] != nowhere_yet) move(id, from[i], to[i]);
      else insert(id, to[i]), ++size_;
    }
  }
  if constexpr (checks_whole_structures) check();
}

void LineIndex::remove(std::uint32_t id, const Region& place) {
  assert(is_built_ && size_ > 0 && !is_nowhere(place));
  const FloatBox box = projection_(place);
  remove(id, levels_[level_of(box)].cell(box.low_x, box.low_y));
  --size_;
}

bool LineIndex::is_outgrown() const {
  return !is_built_ || has_grown_ || size_ > 2 * built_size_ + 64;
}

/// As `cells_changed`, four bounds at a time: these boxes are in the cells that they were given.
CellQuery LineIndex::query(const CellLevel& level, const Probe& probe) const {
  const CellAxis &x = level.x, &y = level.y;
  if (!level.has_newcomers && probe.now.high_x - probe.now.low_x > x.widest &&
      probe.now.high_y - probe.now.low_y > y.widest)
    return cells_changed(level, hull_of(probe.before, probe.now), core_of(probe.before, probe.now));
  const auto before = std::bit_cast<FourFloats>(probe.before),
             now = std::bit_cast<FourFloats>(probe.now);
  const FourInts is_less = before < now, takes_before = is_less ^ FourInts { 0, 0, -1, -1 };
  FourFloats hull = takes_before ? before : now;
  const FourFloats widest{x.widest, y.widest, 0.0f, 0.0f};
  // Of the low edges, by a margin for rounding that cell_level.h explains.
  const FourFloats size = (hull < -hull ? -hull : hull) + widest;
  hull -= widest + size * FourFloats{0x1p-22f, 0x1p-22f, 0.0f, 0.0f};
  const auto last_x = static_cast<float>(x.last), last_y = static_cast<float>(y.last);
  const FourInts cells = whole(
      hull * FourFloats{x.cells_per_metre, y.cells_per_metre, x.cells_per_metre, y.cells_per_metre},
      FourFloats{}, FourFloats{last_x, last_y, last_x, last_y});
  return {{cells[0], cells[2]}, {cells[1], cells[3]}};
}

/// Lists the lines that `probe` must look at, and asks for them.
void LineIndex::visit(const Probe& probe, std::uint32_t asker, Buffer<Visit>& visits) const {
  for (std::size_t i = 0; i < levels_.size(); ++i) {
    const CellLevel& level = levels_[i];
    const EdgeCoding& coding = codings_[i];
    const Edges now = coding.asking(probe.now), before = coding.asking(probe.before),
                step = coding.column_step();
    query(level, probe).for_each_part([&](std::int32_t row, std::int32_t first, std::int32_t last) {
      Edges offset = coding.offset(first, row);
      std::uint32_t line = level.first_cell + static_cast<std::uint32_t>(row) * level.columns() +
                           static_cast<std::uint32_t>(first);
      const std::size_t begin = visits.size(), count = static_cast<std::size_t>(last - first) + 1;
      visits.resize(begin + count);
      for (Visit *visit = visits.data() + begin, *end = visit + count; visit != end;
           ++visit, ++line, offset += step) {
        __builtin_prefetch(&lines_[line]);
        *visit = {pack(now + offset, before + offset), line, asker};
      }
    });
  }
}

/// Writes a comparison's result; returns the next place if there was a hit.
inline LineIndex::Hit* LineIndex::list(Hit* hit, const Line& line, std::uint32_t asker,
                                       const LineHits& outcome) {
  *hit = {&line, asker, static_cast<std::uint8_t>(outcome.changed),
          static_cast<std::uint8_t>(outcome.entered), static_cast<std::uint8_t>(outcome.tied)};
  return hit + ((outcome.changed | outcome.tied) != 0 ? 1 : 0);
}

/// Compares the first lines, which were prefetched, and lists their hits. Whether a line has a hit
/// cannot be predicted, so nothing branches on it.
template <class Compare>
void LineIndex::read_lines(Answers& answers) const {
  const std::span<const Visit> visits = answers.visits.span();
  answers.hits.resize(visits.size()), answers.crowded.resize(visits.size());
  Hit* hit = answers.hits.data();
  Visit* crowded = answers.crowded.data();
  for (const Visit& visit : visits) {
    const Line& line = lines_[visit.line];
    hit = list(hit, line, visit.asker, Compare(visit.asking)(line));
    *crowded = visit;
    crowded += line.has_more() ? 1 : 0;
    answers.candidate_count += line.count();
  }
  answers.hits.resize(static_cast<std::size_t>(hit - answers.hits.data()));
  answers.crowded.resize(static_cast<std::size_t>(crowded - answers.crowded.data()));
}

/// Compares the further lines, whose places are in memory that must be prefetched before.
template <class Compare>
void LineIndex::read_further(Answers& answers) const {
  constexpr std::size_t soon = 4, later = 8;
  const std::span<const Visit> visits = answers.crowded.span();
  for (std::size_t i = 0; i < visits.size(); ++i) {
    if (i + later < visits.size()) __builtin_prefetch(&runs_[visits[i + later].line]);
    if (i + soon < visits.size()) {
      const Run run = runs_[visits[i + soon].line];
      for (std::uint32_t further = run.first; further < run.first + run.size; ++further)
        __builtin_prefetch(&lines_[further]);
    }
    const Run run = runs_[visits[i].line];
    const Compare compare(visits[i].asking);
    const std::size_t known = answers.hits.size();
    answers.hits.resize(known + run.size);
    Hit* hit = answers.hits.data() + known;
    for (const Line *further = &lines_[run.first], *end = further + run.size; further != end;
         ++further)
      hit = list(hit, *further, visits[i].asker, compare(*further));
    answers.hits.resize(static_cast<std::size_t>(hit - answers.hits.data()));
    answers.candidate_count += std::uint64_t{run.size} * lanes;
  }
}

/// Turns hits in lines into boxes.
void LineIndex::take_hits(const ProbeList& askers, const RegionHistory& regions, Answers& answers) {
  answers.found.reserve(answers.found.size() + lanes * answers.hits.size() + 1);
  for (const Hit& hit : answers.hits.span()) {
    const std::uint64_t asker = std::uint64_t{askers.probe(hit.asker).id} << 32;
    const auto change = [&](unsigned lane) {
      return asker | hit.line->id(lane) | ((hit.entered >> lane & 1u) != 0 ? entered_bit : 0u);
    };
    // Mostly there are one or two, which are written without asking how many.
    const unsigned changed = hit.changed & ~unsigned{hit.tied}, second = changed & (changed - 1u);
    const std::size_t known = answers.found.size();
    std::uint64_t* const found = answers.found.data() + known;
    found[0] = change(static_cast<unsigned>(std::countr_zero(changed | 1u << (lanes - 1))));
    found[1] = change(static_cast<unsigned>(std::countr_zero(second | 1u << (lanes - 1))));
    answers.found.resize(known + (changed != 0 ? 1 : 0) + (second != 0 ? 1 : 0));
    for (unsigned rest = second & (second - 1u); rest != 0; rest &= rest - 1)
      answers.found.push_back(change(static_cast<unsigned>(std::countr_zero(rest))));
    for (unsigned rest = hit.tied; rest != 0; rest &= rest - 1) {
      const std::uint32_t id = hit.line->id(static_cast<unsigned>(std::countr_zero(rest)));
      if (id == Line::nobody) continue;
      regions.prefetch(id);
      answers.doubts.push_back(asker | id);
    }
  }
}

template <class Compare>
void LineIndex::read(const ProbeList& askers, const TieJudge& judge, const RegionHistory& regions,
                     Answers& answers) const {
  read_lines<Compare>(answers);
  read_further<Compare>(answers);
  take_hits(askers, regions, answers);
  answers.visits.clear();
  for (const std::uint64_t doubt : answers.doubts.span()) {
    const Verdict verdict =
        judge(static_cast<std::uint32_t>(doubt >> 32), static_cast<std::uint32_t>(doubt));
    if (verdict != Verdict::no)
      answers.found.push_back(doubt | (verdict == Verdict::entered ? entered_bit : 0u));
  }
  answers.doubts.clear();
}

template <class Compare>
void LineIndex::find_changes(const Inquiry& inquiry, Answers& answers) const {
  const auto& [askers, begin, end, judge, regions] = inquiry;
  for (std::size_t first = begin; first < end; first += in_flight_max) {
    for (std::size_t i = first; i < std::min(first + in_flight_max, end); ++i) {
      visit(askers.probe(i), static_cast<std::uint32_t>(i), answers.visits);
      if (answers.visits.size() >= visit_max) read<Compare>(askers, judge, regions, answers);
    }
    read<Compare>(askers, judge, regions, answers);
  }
}

void LineIndex::find_changes(const Inquiry& inquiry, Instructions instructions,
                             Answers& answers) const {
  assert(is_built_ && inquiry.begin <= inquiry.end && inquiry.end <= inquiry.askers.size());
  assert(answers.visits.empty() && answers.doubts.empty());  // the last question was answered
  if (instructions == Instructions::scalar) find_changes<OneByOne>(inquiry, answers);
  else find_changes<BySse2>(inquiry, answers);
}

void LineIndex::check() const {
  levels_.check();
  const std::uint32_t cells = levels_.cell_count();
  assert(runs_.size() == cells && codings_.size() == levels_.size());
  [[maybe_unused]] std::size_t boxes = 0, run_lines = 0;
  for (std::uint32_t cell = 0; cell < cells; ++cell)
    boxes += check(cell), run_lines += runs_[cell].capacity;
  assert(boxes == size_);
  for (std::size_t power = 0; power < free_.size(); ++power)
    run_lines += free_[power].size() << power;
  assert(lines_.size() == cells + run_lines);  // each line is of a cell, of its run, or free
}

/// Returns how many boxes there are in the cell.
std::size_t LineIndex::check(std::uint32_t cell) const {
  const Line& line = lines_[cell];
  const Run& run = runs_[cell];
  assert(line.count() <= lanes);
  assert(line.has_more() == (run.size != 0) && run.size <= run.capacity);
  assert(run.capacity == 0 || (std::has_single_bit(run.capacity) && run.first >= runs_.size()));
  for (std::uint32_t lane = 0; lane < lanes; ++lane)
    assert((line.id(lane) == Line::nobody) == (lane >= line.count()));
  for (std::uint32_t further = run.first; further < run.first + run.size; ++further)
    for (std::uint32_t lane = 0; lane < lanes; ++lane)
      assert(further_place_of_[lines_[further].id(lane)] == further * lanes + lane);
  return line.count() + std::size_t{run.size} * lanes;
}

std::size_t LineIndex::bytes() const {
  std::size_t bytes = sizeof(Line) * lines_.capacity() + sizeof(Run) * runs_.capacity() +
                      sizeof(FloatBox) * staged_.capacity();
  for (const Buffer<std::uint32_t>& runs : free_) bytes += sizeof(std::uint32_t) * runs.capacity();
  return bytes + sizeof(std::uint32_t) * (staged_ids_.capacity() + further_place_of_.capacity());
}

}  // namespace rink::im
