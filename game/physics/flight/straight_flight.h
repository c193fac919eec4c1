// Discs in straight flight without drag: who among many touches one of them, and when.
#pragma once

#include <algorithm>
#include <cassert>
#include <cstdint>
#include <limits>
#include <optional>

#include "game/physics/flight/time_to_touch.h"
#include "game/physics/real.h"

#if defined(RINK_PAIRS_SCALARS)
#include <immintrin.h>
#endif

namespace rink::physics::inline RINK_PRECISION {

/// A disc at its last event.
struct Flight {
  Real x, y, vx, vy;  ///< m, m/s
  Real time;          ///< of the event [s]
  Real radius;        ///< m

  /// Two numbers at a time where the machine can: first_disc_contact() reads them in twos, and what
  /// was written by ones would make that wait.
  void restart(Real new_x, Real new_y, Real new_vx, Real new_vy, Real new_time) {
#if defined(RINK_PAIRS_SCALARS)
    _mm_storeu_pd(&x, _mm_setr_pd(new_x, new_y));
    _mm_storeu_pd(&vx, _mm_setr_pd(new_vx, new_vy));
    _mm_storeu_pd(&time, _mm_setr_pd(new_time, radius));
#else
    x = new_x, y = new_y, vx = new_vx, vy = new_vy, time = new_time;
#endif
  }
};

/// Which disc a disc touches first and when, and when the second.
struct FirstContact {
  Real time = std::numeric_limits<Real>::infinity();
  std::uint32_t other = 0xffffffff;
  Real second_time = std::numeric_limits<Real>::infinity();
  std::uint32_t touching =
      0;  ///< where it is asked for: how many touch it when the question begins, itself included
};

/// When the two first touch, both taken at the later of their two events; nothing if they never do,
/// or only after `latest`, unless they touch at that event already.
inline std::optional<Real> disc_contact_time(const Flight& a, const Flight& b, Real latest) {
  const Real time = std::max(a.time, b.time), ahead_a = time - a.time, ahead_b = time - b.time;
  const RealVector offset(b.x - a.x + (b.vx * ahead_b - a.vx * ahead_a),
                          b.y - a.y + (b.vy * ahead_b - a.vy * ahead_a));
  const auto wait = time_to_touch(offset, RealVector(b.vx - a.vx, b.vy - a.vy), a.radius + b.radius,
                                  latest - time);
  return wait ? std::optional(time + *wait) : std::nullopt;
}

/// Discs whose gap is at most this may touch, whatever the roundings [m].
constexpr double clear_of_touching = 1e-6;

/// How many can be asked about at once.
constexpr std::uint32_t flight_max = 32;

/// Whom of `count` discs of `near` (ids in `discs`) the disc `own` meets first, as of
/// disc_contact_time(); the first of them in `near` if several come at that time. `near` must be
/// writable three places beyond its end. Meetings after `latest` are left out, as there.
template <class Disc>
FirstContact first_disc_contact_singly(const Disc* discs, std::uint32_t own,
                                       const std::uint32_t* near, std::uint32_t count,
                                       Real latest) {
  FirstContact first;
  for (std::uint32_t k = 0; k < count; ++k) {
    const auto time = disc_contact_time(discs[own], discs[near[k]], latest);
    if (!time) continue;
    first.second_time = std::min(first.second_time, std::max(first.time, *time));
    if (*time < first.time) first.time = *time, first.other = near[k];
  }
  return first;
}

#if defined(RINK_PAIRS_SCALARS)

/// The same bits two at a time, and without a branch that depends on where anybody is: a
/// mispredicted one costs as much as the arithmetic for four discs. First all are tested for what
/// rules a meeting out without a root, then those left over are solved; mostly these are no more
/// than two.
template <class Disc>
FirstContact first_disc_contact_in_pairs(const Disc* discs, std::uint32_t own, std::uint32_t* near,
                                         std::uint32_t count, double latest) {
  const auto both = [](double value) { return _mm_set1_pd(value); };
  const auto pair = [](const double& low, const double& high) {
    return _mm_loadh_pd(_mm_load_sd(&low), &high);
  };
  struct alignas(16) Column {
    double at[flight_max + 2];
  };
  Column times, gaps, openings, misses, squares, reaches;
  const Disc& a = discs[own];
  const __m128d ax = both(a.x), ay = both(a.y), avx = both(a.vx), avy = both(a.vy),
                a_time = both(a.time), a_radius = both(a.radius), limit = both(latest);
  near[count] =
      (count & 1) != 0 ? own : near[count];  // fills an odd count; nobody closes on himself
  std::uint32_t left[flight_max + 3], left_count = 0;
  const std::uint32_t end = count + (count & 1);
  for (std::uint32_t k = 0; k < end; k += 2) {
    const Disc &b = discs[near[k]], &c = discs[near[k + 1]];
    const __m128d b_time = pair(b.time, c.time), vx = pair(b.vx, c.vx), vy = pair(b.vy, c.vy);
    const __m128d time = _mm_max_pd(a_time, b_time), ahead_a = _mm_sub_pd(time, a_time),
                  ahead_b = _mm_sub_pd(time, b_time);
    const __m128d x = _mm_add_pd(_mm_sub_pd(pair(b.x, c.x), ax),
                                 _mm_sub_pd(_mm_mul_pd(vx, ahead_b), _mm_mul_pd(avx, ahead_a)));
    const __m128d y = _mm_add_pd(_mm_sub_pd(pair(b.y, c.y), ay),
                                 _mm_sub_pd(_mm_mul_pd(vy, ahead_b), _mm_mul_pd(avy, ahead_a)));
    const __m128d wx = _mm_sub_pd(vx, avx), wy = _mm_sub_pd(vy, avy),
                  reach = _mm_add_pd(a_radius, pair(b.radius, c.radius));
    const __m128d opening = _mm_add_pd(_mm_mul_pd(x, wx), _mm_mul_pd(y, wy)),
                  square = _mm_add_pd(_mm_mul_pd(wx, wx), _mm_mul_pd(wy, wy));
    const __m128d gap = _mm_sub_pd(_mm_add_pd(_mm_mul_pd(x, x), _mm_mul_pd(y, y)),
                                   _mm_mul_pd(reach, reach)),
                  miss = _mm_sub_pd(_mm_mul_pd(x, wy), _mm_mul_pd(y, wx));
    const __m128d speed = _mm_add_pd(_mm_andnot_pd(both(-0.0), wx), _mm_andnot_pd(both(-0.0), wy)),
                  slack = _mm_mul_pd(_mm_mul_pd(both(root_rounding<double>), reach), speed);
    const __m128d soon =
        _mm_mul_pd(_mm_add_pd(_mm_mul_pd(both(-2.001), opening), slack), _mm_sub_pd(limit, time));
    const __m128d wide = _mm_mul_pd(_mm_mul_pd(_mm_mul_pd(both(1.001), square), reach), reach);
    const __m128d in_reach = _mm_cmple_pd(_mm_mul_pd(miss, miss), wide),
                  in_time = _mm_or_pd(_mm_cmple_pd(gap, soon), _mm_cmple_pd(gap, _mm_setzero_pd()));
    const int mask = _mm_movemask_pd(
        _mm_and_pd(_mm_cmplt_pd(opening, _mm_setzero_pd()), _mm_and_pd(in_time, in_reach)));
    _mm_store_pd(times.at + k, time), _mm_store_pd(gaps.at + k, gap),
        _mm_store_pd(openings.at + k, opening);
    _mm_store_pd(misses.at + k, miss), _mm_store_pd(squares.at + k, square),
        _mm_store_pd(reaches.at + k, reach);
    left[left_count] = k;
    left_count += static_cast<std::uint32_t>(mask & 1);
    left[left_count] = k + 1;
    left_count += static_cast<std::uint32_t>(mask >> 1);
  }
  // Two places that meet nobody: a gap, a negative discriminant.
  left[left_count] = left[left_count + 1] = end;
  times.at[end] = openings.at[end] = squares.at[end] = reaches.at[end] = 0.0;
  gaps.at[end] = misses.at[end] = 1.0;
  const __m128d never = both(std::numeric_limits<double>::infinity());
  FirstContact first;
  std::uint32_t m = 0;
  do {
    const std::uint32_t j = left[m], k = left[m + 1];
    const auto of = [&](const Column& column) { return pair(column.at[j], column.at[k]); };
    const __m128d zero = _mm_setzero_pd(), gap = of(gaps), miss = of(misses),
                  speed_reach = _mm_mul_pd(_mm_sqrt_pd(of(squares)), of(reaches));
    const __m128d discriminant =
        _mm_mul_pd(_mm_sub_pd(speed_reach, miss), _mm_add_pd(speed_reach, miss));
    const __m128d wait = _mm_div_pd(
                      gap, _mm_add_pd(_mm_sub_pd(zero, of(openings)), _mm_sqrt_pd(discriminant))),
                  is_now = _mm_cmple_pd(gap, zero);
    // Who passes by has no root, and waits for no number.
    const __m128d is_meeting = _mm_or_pd(is_now, _mm_cmple_pd(wait, _mm_sub_pd(limit, of(times)))),
                  time = _mm_add_pd(of(times), _mm_andnot_pd(is_now, wait));
    const __m128d found = _mm_or_pd(_mm_and_pd(is_meeting, time), _mm_andnot_pd(is_meeting, never));
    const double time_j = _mm_cvtsd_f64(found),
                 time_k = _mm_cvtsd_f64(_mm_unpackhi_pd(found, found));
    const double earlier = std::min(time_j, time_k), later = std::max(time_j, time_k);
    const std::uint32_t other = near[time_k < time_j ? k : j];
    first.second_time = std::min(std::min(first.second_time, later), std::max(first.time, earlier));
    first.other = earlier < first.time ? other : first.other;
    first.time = std::min(first.time, earlier);
    m += 2;
  } while (m < left_count);
  return first;
}

struct FourPlaces {
  const double *a, *b, *c, *d;
};

/// The four numbers that lie there, and the four that follow them.
[[gnu::target("avx2"), gnu::always_inline]] inline void read_fours(const FourPlaces& at,
                                                                   __m256d& first,
                                                                   __m256d& second) {
  const __m256d even =
      _mm256_insertf128_pd(_mm256_castpd128_pd256(_mm_load_pd(at.a)), _mm_load_pd(at.c), 1);
  const __m256d odd =
      _mm256_insertf128_pd(_mm256_castpd128_pd256(_mm_load_pd(at.b)), _mm_load_pd(at.d), 1);
  first = _mm256_unpacklo_pd(even, odd), second = _mm256_unpackhi_pd(even, odd);
}

/// A disc, four times.
struct FourTimes {
  __m256d x, y, vx, vy, time, radius;
};
template <class Disc>
[[gnu::target("avx2"), gnu::always_inline]] inline FourTimes four_times(const Disc& disc) {
  return {_mm256_set1_pd(disc.x),  _mm256_set1_pd(disc.y),    _mm256_set1_pd(disc.vx),
          _mm256_set1_pd(disc.vy), _mm256_set1_pd(disc.time), _mm256_set1_pd(disc.radius)};
}

/// When one disc meets four, infinite for never, and the squares of their distances at the later of
/// the two events, less those of their reaches.
struct FourMeetings {
  __m256d time, gap, reach;
};
/// As of disc_contact_time(), the four being the next of `near` in `discs`.
template <class Disc>
[[gnu::target("avx2"), gnu::always_inline]] inline FourMeetings meetings_with_four(
    const FourTimes& a, const Disc* discs, const std::uint32_t* near, const __m256d& latest) {
  const Disc &b = discs[near[0]], &c = discs[near[1]], &d = discs[near[2]], &e = discs[near[3]];
  __m256d bx, by, vx, vy, b_time, b_radius;
  read_fours({&b.x, &c.x, &d.x, &e.x}, bx, by);
  read_fours({&b.vx, &c.vx, &d.vx, &e.vx}, vx, vy);
  read_fours({&b.time, &c.time, &d.time, &e.time}, b_time, b_radius);
  const __m256d time = _mm256_max_pd(a.time, b_time), ahead_a = _mm256_sub_pd(time, a.time),
                ahead_b = _mm256_sub_pd(time, b_time), zero = _mm256_setzero_pd();
  const __m256d x =
      _mm256_add_pd(_mm256_sub_pd(bx, a.x),
                    _mm256_sub_pd(_mm256_mul_pd(vx, ahead_b), _mm256_mul_pd(a.vx, ahead_a)));
  const __m256d y =
      _mm256_add_pd(_mm256_sub_pd(by, a.y),
                    _mm256_sub_pd(_mm256_mul_pd(vy, ahead_b), _mm256_mul_pd(a.vy, ahead_a)));
  const __m256d wx = _mm256_sub_pd(vx, a.vx), wy = _mm256_sub_pd(vy, a.vy),
                reach = _mm256_add_pd(a.radius, b_radius);
  const __m256d opening = _mm256_add_pd(_mm256_mul_pd(x, wx), _mm256_mul_pd(y, wy)),
                square = _mm256_add_pd(_mm256_mul_pd(wx, wx), _mm256_mul_pd(wy, wy));
  const __m256d gap = _mm256_sub_pd(_mm256_add_pd(_mm256_mul_pd(x, x), _mm256_mul_pd(y, y)),
                                    _mm256_mul_pd(reach, reach));
  const __m256d miss = _mm256_sub_pd(_mm256_mul_pd(x, wy), _mm256_mul_pd(y, wx)),
                speed_reach = _mm256_mul_pd(_mm256_sqrt_pd(square), reach);
  const __m256d discriminant = _mm256_mul_pd(_mm256_sub_pd(speed_reach, miss),
                                             _mm256_add_pd(speed_reach, miss)),
                is_now = _mm256_cmp_pd(gap, zero, _CMP_LE_OQ);
  // Who passes by has no root, and waits for no number.
  const __m256d wait =
      _mm256_div_pd(gap, _mm256_add_pd(_mm256_sub_pd(zero, opening), _mm256_sqrt_pd(discriminant)));
  const __m256d in_time =
      _mm256_or_pd(is_now, _mm256_cmp_pd(wait, _mm256_sub_pd(latest, time), _CMP_LE_OQ));
  const __m256d is_meeting = _mm256_and_pd(_mm256_cmp_pd(opening, zero, _CMP_LT_OQ), in_time);
  return {_mm256_blendv_pd(_mm256_set1_pd(std::numeric_limits<double>::infinity()),
                           _mm256_add_pd(time, _mm256_andnot_pd(is_now, wait)), is_meeting),
          gap, reach};
}

/// The same bits four at a time, in one pass: so many roots cost less than to find out who needs
/// one. Who touches is told, and places that fill up fours are not counted, if `counts`.
template <bool counts, class Disc>
[[gnu::target("avx2")]] FirstContact first_disc_contact_in_fours(
    const Disc* discs, std::uint32_t own, std::uint32_t* near, std::uint32_t count, double latest) {
  if ((count & 3) != 0)
    near[count] = near[count + 1] = near[count + 2] = own;  // nobody closes on himself
  const FourTimes a = four_times(discs[own]);
  const __m256d limit = _mm256_set1_pd(latest),
                never = _mm256_set1_pd(std::numeric_limits<double>::infinity());
  __m256d first = never, second = never;
  __m256i touching = _mm256_setzero_si256();  // counted downwards
  __m256i places = _mm256_setr_epi64x(0, 1, 2, 3), others = places;
  for (std::uint32_t k = 0; k < count; k += 4) {
    const auto [found, gap, reach] = meetings_with_four(a, discs, near + k, limit);
    // (r + c)^2 - r^2
    if constexpr (counts) {
      const __m256d close =
          _mm256_add_pd(_mm256_mul_pd(reach, _mm256_set1_pd(2.0 * clear_of_touching)),
                        _mm256_set1_pd(clear_of_touching * clear_of_touching));
      touching =
          _mm256_add_epi64(touching, _mm256_castpd_si256(_mm256_cmp_pd(gap, close, _CMP_LE_OQ)));
    }
    const __m256d is_earlier = _mm256_cmp_pd(found, first, _CMP_LT_OQ);
    second = _mm256_min_pd(second, _mm256_max_pd(first, found));
    others = _mm256_castpd_si256(
        _mm256_blendv_pd(_mm256_castsi256_pd(others), _mm256_castsi256_pd(places), is_earlier));
    first = _mm256_min_pd(first, found);
    places = _mm256_add_epi64(places, _mm256_set1_epi64x(4));
  }
  FirstContact contact;
  if constexpr (counts) {
    alignas(32) std::int64_t counted[4];
    _mm256_store_si256(reinterpret_cast<__m256i*>(counted), touching);
    contact.touching =
        static_cast<std::uint32_t>(-(counted[0] + counted[1] + counted[2] + counted[3])) -
        ((0u - count) & 3u);
  }
  if (_mm256_movemask_pd(_mm256_cmp_pd(first, never, _CMP_LT_OQ)) == 0) return contact;
  // The earliest of the four lanes, and the first in `near` among equal ones.
  const __m256d first_crossed = _mm256_permute2f128_pd(first, first, 1);
  const __m256d second_two =
      _mm256_min_pd(_mm256_min_pd(second, _mm256_permute2f128_pd(second, second, 1)),
                    _mm256_max_pd(first, first_crossed));
  const __m256d first_two = _mm256_min_pd(first, first_crossed),
                swapped = _mm256_permute_pd(first_two, 5);
  const __m256d first_one = _mm256_min_pd(first_two, swapped);
  const __m256d second_one =
      _mm256_min_pd(_mm256_min_pd(second_two, _mm256_permute_pd(second_two, 5)),
                    _mm256_max_pd(first_two, swapped));
  const int lanes = _mm256_movemask_pd(_mm256_cmp_pd(first, first_one, _CMP_EQ_OQ));
  alignas(32) std::int64_t place_of[4];
  _mm256_store_si256(reinterpret_cast<__m256i*>(place_of), others);
  contact.time = _mm256_cvtsd_f64(first_one), contact.second_time = _mm256_cvtsd_f64(second_one);
  std::int64_t place = place_of[__builtin_ctz(static_cast<unsigned>(lanes))];
  if (contact.second_time == contact.time)
    for (int lane = 0; lane < 4; ++lane)
      if ((lanes >> lane & 1) != 0) place = std::min(place, place_of[lane]);
  contact.other = near[place];
  return contact;
}

/// Calls `visit(other, time)` for each of `count` discs of `near` that the disc `own` ever meets,
/// with the time of disc_contact_time(). `near` must be writable three places beyond its end.
template <class Disc, class Visit>
[[gnu::target("avx2")]] void visit_meetings_in_fours(const Disc* discs, std::uint32_t own,
                                                     std::uint32_t* near, std::uint32_t count,
                                                     Visit&& visit) {
  near[count] = near[count + 1] = near[count + 2] = own;  // nobody closes on himself
  const FourTimes a = four_times(discs[own]);
  const __m256d never = _mm256_set1_pd(std::numeric_limits<double>::infinity());
  for (std::uint32_t k = 0; k < count; k += 4) {
    const __m256d found = meetings_with_four(a, discs, near + k, never).time;
    auto lanes = static_cast<unsigned>(_mm256_movemask_pd(_mm256_cmp_pd(found, never, _CMP_LT_OQ)));
    if (lanes == 0) continue;
    alignas(32) double times[4];
    _mm256_store_pd(times, found);
    for (; lanes != 0; lanes &= lanes - 1) {
      const auto lane = static_cast<std::uint32_t>(__builtin_ctz(lanes));
      visit(near[k + lane], times[lane]);
    }
  }
}

/// Whether this machine can do more than its baseline says.
inline const bool has_fours = __builtin_cpu_supports("avx2") != 0;

#endif

/// As first_disc_contact_singly(), the quickest way that this machine's baseline allows.
template <class Disc>
FirstContact first_disc_contact(const Disc* discs, std::uint32_t own, std::uint32_t* near,
                                std::uint32_t count, Real latest) {
  assert(count <= flight_max);
#if defined(RINK_PAIRS_SCALARS)
  return has_fours ? first_disc_contact_in_fours<false>(discs, own, near, count, latest)
                   : first_disc_contact_in_pairs(discs, own, near, count, latest);
#else
  return first_disc_contact_singly(discs, own, near, count, latest);
#endif
}

/// Whether first_disc_contact_counting() is there.
inline bool counts_touching() {
#if defined(RINK_PAIRS_SCALARS)
  return has_fours;
#else
  return false;
#endif
}

/// Whether visit_meetings() is there.
inline bool visits_meetings() { return counts_touching(); }

/// As visit_meetings_in_fours().
template <class Disc, class Visit>
void visit_meetings(const Disc* discs, std::uint32_t own, std::uint32_t* near, std::uint32_t count,
                    Visit&& visit) {
  assert(visits_meetings());
#if defined(RINK_PAIRS_SCALARS)
  visit_meetings_in_fours(discs, own, near, count, visit);
#else
  for (std::uint32_t k = 0; k < count; ++k)
    if (const auto time =
            disc_contact_time(discs[own], discs[near[k]], std::numeric_limits<Real>::infinity()))
      visit(near[k], *time);
#endif
}

/// As first_disc_contact(), and who touches is counted as well: asked in the same breath, that
/// takes four instructions more per four discs.
template <class Disc>
FirstContact first_disc_contact_counting(const Disc* discs, std::uint32_t own, std::uint32_t* near,
                                         std::uint32_t count, Real latest) {
  assert(counts_touching());
#if defined(RINK_PAIRS_SCALARS)
  return first_disc_contact_in_fours<true>(discs, own, near, count, latest);
#else
  return first_disc_contact(discs, own, near, count, latest);
#endif
}

}  // namespace rink::physics::inline RINK_PRECISION
