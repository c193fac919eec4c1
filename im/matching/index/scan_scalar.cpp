// Scans one candidate after the other, without branches on the outcome; and chooses between this
// and wider instructions.
#include <cassert>
#include <cmath>

#include "im/matching/disc_error.h"
#include "im/matching/index/scan.h"

namespace rink::im {
namespace {

inline FloatBox box_at(const BoxColumns& boxes, std::size_t i) {
  return {boxes.low_x[i], boxes.low_y[i], boxes.high_x[i], boxes.high_y[i]};
}

/// The smallest of the four differences that must not be negative in an overlap.
inline float clearance(const BoxColumns& boxes, std::size_t i, const FloatBox& probe) {
  const float x = std::min(probe.high_x - boxes.low_x[i], boxes.high_x[i] - probe.low_x),
              y = std::min(probe.high_y - boxes.low_y[i], boxes.high_y[i] - probe.low_y);
  return std::min(x, y);
}

/// What a pair comes to; `is_tie` if that is in doubt.
struct Hits {
  bool is_match, is_entered, is_tie;
};

template <class Compare>
std::size_t scan(const Candidates& candidates, const ProbeBlock& block, const TieJudge& judge,
                 const ScanOutput& output, const Compare& compare) {
  const auto [probes, stretches] = block;
  const auto [found, ends] = output;
  std::size_t count = 0, stretch = 0;
  for (std::size_t p = 0; p < probes.size(); ++p) {
    const Probe probe = probes[p];
    assert(stretch <= probe.stretches_end);
    for (; stretch < probe.stretches_end; ++stretch)
      for (std::size_t eight = stretches[stretch].first; eight < stretches[stretch].end;
           eight += candidates.stride)
        for (std::size_t i = eight;
             i < std::min<std::size_t>(eight + scan_width, stretches[stretch].end); ++i) {
          Hits outcome = compare(i, probe);
          if (judge.is_needed && outcome.is_tie) {
            const Verdict verdict = judge(probe.id, candidates.ids[i]);
            outcome = {verdict != Verdict::no, verdict == Verdict::entered, false};
          }
          found[count] = candidates.ids[i] | (outcome.is_entered ? entered_bit : 0u);
          count += outcome.is_match;
        }
    ends[p] = static_cast<std::uint32_t>(count);
  }
  return count;
}

std::size_t scan_overlaps(const Candidates& candidates, const ProbeBlock& block,
                          const TieJudge& judge, const ScanOutput& output) {
  return scan(candidates, block, judge, output, [&](std::size_t i, const Probe& probe) {
    const float now = clearance(candidates.now, i, probe.now);
    return Hits{now >= 0.0f, false, now == 0.0f};
  });
}

std::size_t scan_changes(const Candidates& candidates, const ProbeBlock& block,
                         const TieJudge& judge, const ScanOutput& output) {
  return scan(candidates, block, judge, output, [&](std::size_t i, const Probe& probe) {
    const float before = clearance(candidates.before, i, probe.before),
                now = clearance(candidates.now, i, probe.now);
    return Hits{(before >= 0.0f) != (now >= 0.0f), now >= 0.0f, before == 0.0f || now == 0.0f};
  });
}

unsigned scan_group(const Candidates& candidates, std::span<const Stretch> stretches,
                    const AskerGroup& group, const TieJudge& judge, const GroupOutput& output) {
  const auto& [askers, first, asker_count] = group;
  unsigned finders = 0;
  for (const Stretch& stretch : stretches)
    for (std::size_t i = stretch.first; i < stretch.end; ++i)
      for (std::size_t lane = 0; lane < asker_count; ++lane) {
        const std::size_t asker = first + lane;
        const float before = clearance(candidates.before, i, box_at(askers.before, asker)),
                    now = clearance(candidates.now, i, box_at(askers.now, asker));
        bool is_match = (before >= 0.0f) != (now >= 0.0f), is_entered = now >= 0.0f;
        if (judge.is_needed && (before == 0.0f || now == 0.0f)) {
          const Verdict verdict = judge(askers.ids[asker], candidates.ids[i]);
          is_match = verdict != Verdict::no, is_entered = verdict == Verdict::entered;
        }
        output.found[lane * output.stride + output.counts[lane]] =
            found_change(candidates.ids[i], is_entered);
        output.counts[lane] += is_match ? 1u : 0u;
        finders |= (is_match ? 1u : 0u) << lane;
      }
  return finders;
}

struct Nearness {
  bool is_inside, is_doubtful;
};

/// Of the disc that `disc` holds and the nearest point of `box` (disc_error.h).
inline Nearness nearness(const FloatBox& disc, const FloatBox& box) {
  const float middle_x = disc.low_x + disc.high_x, middle_y = disc.low_y + disc.high_y,
              width = disc.high_x - disc.low_x, height = disc.high_y - disc.low_y;
  const float size = width + height + std::abs(middle_x) + std::abs(middle_y),
              diameter = std::min(width, height);
  const auto offset = [](float middle, float low, float high) {
    return std::min(std::max(std::max(2.0f * low - middle, middle - 2.0f * high), 0.0f),
                    disc_offset_max);
  };
  const float x = offset(middle_x, box.low_x, box.high_x),
              y = offset(middle_y, box.low_y, box.high_y), away = x + y;
  const float excess = x * x + y * y - diameter * diameter, all = away + size,
              error = ((away + diameter) * disc_error_first + all * disc_error_second) * all +
                      disc_error_least;
  const bool is_somewhere = disc.low_x <= disc.high_x && box.low_x <= box.high_x;
  return {is_somewhere && excess < 0.0f,
          is_somewhere && !(std::abs(excess) > error && size < disc_size_max)};
}

template <bool is_of_askers>
std::size_t scan_discs(const Candidates& candidates, const ProbeBlock& block, const TieJudge& judge,
                       const ScanOutput& output) {
  return scan(candidates, block, judge, output, [&](std::size_t i, const Probe& probe) {
    const FloatBox was = box_at(candidates.before, i), is = box_at(candidates.now, i);
    const Nearness before =
                       is_of_askers ? nearness(probe.before, was) : nearness(was, probe.before),
                   now = is_of_askers ? nearness(probe.now, is) : nearness(is, probe.now);
    return Hits{before.is_inside != now.is_inside, now.is_inside,
                before.is_doubtful || now.is_doubtful};
  });
}

}  // namespace

const Scans scalar_scans{scan_overlaps,     scan_changes, scan_discs<true>,
                         scan_discs<false>, scan_group,   "scalar"};

const Scans& scans(Instructions instructions) {
  static const bool has_avx2 = [] {
#if defined(__x86_64__)
    return avx2_scans != nullptr && __builtin_cpu_supports("avx2") &&
           __builtin_cpu_supports("popcnt");
#else
    return false;
#endif
  }();
  return instructions == Instructions::best && has_avx2 ? *avx2_scans : scalar_scans;
}

}  // namespace rink::im
