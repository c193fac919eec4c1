// Eight boxes in one line of memory: their edges rounded to bytes within their cell, and who they
// are.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cstdint>

#include "im/matching/projection.h"
#include "im/matching/region_history.h"

#ifdef __SSE2__
#include <emmintrin.h>
#endif

namespace rink::im {

// Numbers that are reckoned four at a time wherever the processor can; how is the compiler's
// business.
using FourFloats = float __attribute__((vector_size(16)));
using FourInts = std::int32_t __attribute__((vector_size(16)));

/// Truncates; what is not a number is the least.
inline FourInts whole(FourFloats numbers, FourFloats least, FourFloats greatest) {
  numbers = numbers > least ? numbers : least;
  numbers = numbers < greatest ? numbers : greatest;
  return __builtin_convertvector(numbers, FourInts);
}

/// Four numbers of a box within a cell, as a line holds them or as they are compared with one. Each
/// is a function of one edge that never decreases, or never increases: so a rounded overlap without
/// a tie is one, a rounded gap is one, and only ties need the exact test (as in projection.h). In a
/// box that is held these are low x, low y and, counted downwards, high x, high y; in one that asks
/// high x, high y and, counted downwards, low x, low y. They overlap if all four of the asker are
/// not below.
using Edges = FourInts;

/// Rounds edges for the cells of one level.
class EdgeCoding {
 public:
  static constexpr std::int32_t steps =
      252;  ///< what a byte can tell apart, with room at either end for what is outside
  /// Finest for cells of so many to a metre along each axis whose boxes reach so far.
  EdgeCoding(float cells_per_metre_x, float cells_per_metre_y, float widest_x, float widest_y);

  Edges held(const FloatBox& box) const { return code(std::bit_cast<FourFloats>(box)); }
  Edges asking(const FloatBox& box) const {
    return code(__builtin_shufflevector(std::bit_cast<FourFloats>(box),
                                        std::bit_cast<FourFloats>(box), 2, 3, 0, 1));
  }
  /// To be added for the cell in this column and row.
  Edges offset(std::int32_t column, std::int32_t row) const {
    return Edges{-column * steps, -row * steps, column * high_steps_x_, row * high_steps_y_};
  }
  /// To be added for each column more.
  Edges column_step() const { return Edges{-steps, 0, high_steps_x_, 0}; }

 private:
  Edges code(FourFloats edges) const {
    constexpr float limit = 0x1p29f;
    constexpr Edges is_counted_down{0, 0, -1, -1}, first{1, 1, steps + 2, steps + 2};
    const Edges counted = whole(edges * scale_, FourFloats{-limit, -limit, -limit, -limit},
                                FourFloats{limit, limit, limit, limit});
    return (counted ^ is_counted_down) - is_counted_down + first;
  }

  FourFloats scale_;
  std::int32_t high_steps_x_, high_steps_y_;
};

/// Both bounded to a byte each, those of `now` first.
inline std::uint64_t pack(Edges now, Edges before) {
#ifdef __SSE2__
  const __m128i words =
      _mm_packs_epi32(std::bit_cast<__m128i>(now), std::bit_cast<__m128i>(before));
  return std::bit_cast<std::array<std::uint64_t, 2>>(_mm_packus_epi16(words, words))[0];
#else
  std::uint64_t packed = 0;
  for (unsigned i = 0; i < 4; ++i) {
    packed |= static_cast<std::uint64_t>(std::clamp(now[i], 0, 255)) << 8 * i;
    packed |= static_cast<std::uint64_t>(std::clamp(before[i], 0, 255)) << (32 + 8 * i);
  }
  return packed;
#endif
}

/// The top bits of the ids say how many boxes there are, which are in the first lanes, and whether
/// the cell has further lines.
struct alignas(64) Line {
  static constexpr std::uint32_t lanes = 8, id_mask = 0x7FFFFFFF;
  /// Never the id of a box: an empty lane's. Its edges meet only those of who reaches beyond the
  /// cell on all sides, and tie with them.
  static constexpr std::uint32_t nobody = RegionHistory::id_max;

  std::uint8_t edges[4][lanes];
  std::uint32_t ids[lanes];

  void clear() {
    for (auto& column : edges)
      for (std::uint8_t& edge : column) edge = 255;
    for (std::uint32_t& id : ids) id = nobody;
  }
  void clear(std::uint32_t lane) { set(lane, nobody, 0xFFFFFFFF); }
  std::uint32_t id(std::uint32_t lane) const { return ids[lane] & id_mask; }
  std::uint32_t packed(std::uint32_t lane) const {
    return edges[0][lane] | std::uint32_t{edges[1][lane]} << 8 |
           std::uint32_t{edges[2][lane]} << 16 | std::uint32_t{edges[3][lane]} << 24;
  }
  void set(std::uint32_t lane, std::uint32_t packed) {
    for (unsigned i = 0; i < 4; ++i) edges[i][lane] = static_cast<std::uint8_t>(packed >> 8 * i);
  }
  void set(std::uint32_t lane, std::uint32_t id, std::uint32_t packed) {
    assert(lane < lanes && id <= nobody);
    set(lane, packed);
    ids[lane] = (ids[lane] & ~id_mask) | id;
  }
  void set_count(std::uint32_t count) {
    assert(count <= lanes);
    for (std::uint32_t i = 0; i < 4; ++i)
      ids[4 + i] = (ids[4 + i] & id_mask) | (count >> i & 1u) << 31;
  }
  bool has_more() const { return (ids[0] & ~id_mask) != 0; }
  void set_more(bool more) { ids[0] = (ids[0] & id_mask) | (more ? ~id_mask : 0u); }
#ifdef __SSE2__
  std::uint32_t count() const {
    return static_cast<std::uint32_t>(
        _mm_movemask_ps(_mm_load_ps(reinterpret_cast<const float*>(ids + 4))));
  }
  /// The lane of `id`; `lanes` if it is in none.
  std::uint32_t find(std::uint32_t id) const {
    const __m128i mask = _mm_set1_epi32(static_cast<int>(id_mask)),
                  wanted = _mm_set1_epi32(static_cast<int>(id));
    const auto hits = [&](const std::uint32_t* four) {
      return _mm_cmpeq_epi32(
          _mm_and_si128(_mm_load_si128(reinterpret_cast<const __m128i*>(four)), mask), wanted);
    };
    const __m128i words = _mm_packs_epi32(hits(ids), hits(ids + 4));
    return static_cast<std::uint32_t>(std::countr_zero(
        static_cast<unsigned>(_mm_movemask_epi8(_mm_packs_epi16(words, _mm_setzero_si128()))) |
        1u << lanes));
  }
#else
  std::uint32_t count() const {
    return ids[4] >> 31 | ids[5] >> 31 << 1 | ids[6] >> 31 << 2 | ids[7] >> 31 << 3;
  }
  std::uint32_t find(std::uint32_t id) const {
    unsigned hits = 1u << lanes;
    for (std::uint32_t lane = 0; lane < lanes; ++lane)
      hits |= static_cast<unsigned>((ids[lane] & id_mask) == id) << lane;
    return static_cast<std::uint32_t>(std::countr_zero(hits));
  }
#endif
};

}  // namespace rink::im
