// Scans eight candidates at a time with AVX2 and packs the matches to the left; each function says
// so itself, the rest of the build stays at the baseline.
#include "im/matching/disc_error.h"
#include "im/matching/index/scan.h"

#if defined(__x86_64__)
#include <immintrin.h>

#include <array>

#define RINK_AVX2 __attribute__((target("avx2,popcnt")))

namespace rink::im {
namespace {

/// For each set of eight lanes, the numbers of those that are in it, first of all.
constexpr std::array<std::uint64_t, 256> packings = [] {
  std::array<std::uint64_t, 256> table{};
  for (unsigned lanes = 0; lanes < 256; ++lanes) {
    unsigned place = 0;
    for (std::uint64_t lane = 0; lane < 8; ++lane)
      if (lanes >> lane & 1u) table[lanes] |= lane << 8 * place++;
  }
  return table;
}();

struct WideBox {
  __m256 low_x, low_y, high_x, high_y;
};

RINK_AVX2 inline WideBox widen(const FloatBox& box) {
  return {_mm256_set1_ps(box.low_x), _mm256_set1_ps(box.low_y), _mm256_set1_ps(box.high_x),
          _mm256_set1_ps(box.high_y)};
}

/// The smallest of the four differences that must not be negative in an overlap.
RINK_AVX2 inline __m256 clearance(const BoxColumns& boxes, std::size_t i, const WideBox& probe) {
  const __m256 x = _mm256_min_ps(_mm256_sub_ps(probe.high_x, _mm256_loadu_ps(boxes.low_x + i)),
                                 _mm256_sub_ps(_mm256_loadu_ps(boxes.high_x + i), probe.low_x));
  const __m256 y = _mm256_min_ps(_mm256_sub_ps(probe.high_y, _mm256_loadu_ps(boxes.low_y + i)),
                                 _mm256_sub_ps(_mm256_loadu_ps(boxes.high_y + i), probe.low_y));
  return _mm256_min_ps(x, y);
}

RINK_AVX2 inline unsigned ties(__m256 clearances) {
  return static_cast<unsigned>(
      _mm256_movemask_ps(_mm256_cmp_ps(clearances, _mm256_setzero_ps(), _CMP_EQ_OQ)));
}

/// The lanes that count in a stretch with `rest` candidates left.
inline unsigned lanes(std::size_t rest) { return (1u << std::min<std::size_t>(rest, 8)) - 1u; }

/// Asks the judge about each of `doubtful`; corrects hits and the bits of those who entered.
[[gnu::noinline]] unsigned decide(unsigned hits, unsigned doubtful, const TieJudge& judge,
                                  std::uint32_t probe, std::uint32_t* ids) {
  for (; doubtful != 0; doubtful &= doubtful - 1u) {
    const unsigned lane = static_cast<unsigned>(__builtin_ctz(doubtful));
    ids[lane] &= ~entered_bit;
    const Verdict verdict = judge(probe, ids[lane]);
    hits = (hits & ~(1u << lane)) | static_cast<unsigned>(verdict != Verdict::no) << lane;
    if (verdict == Verdict::entered) ids[lane] |= entered_bit;
  }
  return hits;
}

RINK_AVX2 inline __m256i load(const std::uint32_t* ids) {
  return _mm256_loadu_si256(reinterpret_cast<const __m256i*>(ids));
}

/// The same for ids in a register.
RINK_AVX2 inline unsigned decide(unsigned hits, unsigned doubtful, const TieJudge& judge,
                                 std::uint32_t probe, __m256i& ids) {
  alignas(32) std::uint32_t lanes[8];
  _mm256_store_si256(reinterpret_cast<__m256i*>(lanes), ids);
  hits = decide(hits, doubtful, judge, probe, lanes);
  ids = load(lanes);
  return hits;
}

/// Writes the ids of `hits`, and rubbish behind them.
RINK_AVX2 inline std::size_t pack(unsigned hits, __m256i ids, std::uint32_t* found) {
  const __m256i order =
      _mm256_cvtepu8_epi32(_mm_loadl_epi64(reinterpret_cast<const __m128i*>(&packings[hits])));
  _mm256_storeu_si256(reinterpret_cast<__m256i*>(found), _mm256_permutevar8x32_epi32(ids, order));
  return static_cast<std::size_t>(__builtin_popcount(hits));
}

RINK_AVX2 std::size_t scan_overlaps(const Candidates& candidates, const ProbeBlock& block,
                                    const TieJudge& judge, const ScanOutput& output) {
  const auto [probes, stretches] = block;
  const auto [found, ends] = output;
  std::size_t count = 0, stretch = 0;
  for (std::size_t p = 0; p < probes.size(); ++p) {
    const WideBox now = widen(probes[p].now);
    for (const std::size_t end = probes[p].stretches_end; stretch < end; ++stretch)
      for (std::size_t i = stretches[stretch].first; i < stretches[stretch].end;
           i += candidates.stride) {
        const __m256 clearances = clearance(candidates.now, i, now);
        const unsigned valid = lanes(stretches[stretch].end - i);
        unsigned hits = ~static_cast<unsigned>(_mm256_movemask_ps(clearances)) & valid;
        __m256i ids = load(candidates.ids + i);
        if (judge.is_needed)
          if (const unsigned doubtful = ties(clearances) & valid)
            hits = decide(hits, doubtful, judge, probes[p].id, ids);
        count += pack(hits, ids, found + count);
      }
    ends[p] = static_cast<std::uint32_t>(count);
  }
  return count;
}

RINK_AVX2 std::size_t scan_changes(const Candidates& candidates, const ProbeBlock& block,
                                   const TieJudge& judge, const ScanOutput& output) {
  const auto [probes, stretches] = block;
  const auto [found, ends] = output;
  std::size_t count = 0, stretch = 0;
  const __m256 zero = _mm256_setzero_ps();
  for (std::size_t p = 0; p < probes.size(); ++p) {
    const WideBox before = widen(probes[p].before), now = widen(probes[p].now);
    for (const std::size_t end = probes[p].stretches_end; stretch < end; ++stretch)
      for (std::size_t i = stretches[stretch].first; i < stretches[stretch].end;
           i += candidates.stride) {
        // Reading `before` only of boxes whose clearance now is within what may have moved saves
        // half of the loads and takes longer: no processor foresees which.
        const __m256 then = clearance(candidates.before, i, before),
                     today = clearance(candidates.now, i, now);
        const unsigned valid = lanes(stretches[stretch].end - i);
        // Nearly always nothing has changed and nothing ties, which one mask says.
        const __m256 changed = _mm256_xor_ps(then, today),
                     tied = _mm256_or_ps(_mm256_cmp_ps(then, zero, _CMP_EQ_OQ),
                                         _mm256_cmp_ps(today, zero, _CMP_EQ_OQ));
        if ((static_cast<unsigned>(_mm256_movemask_ps(_mm256_or_ps(changed, tied))) & valid) == 0)
          continue;
        unsigned hits = static_cast<unsigned>(_mm256_movemask_ps(changed)) & valid;
        const unsigned doubtful =
            judge.is_needed ? static_cast<unsigned>(_mm256_movemask_ps(tied)) & valid : 0;
        const __m256i entered = _mm256_andnot_si256(
            _mm256_castps_si256(today), _mm256_set1_epi32(static_cast<int>(entered_bit)));
        __m256i ids = _mm256_or_si256(load(candidates.ids + i), entered);
        if (doubtful != 0) hits = decide(hits, doubtful, judge, probes[p].id, ids);
        count += pack(hits, ids, found + count);
      }
    ends[p] = static_cast<std::uint32_t>(count);
  }
  return count;
}

RINK_AVX2 inline WideBox load(const BoxColumns& boxes, std::size_t i) {
  return {_mm256_loadu_ps(boxes.low_x + i), _mm256_loadu_ps(boxes.low_y + i),
          _mm256_loadu_ps(boxes.high_x + i), _mm256_loadu_ps(boxes.high_y + i)};
}

/// One box against an asker in each lane.
RINK_AVX2 inline __m256 clearance(const WideBox& askers, const BoxColumns& boxes, std::size_t i) {
  const __m256 x =
      _mm256_min_ps(_mm256_sub_ps(askers.high_x, _mm256_broadcast_ss(boxes.low_x + i)),
                    _mm256_sub_ps(_mm256_broadcast_ss(boxes.high_x + i), askers.low_x));
  const __m256 y =
      _mm256_min_ps(_mm256_sub_ps(askers.high_y, _mm256_broadcast_ss(boxes.low_y + i)),
                    _mm256_sub_ps(_mm256_broadcast_ss(boxes.high_y + i), askers.low_y));
  return _mm256_min_ps(x, y);
}

/// Eight askers, and the boxes that they look at.
struct Meeting {
  WideBox before, now;
  BoxColumns boxes_before, boxes_now;
};

/// Marks of boxes, a byte for each and in it a bit for each asker.
struct Marks {
  std::uint8_t *suspects, *apart;
};

/// Marks those whose overlap may have changed, and those that do not overlap now. Returns whether
/// any tie, which only then are suspects if they have not changed. There is no branch on what is
/// seen.
RINK_AVX2 inline bool mark(const Meeting& meeting, const Stretch& stretch, const Marks& marks) {
  const auto [before, now, boxes_before, boxes_now] = meeting;
  const auto [suspects, apart] = marks;
  __m256i least = _mm256_set1_epi32(-1);
  for (std::size_t i = stretch.first, k = 0; i < stretch.end; ++i, ++k) {
    const __m256 then = clearance(before, boxes_before, i), today = clearance(now, boxes_now, i);
    // Zero is the least of numbers without sign.
    least = _mm256_min_epu32(
        least, _mm256_min_epu32(_mm256_castps_si256(then), _mm256_castps_si256(today)));
    suspects[k] = static_cast<std::uint8_t>(_mm256_movemask_ps(_mm256_xor_ps(then, today)));
    apart[k] = static_cast<std::uint8_t>(_mm256_movemask_ps(today));
  }
  return _mm256_movemask_epi8(_mm256_cmpeq_epi32(least, _mm256_setzero_si256())) != 0;
}

/// Adds those that tie to the suspects.
[[gnu::noinline]] RINK_AVX2 void mark_ties(const Meeting& meeting, const Stretch& stretch,
                                           std::uint8_t* suspects) {
  for (std::size_t i = stretch.first, k = 0; i < stretch.end; ++i, ++k)
    suspects[k] = static_cast<std::uint8_t>(
        suspects[k] | ties(clearance(meeting.before, meeting.boxes_before, i)) |
        ties(clearance(meeting.now, meeting.boxes_now, i)));
}

/// True if one of the four differences of box `i` of `some` and box `k` of `others` is zero, and
/// none is negative.
bool is_tie(const BoxColumns& some, std::size_t i, const BoxColumns& others, std::size_t k) {
  return std::min(std::min(some.high_x[i] - others.low_x[k], others.high_x[k] - some.low_x[i]),
                  std::min(some.high_y[i] - others.low_y[k], others.high_y[k] - some.low_y[i])) ==
         0.0f;
}

RINK_AVX2 unsigned scan_group(const Candidates& candidates, std::span<const Stretch> stretches,
                              const AskerGroup& group, const TieJudge& judge,
                              const GroupOutput& output) {
  const auto& [askers, first, asker_count] = group;
  const Meeting meeting{load(askers.before, first), load(askers.now, first), candidates.before,
                        candidates.now};
  unsigned finders = 0;
  const std::uint64_t valid = 0x0101010101010101u * lanes(asker_count);
  for (const Stretch& stretch : stretches) {
    const std::size_t words = (stretch.end - stretch.first + 7) / 8;
    std::uint64_t* const suspects = output.work;
    std::uint64_t* const apart = output.work + words;
    suspects[words - 1] = 0;
    const Marks marks{reinterpret_cast<std::uint8_t*>(suspects),
                      reinterpret_cast<std::uint8_t*>(apart)};
    const bool has_ties = mark(meeting, stretch, marks) && judge.is_needed;
    if (has_ties) mark_ties(meeting, stretch, marks.suspects);
    for (std::size_t w = 0; w < words; ++w)
      for (std::uint64_t rest = suspects[w] & valid; rest != 0; rest &= rest - 1) {
        const auto bit = static_cast<unsigned>(__builtin_ctzll(rest));
        const std::size_t i = stretch.first + 8 * w + bit / 8, lane = bit % 8, asker = first + lane;
        bool is_entered = (apart[w] >> bit & 1u) == 0;
        if (has_ties && (is_tie(askers.before, asker, candidates.before, i) ||
                         is_tie(askers.now, asker, candidates.now, i))) {
          const Verdict verdict = judge(askers.ids[asker], candidates.ids[i]);
          if (verdict == Verdict::no) continue;
          is_entered = verdict == Verdict::entered;
        }
        output.found[lane * output.stride + output.counts[lane]++] =
            found_change(candidates.ids[i], is_entered);
        finders |= 1u << lane;
      }
  }
  return finders;
}

/// In which lanes the box touches the disc, and in which that is in doubt; the sign bits count.
struct Nearness {
  __m256 inside, doubtful;
};

RINK_AVX2 inline __m256 magnitude(__m256 number) {
  return _mm256_andnot_ps(_mm256_set1_ps(-0.0f), number);
}

RINK_AVX2 inline __m256 offset(__m256 middle, __m256 low, __m256 high) {
  const __m256 beyond = _mm256_max_ps(_mm256_sub_ps(_mm256_add_ps(low, low), middle),
                                      _mm256_sub_ps(middle, _mm256_add_ps(high, high)));
  return _mm256_min_ps(_mm256_max_ps(beyond, _mm256_setzero_ps()), _mm256_set1_ps(disc_offset_max));
}

/// As in scan_scalar.cpp. What depends on the asker alone the compiler takes out of the loop.
RINK_AVX2 inline Nearness nearness(const WideBox& disc, const WideBox& box) {
  const __m256 middle_x = _mm256_add_ps(disc.low_x, disc.high_x),
               middle_y = _mm256_add_ps(disc.low_y, disc.high_y);
  const __m256 width = _mm256_sub_ps(disc.high_x, disc.low_x),
               height = _mm256_sub_ps(disc.high_y, disc.low_y),
               diameter = _mm256_min_ps(width, height);
  const __m256 size = _mm256_add_ps(_mm256_add_ps(width, height),
                                    _mm256_add_ps(magnitude(middle_x), magnitude(middle_y)));
  const __m256 x = offset(middle_x, box.low_x, box.high_x),
               y = offset(middle_y, box.low_y, box.high_y), away = _mm256_add_ps(x, y),
               all = _mm256_add_ps(away, size);
  const __m256 excess = _mm256_sub_ps(_mm256_add_ps(_mm256_mul_ps(x, x), _mm256_mul_ps(y, y)),
                                      _mm256_mul_ps(diameter, diameter));
  const __m256 near =
      _mm256_mul_ps(_mm256_add_ps(away, diameter), _mm256_set1_ps(disc_error_first));
  const __m256 error = _mm256_add_ps(
      _mm256_mul_ps(_mm256_add_ps(near, _mm256_mul_ps(all, _mm256_set1_ps(disc_error_second))),
                    all),
      _mm256_set1_ps(disc_error_least));
  const __m256 is_clear =
      _mm256_and_ps(_mm256_cmp_ps(magnitude(excess), error, _CMP_GT_OQ),
                    _mm256_cmp_ps(size, _mm256_set1_ps(disc_size_max), _CMP_LT_OQ));
  const __m256 is_somewhere = _mm256_and_ps(_mm256_cmp_ps(disc.low_x, disc.high_x, _CMP_LE_OQ),
                                            _mm256_cmp_ps(box.low_x, box.high_x, _CMP_LE_OQ));
  return {_mm256_and_ps(is_somewhere, _mm256_cmp_ps(excess, _mm256_setzero_ps(), _CMP_LT_OQ)),
          _mm256_andnot_ps(is_clear, is_somewhere)};
}

template <bool is_of_askers>
RINK_AVX2 std::size_t scan_discs(const Candidates& candidates, const ProbeBlock& block,
                                 const TieJudge& judge, const ScanOutput& output) {
  const auto [probes, stretches] = block;
  const auto [found, ends] = output;
  std::size_t count = 0, stretch = 0;
  for (std::size_t p = 0; p < probes.size(); ++p) {
    const WideBox before = widen(probes[p].before), now = widen(probes[p].now);
    for (const std::size_t end = probes[p].stretches_end; stretch < end; ++stretch)
      for (std::size_t i = stretches[stretch].first; i < stretches[stretch].end;
           i += candidates.stride) {
        const WideBox was = load(candidates.before, i), is = load(candidates.now, i);
        const Nearness then = is_of_askers ? nearness(before, was) : nearness(was, before),
                       today = is_of_askers ? nearness(now, is) : nearness(is, now);
        const unsigned valid = lanes(stretches[stretch].end - i);
        const __m256 changed = _mm256_xor_ps(then.inside, today.inside),
                     tied = _mm256_or_ps(then.doubtful, today.doubtful);
        if ((static_cast<unsigned>(_mm256_movemask_ps(_mm256_or_ps(changed, tied))) & valid) == 0)
          continue;
        unsigned hits = static_cast<unsigned>(_mm256_movemask_ps(changed)) & valid;
        const unsigned doubtful = static_cast<unsigned>(_mm256_movemask_ps(tied)) & valid;
        const __m256i entered = _mm256_and_si256(_mm256_castps_si256(today.inside),
                                                 _mm256_set1_epi32(static_cast<int>(entered_bit)));
        __m256i ids = _mm256_or_si256(load(candidates.ids + i), entered);
        if (doubtful != 0) hits = decide(hits, doubtful, judge, probes[p].id, ids);
        count += pack(hits, ids, found + count);
      }
    ends[p] = static_cast<std::uint32_t>(count);
  }
  return count;
}

constexpr Scans wide_scans{scan_overlaps,     scan_changes, scan_discs<true>,
                           scan_discs<false>, scan_group,   "avx2"};

}  // namespace

const Scans* const avx2_scans = &wide_scans;

}  // namespace rink::im

#else
namespace rink::im {
const Scans* const avx2_scans = nullptr;
}
#endif
