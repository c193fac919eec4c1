// By insertion, by counting how many are smaller, or by digits: none has a branch that goes either
// way by chance but the first, which is for very few.
#include "im/matching/short_sort.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <utility>

namespace rink::im {
namespace {

/// The fewest that are ranked, and the most: of more, digits are read sooner.
constexpr std::size_t ranked_least = 7, ranked_most = 96;

void sort_by_insertion(std::span<std::uint32_t> numbers) {
  for (std::size_t i = 1; i < numbers.size(); ++i) {
    const std::uint32_t number = numbers[i];
    std::size_t place = i;
    for (; place > 0 && numbers[place - 1] > number; --place) numbers[place] = numbers[place - 1];
    numbers[place] = number;
  }
}

/// Each is put where its rank is: counting takes a third of what sorting by comparison does.
void sort_by_rank(std::span<std::uint32_t> numbers) {
  constexpr std::uint32_t sign = 0x80000000;  // narrow instructions compare numbers with a sign
  assert(numbers.size() <= ranked_most);
  std::array<std::int32_t, ranked_most> own, ranks;
  const std::size_t padded = (numbers.size() + 7) / 8 * 8;
  for (std::size_t i = 0; i < numbers.size(); ++i)
    own[i] = static_cast<std::int32_t>(numbers[i] ^ sign);
  for (std::size_t i = numbers.size(); i < padded; ++i) own[i] = 0;
  for (std::size_t first = 0; first < padded; first += 8) {
    std::array<std::int32_t, 8> eight, below{};
    for (std::size_t k = 0; k < 8; ++k) eight[k] = own[first + k];
    for (std::size_t j = 0; j < numbers.size(); ++j)
      for (std::size_t k = 0; k < 8; ++k) below[k] += static_cast<std::int32_t>(own[j] < eight[k]);
    for (std::size_t k = 0; k < 8; ++k) ranks[first + k] = below[k];
  }
  for (std::size_t i = 0; i < numbers.size(); ++i)
    numbers[static_cast<std::size_t>(ranks[i])] = static_cast<std::uint32_t>(own[i]) ^ sign;
}

/// Bytes from the last to the first in which they differ.
void sort_by_bytes(std::span<std::uint32_t> numbers, Buffer<std::uint32_t>& spare) {
  std::uint32_t varying = 0;
  for (const std::uint32_t number : numbers) varying |= number ^ numbers[0];
  spare.resize(numbers.size());
  std::span<std::uint32_t> from = numbers, to{spare.data(), numbers.size()};
  for (unsigned shift = 0; shift < 32 && varying >> shift != 0; shift += 8) {
    std::array<std::uint32_t, 257> starts{};
    for (const std::uint32_t number : from) ++starts[(number >> shift & 0xFFu) + 1];
    for (std::size_t i = 1; i < starts.size(); ++i) starts[i] += starts[i - 1];
    for (const std::uint32_t number : from) to[starts[number >> shift & 0xFFu]++] = number;
    std::swap(from, to);
  }
  if (from.data() != numbers.data()) std::copy(from.begin(), from.end(), numbers.begin());
}

}  // namespace

void sort_short(std::span<std::uint32_t> numbers, Buffer<std::uint32_t>& spare) {
  if (numbers.size() < ranked_least) return sort_by_insertion(numbers);
  if (std::is_sorted(numbers.begin(), numbers.end())) return;
  if (numbers.size() <= ranked_most) return sort_by_rank(numbers);
  sort_by_bytes(numbers, spare);
}

}  // namespace rink::im
