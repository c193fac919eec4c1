// What every module builds on: hashes and random numbers against those that their authors publish.
#include <gtest/gtest.h>

#include <array>
#include <initializer_list>
#include <limits>
#include <optional>
#include <vector>

#include "im/basics/fnv_hash.h"
#include "im/basics/hexadecimal.h"
#include "im/basics/seeded_stream.h"
#include "im/basics/varint.h"

namespace rink {
namespace {

TEST(FnvHash, IsThatOfItsAuthorsTestVectors) {
  // draft-eastlake-fnv, appendix C
  EXPECT_EQ(hash_of<Fnv32>(""), 0x811c9dc5u);
  EXPECT_EQ(hash_of<Fnv32>("a"), 0xe40c292cu);
  EXPECT_EQ(hash_of<Fnv32>("foobar"), 0xbf9cf968u);
  EXPECT_EQ(hash_of<Fnv64>(""), 0xcbf29ce484222325u);
  EXPECT_EQ(hash_of<Fnv64>("a"), 0xaf63dc4c8601ec8cu);
  EXPECT_EQ(hash_of<Fnv64>("foobar"), 0x85944171f73967e8u);
}

TEST(FnvHash, OfAWordIsThatOfItsBytesTheLeastSignificantFirst) {
  Fnv64 word, number;
  word.add_word(0x7261626f6f66u);
  number.add_number(0x1p-1022);
  EXPECT_EQ(word.value(), hash_of({"foobar\0\0", 8}));
  EXPECT_EQ(number.value(), hash_of({"\0\0\0\0\0\0\x10\0", 8}));
}

TEST(Hexadecimal, HasSixteenDigits) {
  EXPECT_EQ(hexadecimal(0), "0000000000000000");
  EXPECT_EQ(hexadecimal(0x0123456789abcdefu), "0123456789abcdef");
  EXPECT_EQ(hexadecimal(std::numeric_limits<std::uint64_t>::max()), "ffffffffffffffff");
}

TEST(Varint, ReadsWhatItWroteInAsFewBytesAsSevenBitsEachAllow) {
  for (unsigned bits = 0; bits <= 64; ++bits)
    for (const std::uint64_t below : {0u, 1u}) {
      const std::uint64_t value = (bits == 64 ? 0 : std::uint64_t{1} << bits) - below;
      std::array<std::byte, varint_size_max> bytes{};
      const auto size = static_cast<std::size_t>(put_varint(bytes.data(), value) - bytes.data());
      EXPECT_EQ(size, varint_size(value));
      EXPECT_EQ(size, value == 0 ? 1u : (64 - std::countl_zero(value) + 6) / 7);
      std::uint64_t read = 0;
      EXPECT_EQ(get_varint(bytes, read), size);
      EXPECT_EQ(read, value);
      EXPECT_EQ(get_varint(std::span(bytes).first(size - 1), read), 0u) << "cut off";
    }
}

TEST(Varint, OfMoreThanTenBytesIsNone) {
  std::array<std::byte, 11> bytes;
  bytes.fill(std::byte{0x80});
  bytes.back() = std::byte{0};
  std::uint64_t read = 0;
  EXPECT_EQ(get_varint(bytes, read), 0u);
}

TEST(Varint, HasOneFormOfBytes) {
  const auto number = [](std::initializer_list<unsigned> numbers) -> std::optional<std::uint64_t> {
    std::vector<std::byte> bytes;
    for (const unsigned byte : numbers) bytes.push_back(static_cast<std::byte>(byte));
    std::uint64_t read = 0;
    if (get_varint(bytes, read) != bytes.size()) return std::nullopt;
    return read;
  };
  EXPECT_EQ(number({0}), 0u);
  EXPECT_EQ(number({0xac, 2}), 300u);
  EXPECT_EQ(number({255, 255, 255, 255, 255, 255, 255, 255, 255, 1}), ~std::uint64_t{0});
  EXPECT_EQ(number({0xac, 0x82, 0}), std::nullopt);  // 300 in three bytes
  EXPECT_EQ(number({0x80, 0}), std::nullopt);
  EXPECT_EQ(number({0x80}), std::nullopt);
  EXPECT_EQ(number({255, 255, 255, 255, 255, 255, 255, 255, 255, 3}), std::nullopt);
  EXPECT_EQ(number({255, 255, 255, 255, 255, 255, 255, 255, 255, 255, 1}), std::nullopt);
}

TEST(Varint, OfANumberOfAnySignIsShortNearZero) {
  for (const std::int64_t value : {0, -1, 1, -2, 2})
    EXPECT_EQ(zigzag(value), static_cast<std::uint64_t>(value < 0 ? -2 * value - 1 : 2 * value));
  for (const std::int64_t value : {std::numeric_limits<std::int64_t>::min(), std::int64_t{-77},
                                   std::numeric_limits<std::int64_t>::max()})
    EXPECT_EQ(from_zigzag(zigzag(value)), value);
}

TEST(SeededStream, IsThatOfTheReferenceImplementation) {
  // splitmix64.c (Vigna 2015) from the state 1234567
  SeededStream stream(1234567);
  for (const std::uint64_t expected :
       {6457827717110365317u, 3203168211198807973u, 9817491932198370423u, 4593380528125082431u,
        16408922859458223821u})
    EXPECT_EQ(stream.next(), expected);
}

TEST(SeededStream, FillsUnitIntervalsAndDrawsEveryNumberBelowACount) {
  SeededStream stream(7);
  double sum = 0.0;
  int drawn[5] = {};
  constexpr int draws = 100'000;
  for (int k = 0; k < draws; ++k) {
    const double part = stream.uniform();
    ASSERT_GE(part, 0.0);
    ASSERT_LT(part, 1.0);
    sum += part;
    ++drawn[stream.below(5)];
  }
  EXPECT_NEAR(sum / draws, 0.5, 5 * 0.289 / 316);  // five standard errors
  for (const int count : drawn) EXPECT_NEAR(count, draws / 5, 5 * 127);
}

}  // namespace
}  // namespace rink
