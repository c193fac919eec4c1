// Looks the cells of a group up, and takes a smaller group where they are too many.
#include "im/matching/group_join.h"

#include <algorithm>
#include <cassert>

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

void GroupJoin::add(const Inquiry& inquiry, std::size_t begin, std::size_t end, Part& part) const {
  const auto& [index, askers, judge] = inquiry;
  assert(begin <= end && end <= askers.size());
  const Candidates candidates = index.candidates(), asking = askers.candidates();
  for (std::size_t first = begin; first < end;) {
    std::size_t count = std::min<std::size_t>(scan_width, end - first), looked_at;
    for (;; count /= 2) {
      part.stretches.clear();
      const GroupBoxes boxes = boxes_of(askers, first, count);
      looked_at = index.find_changes(boxes.hull, boxes.core, part.stretches);
      if (looked_at <= never_divided || count == 1) break;
      const std::size_t before = part.stretches.size();
      const std::size_t alone = index.find_changes(askers.probe(first), part.stretches);
      part.stretches.resize(before);
      if (looked_at <= never_divided + times_one * alone) break;
    }
    part.candidate_count += looked_at * count;
    const std::size_t found = part.found.size();
    part.found.reserve(found + looked_at * count);
    part.suspects.resize(2 * (looked_at / 8 + 1));
    const std::size_t found_now = scan_(candidates, part.stretches.span(), {asking, first, count},
                                        judge, {part.suspects.data(), part.found.data() + found});
    assert(found_now <= looked_at * count);
    part.found.resize(found + found_now);
    first += count;
  }
}

void GroupJoin::add_changes(const BoxIndex& index, const BoxIndex& askers, const TieJudge& judge) {
  const std::size_t count = askers.size(), middle = worker_ != nullptr ? count / 2 : count;
  const Inquiry inquiry{index, askers, judge};
  run_both(
      worker_, [&] { add(inquiry, 0, middle, own_); },
      [&] { add(inquiry, middle, count, other_); });
}

}  // namespace rink::im
