// Looks the cells of a group up, and takes a smaller group where they are too many.
#include "im/matching/group_join.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>

#include "im/matching/short_sort.h"

namespace rink::im {
namespace {

/// A group that looks at so few boxes is never divided.
constexpr std::size_t never_divided = 128;
/// One that looks at more may look at so many times as many as its first asker alone: at the end of
/// a row the next asker is at the other side of the world.
constexpr std::size_t times_one = 3;

struct GroupBoxes {
  FloatBox hull, core;
};

/// What holds all places of the askers, and what all of them hold.
GroupBoxes boxes_of(const BoxIndex& askers, std::size_t first, std::size_t count) {
  const Probe one = askers.probe(first);
  GroupBoxes all{hull_of(one.before, one.now), core_of(one.before, one.now)};
  for (std::size_t i = 1; i < count; ++i) {
    const Probe probe = askers.probe(first + i);
    all.hull = hull_of(all.hull, hull_of(probe.before, probe.now));
    all.core = core_of(all.core, core_of(probe.before, probe.now));
  }
  return all;
}

}  // namespace

void GroupJoin::clear() { own_.clear(), other_.clear(); }

std::size_t GroupJoin::gather(const Inquiry& inquiry, std::size_t first, std::size_t end,
                              Part& part) {
  const auto& [index, askers, judge] = inquiry;
  // Of the same eight whoever begins: then two who share the work look at the same boxes as one.
  for (std::size_t count = std::min(end - first, scan_width - first % scan_width);; count /= 2) {
    part.stretches.clear();
    const GroupBoxes boxes = boxes_of(askers, first, count);
    const std::size_t looked_at = index.find_changes(boxes.hull, boxes.core, part.stretches);
    part.looked_at = looked_at;
    if (looked_at <= never_divided || count == 1) return count;
    const std::size_t before = part.stretches.size();
    const std::size_t alone = index.find_changes(askers.probe(first), part.stretches);
    part.stretches.resize(before);
    if (looked_at <= never_divided + times_one * alone) return count;
  }
}

void GroupJoin::add(const Inquiry& inquiry, std::size_t begin, std::size_t end, Part& part) const {
  const auto& [index, askers, judge] = inquiry;
  assert(begin <= end && end <= askers.size());
  const Candidates candidates = index.candidates(), asking = askers.candidates();
  for (std::size_t first = begin, count = 0; first < end; first += count) {
    count = gather(inquiry, first, end, part);
    const std::size_t stride = part.looked_at;
    part.candidate_count += stride * count;
    part.suspects.resize(2 * (stride / 8 + 1));
    part.lanes.resize(stride * count);
    std::array<std::uint32_t, scan_width> counts{};
    unsigned finders = scan_(candidates, part.stretches.span(), {asking, first, count}, judge,
                             {part.suspects.data(), part.lanes.data(), stride, counts.data()});
    for (; finders != 0; finders &= finders - 1) {
      const auto lane = static_cast<std::size_t>(std::countr_zero(finders));
      const std::size_t size = counts[lane], found = part.found.size();
      assert(lane < count && 0 < size && size <= stride);
      const std::span<std::uint32_t> own{part.lanes.data() + lane * stride, size};
      sort_short(own, part.spare);
      part.found.resize(found + size);
      std::copy(own.begin(), own.end(), part.found.data() + found);
      part.runs.push_back({asking.ids[first + lane], counts[lane]});
    }
  }
}

void GroupJoin::add_changes(const BoxIndex& index, const BoxIndex& askers, const TieJudge& judge) {
  const std::size_t count = askers.size(),
                    middle = worker_ != nullptr ? count / 2 / scan_width * scan_width : count;
  const Inquiry inquiry{index, askers, judge};
  run_both(
      worker_, [&] { add(inquiry, 0, middle, own_); },
      [&] { add(inquiry, middle, count, other_); });
}

}  // namespace rink::im
