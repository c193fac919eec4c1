// Compares one who asks with the eight boxes of a line at a stroke.
#pragma once

#include <cstdint>

#include "im/matching/line.h"

#ifdef __SSE2__
#include <emmintrin.h>
#endif

namespace rink::im {

/// What came of it, a bit for each lane. Where `tied`, the others say nothing.
struct LineOutcome {
  unsigned changed, entered, tied;
};

/// `asking` holds the edges now and, above them, those before.
inline LineOutcome compare_one_by_one(const Line& line, std::uint64_t asking) {
  LineOutcome outcome{0, 0, 0};
  for (unsigned lane = 0; lane < Line::lanes; ++lane) {
    bool is_in[2] = {true, true}, is_tied[2] = {false, false};
    for (unsigned i = 0; i < 8; ++i) {
      const auto edge = static_cast<std::uint8_t>(asking >> 8 * i);
      is_in[i / 4] &= edge >= line.edges[i % 4][lane];
      is_tied[i / 4] |= edge == line.edges[i % 4][lane];
    }
    outcome.changed |= static_cast<unsigned>(is_in[0] != is_in[1]) << lane;
    outcome.entered |= static_cast<unsigned>(is_in[0]) << lane;
    outcome.tied |= static_cast<unsigned>((is_in[0] && is_tied[0]) || (is_in[1] && is_tied[1])) << lane;
  }
  return outcome;
}

#ifdef __SSE2__
inline LineOutcome compare_by_sse2(const Line& line, std::uint64_t asking) {
  const __m128i bytes = _mm_loadl_epi64(reinterpret_cast<const __m128i*>(&asking)), pairs = _mm_unpacklo_epi8(bytes, bytes);
  const __m128i now = _mm_unpacklo_epi16(pairs, pairs), then = _mm_unpackhi_epi16(pairs, pairs);
  const __m128i low = _mm_load_si128(reinterpret_cast<const __m128i*>(line.edges[0])), high = _mm_load_si128(reinterpret_cast<const __m128i*>(line.edges[2]));
  const __m128i now_low = _mm_shuffle_epi32(now, 0x50), now_high = _mm_shuffle_epi32(now, 0xFA), then_low = _mm_shuffle_epi32(then, 0x50), then_high = _mm_shuffle_epi32(then, 0xFA);
  const auto reaches = [](__m128i edge, __m128i held) { return _mm_cmpeq_epi8(_mm_max_epu8(edge, held), edge); };
  const __m128i is_now = _mm_and_si128(reaches(now_low, low), reaches(now_high, high)), was = _mm_and_si128(reaches(then_low, low), reaches(then_high, high));
  const __m128i ties_now = _mm_or_si128(_mm_cmpeq_epi8(now_low, low), _mm_cmpeq_epi8(now_high, high));
  const __m128i tied_then = _mm_or_si128(_mm_cmpeq_epi8(then_low, low), _mm_cmpeq_epi8(then_high, high));
  // The eight lanes now and, above them, before.
  const __m128i in = _mm_and_si128(_mm_unpacklo_epi64(is_now, was), _mm_unpackhi_epi64(is_now, was));
  const __m128i ties = _mm_and_si128(in, _mm_or_si128(_mm_unpacklo_epi64(ties_now, tied_then), _mm_unpackhi_epi64(ties_now, tied_then)));
  const auto in_mask = static_cast<unsigned>(_mm_movemask_epi8(in)), tie_mask = static_cast<unsigned>(_mm_movemask_epi8(ties));
  return {(in_mask ^ in_mask >> 8) & 0xFFu, in_mask & 0xFFu, (tie_mask | tie_mask >> 8) & 0xFFu};
}
#else
inline LineOutcome compare_by_sse2(const Line& line, std::uint64_t asking) { return compare_one_by_one(line, asking); }
#endif

}  // namespace rink::im
