// How many discs in straight flight are near a place at an instant, without asking who they are.
#pragma once

#include <cstdint>

#include "game/physics/flight/straight_flight.h"
#include "game/physics/real.h"

namespace rink::physics::inline RINK_PRECISION {

#if defined(RINK_PAIRS_SCALARS)

/// Around a place at an instant [m, s]: what has its rim within `least` [m] of it is near.
struct Neighbourhood {
  double x, y, time, least;
};

/// How many of `count` discs of `near` (ids in `discs`), all in straight flight without drag, have
/// their centres no farther from the place than their radius and `least`. Four at a time and
/// without a branch, as first_disc_contact_in_fours(), whose reading and room it shares: places
/// beyond the end are filled with `filler`, and counted.
template <class Disc>
[[gnu::target("avx2")]] std::uint32_t count_near_in_fours(const Disc* discs, std::uint32_t* near,
                                                          std::uint32_t count, std::uint32_t filler,
                                                          const Neighbourhood& around) {
  const auto [x, y, time, least] = around;
  near[count] = near[count + 1] = near[count + 2] = filler;
  const __m256d ax = _mm256_set1_pd(x), ay = _mm256_set1_pd(y), now = _mm256_set1_pd(time),
                reach_least = _mm256_set1_pd(least), zero = _mm256_setzero_pd();
  std::uint32_t found = 0;
  for (std::uint32_t k = 0; k < count; k += 4) {
    const Disc &b = discs[near[k]], &c = discs[near[k + 1]], &d = discs[near[k + 2]],
               &e = discs[near[k + 3]];
    __m256d bx, by, vx, vy, b_time, b_radius;
    read_fours({&b.x, &c.x, &d.x, &e.x}, bx, by);
    read_fours({&b.vx, &c.vx, &d.vx, &e.vx}, vx, vy);
    read_fours({&b.time, &c.time, &d.time, &e.time}, b_time, b_radius);
    const __m256d ahead = _mm256_max_pd(_mm256_sub_pd(now, b_time), zero),
                  reach = _mm256_add_pd(b_radius, reach_least);
    const __m256d dx = _mm256_sub_pd(_mm256_add_pd(bx, _mm256_mul_pd(vx, ahead)), ax),
                  dy = _mm256_sub_pd(_mm256_add_pd(by, _mm256_mul_pd(vy, ahead)), ay);
    const __m256d square = _mm256_add_pd(_mm256_mul_pd(dx, dx), _mm256_mul_pd(dy, dy));
    found += static_cast<std::uint32_t>(__builtin_popcount(static_cast<unsigned>(
        _mm256_movemask_pd(_mm256_cmp_pd(square, _mm256_mul_pd(reach, reach), _CMP_LE_OQ)))));
  }
  return found;
}

#endif

}  // namespace rink::physics::inline RINK_PRECISION
