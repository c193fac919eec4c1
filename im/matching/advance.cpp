// Eight boxes at a time with AVX2, four with SSE2, which every x86-64 processor has, or one: maxima
// do not depend on the order.
#include "im/matching/advance.h"

#include <cmath>

#if defined(__x86_64__)
#include <immintrin.h>
#endif

namespace rink::im {
namespace {

/// How many motions ahead memory is asked for.
constexpr std::size_t motions_ahead = 32;

inline void take(float& greatest, float value) { greatest = std::max(greatest, value); }

void advance_one(const Advancing& boxes, std::size_t i, bool asks_exact, Advanced& all) {
  const Region& region = boxes.regions[boxes.ids[i]].now;
  const FloatBox now = boxes.projection(region),
                 before{boxes.before.low_x[i], boxes.before.low_y[i], boxes.before.high_x[i],
                        boxes.before.high_y[i]},
                 hull = hull_of(before, now);
  if (asks_exact && all.is_exact) all.is_exact = boxes.projection.is_exact(region, now);
  take(all.widest_x, hull.high_x - hull.low_x), take(all.widest_y, hull.high_y - hull.low_y);
  take(all.shift_x, std::abs(now.low_x - before.low_x)),
      take(all.shift_y, std::abs(now.low_y - before.low_y));
  take(all.begun_x, before.low_x - boxes.now.low_x[i]),
      take(all.begun_y, before.low_y - boxes.now.low_y[i]);
  boxes.now.low_x[i] = now.low_x, boxes.now.low_y[i] = now.low_y, boxes.now.high_x[i] = now.high_x,
  boxes.now.high_y[i] = now.high_y;
}

inline void ask_ahead(const Advancing& boxes, std::size_t i, std::size_t end, std::size_t width) {
  if (i + motions_ahead + width > end) return;
  for (std::size_t k = 0; k < width; ++k) boxes.regions.prefetch(boxes.ids[i + motions_ahead + k]);
}

Advanced advance_scalar(const Advancing& boxes, std::size_t first, std::size_t end,
                        bool asks_exact) {
  Advanced all;
  for (std::size_t i = first; i < end; ++i) {
    ask_ahead(boxes, i, end, 1);
    advance_one(boxes, i, asks_exact, all);
  }
  return all;
}

#if defined(__x86_64__)

float greatest(__m128 values) {
  values = _mm_max_ps(values, _mm_movehl_ps(values, values));
  return _mm_cvtss_f32(_mm_max_ss(values, _mm_shuffle_ps(values, values, 1)));
}

Advanced advance_sse2(const Advancing& boxes, std::size_t first, std::size_t end, bool asks_exact) {
  const __m128 positive = _mm_castsi128_ps(_mm_set1_epi32(0x7FFFFFFF));
  __m128 widest_x = _mm_setzero_ps(), widest_y = widest_x, shift_x = widest_x, shift_y = widest_x,
         begun_x = widest_x, begun_y = widest_x;
  const Projection projection = boxes.projection;
  Advanced all;
  std::size_t i = first;
  for (; i + 4 <= end; i += 4) {
    ask_ahead(boxes, i, end, 4);
    __m128 box[4];
    for (std::size_t k = 0; k < 4; ++k) {
      const Region& region = boxes.regions[boxes.ids[i + k]].now;
      const FloatBox now = projection(region);
      if (asks_exact && all.is_exact) all.is_exact = projection.is_exact(region, now);
      box[k] = std::bit_cast<__m128>(now);
    }
    _MM_TRANSPOSE4_PS(box[0], box[1], box[2], box[3]);
    const __m128 low_x = _mm_loadu_ps(boxes.before.low_x + i),
                 low_y = _mm_loadu_ps(boxes.before.low_y + i);
    const __m128 high_x = _mm_loadu_ps(boxes.before.high_x + i),
                 high_y = _mm_loadu_ps(boxes.before.high_y + i);
    widest_x =
        _mm_max_ps(widest_x, _mm_sub_ps(_mm_max_ps(high_x, box[2]), _mm_min_ps(low_x, box[0])));
    widest_y =
        _mm_max_ps(widest_y, _mm_sub_ps(_mm_max_ps(high_y, box[3]), _mm_min_ps(low_y, box[1])));
    shift_x = _mm_max_ps(shift_x, _mm_and_ps(_mm_sub_ps(box[0], low_x), positive)),
    shift_y = _mm_max_ps(shift_y, _mm_and_ps(_mm_sub_ps(box[1], low_y), positive));
    begun_x = _mm_max_ps(begun_x, _mm_sub_ps(low_x, _mm_loadu_ps(boxes.now.low_x + i))),
    begun_y = _mm_max_ps(begun_y, _mm_sub_ps(low_y, _mm_loadu_ps(boxes.now.low_y + i)));
    _mm_storeu_ps(boxes.now.low_x + i, box[0]), _mm_storeu_ps(boxes.now.low_y + i, box[1]);
    _mm_storeu_ps(boxes.now.high_x + i, box[2]), _mm_storeu_ps(boxes.now.high_y + i, box[3]);
  }
  all.widest_x = greatest(widest_x), all.widest_y = greatest(widest_y),
  all.shift_x = greatest(shift_x), all.shift_y = greatest(shift_y);
  all.begun_x = greatest(begun_x), all.begun_y = greatest(begun_y);
  for (; i < end; ++i) advance_one(boxes, i, asks_exact, all);
  return all;
}

#define RINK_AVX2 __attribute__((target("avx2")))

RINK_AVX2 float greatest(__m256 values) {
  return greatest(_mm_max_ps(_mm256_castps256_ps128(values), _mm256_extractf128_ps(values, 1)));
}

RINK_AVX2 Advanced advance_avx2(const Advancing& boxes, std::size_t first, std::size_t end,
                                bool asks_exact) {
  const __m256 positive = _mm256_castsi256_ps(_mm256_set1_epi32(0x7FFFFFFF));
  const __m256d origin = _mm256_setr_pd(boxes.projection.origin_x(), boxes.projection.origin_y(),
                                        boxes.projection.origin_x(), boxes.projection.origin_y());
  const __m256d bound = _mm256_set1_pd(float_max), bound_below = _mm256_set1_pd(-float_max);
  __m256 widest_x = _mm256_setzero_ps(), widest_y = widest_x, shift_x = widest_x,
         shift_y = widest_x, begun_x = widest_x, begun_y = widest_x;
  Advanced all;
  std::size_t i = first;
  for (; i + 8 <= end; i += 8) {
    ask_ahead(boxes, i, end, 8);
    // As projection.h does it, four coordinates at a time.
    __m128 box[8];
    for (std::size_t k = 0; k < 8; ++k) {
      const Region& region = boxes.regions[boxes.ids[i + k]].now;
      const __m256d offset = _mm256_sub_pd(_mm256_loadu_pd(&region.low_x), origin);
      box[k] = _mm_add_ps(_mm256_cvtpd_ps(_mm256_min_pd(_mm256_max_pd(offset, bound_below), bound)),
                          _mm_setzero_ps());
      if (asks_exact && all.is_exact)
        all.is_exact = boxes.projection.is_exact(region, std::bit_cast<FloatBox>(box[k]));
    }
    const auto both = [&](std::size_t k) RINK_AVX2 {
      return _mm256_insertf128_ps(_mm256_castps128_ps256(box[k]), box[k + 4], 1);
    };
    const __m256 a = both(0), b = both(1), c = both(2), d = both(3);
    const __m256 lows_ab = _mm256_unpacklo_ps(a, b), highs_ab = _mm256_unpackhi_ps(a, b),
                 lows_cd = _mm256_unpacklo_ps(c, d), highs_cd = _mm256_unpackhi_ps(c, d);
    const __m256 now_low_x = _mm256_shuffle_ps(lows_ab, lows_cd, 0x44),
                 now_low_y = _mm256_shuffle_ps(lows_ab, lows_cd, 0xEE);
    const __m256 now_high_x = _mm256_shuffle_ps(highs_ab, highs_cd, 0x44),
                 now_high_y = _mm256_shuffle_ps(highs_ab, highs_cd, 0xEE);
    const __m256 low_x = _mm256_loadu_ps(boxes.before.low_x + i),
                 low_y = _mm256_loadu_ps(boxes.before.low_y + i);
    const __m256 high_x = _mm256_loadu_ps(boxes.before.high_x + i),
                 high_y = _mm256_loadu_ps(boxes.before.high_y + i);
    widest_x = _mm256_max_ps(widest_x, _mm256_sub_ps(_mm256_max_ps(high_x, now_high_x),
                                                     _mm256_min_ps(low_x, now_low_x)));
    widest_y = _mm256_max_ps(widest_y, _mm256_sub_ps(_mm256_max_ps(high_y, now_high_y),
                                                     _mm256_min_ps(low_y, now_low_y)));
    shift_x = _mm256_max_ps(shift_x, _mm256_and_ps(_mm256_sub_ps(now_low_x, low_x), positive)),
    shift_y = _mm256_max_ps(shift_y, _mm256_and_ps(_mm256_sub_ps(now_low_y, low_y), positive));
    begun_x = _mm256_max_ps(begun_x, _mm256_sub_ps(low_x, _mm256_loadu_ps(boxes.now.low_x + i))),
    begun_y = _mm256_max_ps(begun_y, _mm256_sub_ps(low_y, _mm256_loadu_ps(boxes.now.low_y + i)));
    _mm256_storeu_ps(boxes.now.low_x + i, now_low_x),
        _mm256_storeu_ps(boxes.now.low_y + i, now_low_y);
    _mm256_storeu_ps(boxes.now.high_x + i, now_high_x),
        _mm256_storeu_ps(boxes.now.high_y + i, now_high_y);
  }
  all.widest_x = greatest(widest_x), all.widest_y = greatest(widest_y),
  all.shift_x = greatest(shift_x), all.shift_y = greatest(shift_y);
  all.begun_x = greatest(begun_x), all.begun_y = greatest(begun_y);
  for (; i < end; ++i) advance_one(boxes, i, asks_exact, all);
  return all;
}

#endif

}  // namespace

Advance advance(Instructions instructions) {
#if defined(__x86_64__)
  static const bool has_avx2 = __builtin_cpu_supports("avx2");
  if (instructions == Instructions::sse2) return advance_sse2;
  if (instructions == Instructions::best) return has_avx2 ? advance_avx2 : advance_sse2;
#endif
  static_cast<void>(instructions);
  return advance_scalar;
}

}  // namespace rink::im
