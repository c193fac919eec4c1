// Compares one query with the eight boxes of a line at once.
#pragma once

#include <cstdint>

#include "im/matching/index/line.h"

#ifdef __SSE2__
#include <emmintrin.h>
#endif

namespace rink::im {

/// The result, a bit for each lane. Where `tied`, the others mean nothing.
struct LineHits {
  unsigned changed, entered, tied;
};

/// Compares one after the other. `asking` holds the asker's edges now and, above them, those
/// before.
class OneByOne {
 public:
  explicit OneByOne(std::uint64_t asking) : asking_(asking) {}

  LineHits operator()(const Line& line) const {
    LineHits outcome{0, 0, 0};
    for (unsigned lane = 0; lane < Line::lanes; ++lane) {
      bool is_in[2] = {true, true}, is_tied[2] = {false, false};
      for (unsigned i = 0; i < 8; ++i) {
        const auto edge = static_cast<std::uint8_t>(asking_ >> 8 * i);
        is_in[i / 4] &= edge >= line.edges[i % 4][lane];
        is_tied[i / 4] |= edge == line.edges[i % 4][lane];
      }
      outcome.changed |= static_cast<unsigned>(is_in[0] != is_in[1]) << lane;
      outcome.entered |= static_cast<unsigned>(is_in[0]) << lane;
      outcome.tied |= static_cast<unsigned>((is_in[0] && is_tied[0]) || (is_in[1] && is_tied[1]))
                      << lane;
    }
    return outcome;
  }

 private:
  std::uint64_t asking_;
};

#ifdef __SSE2__
/// Compares all at once by SSE2.
class BySse2 {
 public:
  explicit BySse2(std::uint64_t asking) {
    const __m128i bytes = _mm_set_epi64x(0, static_cast<long long>(asking)),
                  pairs = _mm_unpacklo_epi8(bytes, bytes);
    const __m128i now = _mm_unpacklo_epi16(pairs, pairs), then = _mm_unpackhi_epi16(pairs, pairs);
    now_low_ = _mm_shuffle_epi32(now, 0x50), now_high_ = _mm_shuffle_epi32(now, 0xFA),
    then_low_ = _mm_shuffle_epi32(then, 0x50), then_high_ = _mm_shuffle_epi32(then, 0xFA);
  }

  LineHits operator()(const Line& line) const {
    const __m128i low = _mm_load_si128(reinterpret_cast<const __m128i*>(line.edges[0])),
                  high = _mm_load_si128(reinterpret_cast<const __m128i*>(line.edges[2]));
    const auto reaches = [](__m128i edge, __m128i held) {
      return _mm_cmpeq_epi8(_mm_max_epu8(edge, held), edge);
    };
    const __m128i is_now = _mm_and_si128(reaches(now_low_, low), reaches(now_high_, high)),
                  was = _mm_and_si128(reaches(then_low_, low), reaches(then_high_, high));
    const __m128i ties_now =
        _mm_or_si128(_mm_cmpeq_epi8(now_low_, low), _mm_cmpeq_epi8(now_high_, high));
    const __m128i tied_then =
        _mm_or_si128(_mm_cmpeq_epi8(then_low_, low), _mm_cmpeq_epi8(then_high_, high));
    // The eight lanes now and, above them, before.
    const __m128i in =
        _mm_and_si128(_mm_unpacklo_epi64(is_now, was), _mm_unpackhi_epi64(is_now, was));
    const __m128i ties = _mm_and_si128(in, _mm_or_si128(_mm_unpacklo_epi64(ties_now, tied_then),
                                                        _mm_unpackhi_epi64(ties_now, tied_then)));
    const auto in_mask = static_cast<unsigned>(_mm_movemask_epi8(in)),
               tie_mask = static_cast<unsigned>(_mm_movemask_epi8(ties));
    return {(in_mask ^ in_mask >> 8) & 0xFFu, in_mask & 0xFFu, (tie_mask | tie_mask >> 8) & 0xFFu};
  }

 private:
  __m128i now_low_, now_high_, then_low_, then_high_;
};
#else
using BySse2 = OneByOne;
#endif

}  // namespace rink::im
