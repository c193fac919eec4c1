// The hash of states, models, files and names. It is the same on every machine; it detects
// truncation, bad disks and edits, not forgery.
#pragma once

#include <bit>
#include <concepts>
#include <cstdint>
#include <string_view>

namespace rink {

/// FNV-1a of 32 or 64 bits (Fowler, Noll and Vo; draft-eastlake-fnv, section 2).
template <std::unsigned_integral Word>
requires(sizeof(Word) == 4 || sizeof(Word) == 8) class FnvHash {
 public:
  constexpr FnvHash() = default;
  /// Continues from the value of another hash.
  constexpr explicit FnvHash(Word value) : value_(value) {}

  constexpr void add(std::uint8_t byte) { value_ = (value_ ^ byte) * prime; }
  constexpr void add(std::string_view bytes) {
    for (const char byte : bytes) add(static_cast<std::uint8_t>(byte));
  }
  /// Its eight bytes, the least significant first.
  constexpr void add_word(std::uint64_t word) {
    for (int byte = 0; byte < 8; ++byte, word >>= 8) add(static_cast<std::uint8_t>(word));
  }
  /// The eight bytes of a double, the least significant first.
  constexpr void add_number(double number) { add_word(std::bit_cast<std::uint64_t>(number)); }
  constexpr Word value() const { return value_; }

 private:
  static constexpr Word prime =
      sizeof(Word) == 4 ? Word{16'777'619u} : static_cast<Word>(0x100'0000'01b3u);
  Word value_ =
      sizeof(Word) == 4 ? Word{2'166'136'261u} : static_cast<Word>(0xcbf2'9ce4'8422'2325u);
};
using Fnv32 = FnvHash<std::uint32_t>;
using Fnv64 = FnvHash<std::uint64_t>;

/// Of all bytes of a text.
template <class Hash = Fnv64>
constexpr auto hash_of(std::string_view bytes) {
  Hash hash;
  hash.add(bytes);
  return hash.value();
}

}  // namespace rink
