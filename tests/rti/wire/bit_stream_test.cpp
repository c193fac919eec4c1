// Bit streams: what is written is read back, in exactly as many bits as were measured; rounding
// stays within the stated error; strangers' bits are refused.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <optional>
#include <random>

#include "rti/wire/bit_stream.h"
#include "tests/rti/seeded.h"

namespace rink::rti::testing {
namespace {

/// A message of every kind of field, with one function for all three streams.
struct BuoyMessage {
  bool is_lit = false;
  std::int64_t depth = 0;  ///< -11,000 to 9,000
  double bearing = 0.0, tide = 0.0, mass = 0.0;
  std::uint64_t visits = 0, serial = 0;
};
template <class Stream>
bool exchange(Stream& stream, BuoyMessage& buoy) {
  return stream.flag(buoy.is_lit) && stream.ranged(buoy.depth, -11'000, 9'000) &&
         stream.quantised(buoy.bearing, 0.0, 360.0, 0.25) &&
         stream.quantised(buoy.tide, -20.0, 20.0, 1e-3) && stream.full(buoy.mass) &&
         stream.golomb(buoy.visits, 3) && stream.bits(buoy.serial, 40);
}

BuoyMessage random_buoy(std::mt19937_64& random) {
  BuoyMessage buoy;
  buoy.is_lit = random() % 2 != 0;
  buoy.depth = static_cast<std::int64_t>(random() % 20'001) - 11'000;
  buoy.bearing = between(random, 0.0, 360.0);
  buoy.tide = between(random, -20.0, 20.0);
  buoy.mass = std::bit_cast<double>(random());
  buoy.visits = (random() >> 8) >> (random() % 56);
  buoy.serial = random() >> 24;
  return buoy;
}

TEST(BitStream, ReadsBackWhatWasWrittenInAsManyBitsAsWereMeasured) {
  for (unsigned seed = 1; seed <= 500; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937_64 random(seed);
    std::vector<std::byte> bytes(seed % 3);  // it may begin behind anything that ends with a byte
    std::vector<BuoyMessage> written;
    BitMeasurer measurer;
    {
      BitWriter writer(bytes);
      for (unsigned i = 0; i < 1 + seed % 7; ++i) {
        written.push_back(random_buoy(random));
        ASSERT_TRUE(exchange(writer, written.back()) && exchange(measurer, written.back()));
      }
    }
    ASSERT_EQ(bytes.size(), seed % 3 + measurer.bytes());
    BitReader reader(Bytes(bytes).subspan(seed % 3));
    for (const BuoyMessage& buoy : written) {
      BuoyMessage read;
      ASSERT_TRUE(exchange(reader, read));
      EXPECT_EQ(read.is_lit, buoy.is_lit);
      EXPECT_EQ(read.depth, buoy.depth);
      EXPECT_LE(std::abs(read.bearing - buoy.bearing), 0.25);
      EXPECT_LE(std::abs(read.tide - buoy.tide), 1e-3);
      EXPECT_EQ(std::bit_cast<std::uint64_t>(read.mass), std::bit_cast<std::uint64_t>(buoy.mass))
          << "not a number, for one, has many forms";
      EXPECT_EQ(read.visits, buoy.visits);
      EXPECT_EQ(read.serial, buoy.serial);
    }
    EXPECT_EQ(reader.at(), measurer.bits());
    EXPECT_TRUE(reader.finish());
    EXPECT_EQ(reader.left(), 0u);
  }
}

TEST(BitStream, TakesExactlyTheBitsThatTellTheValuesApart) {
  const auto bits_of = [](const auto& say) {
    BitMeasurer measurer;
    say(measurer);
    return measurer.bits();
  };
  EXPECT_EQ(bits_of([](BitMeasurer& stream) { stream.ranged(5, 5, 5); }), 0u);
  EXPECT_EQ(bits_of([](BitMeasurer& stream) { stream.ranged(1, 0, 1); }), 1u);
  EXPECT_EQ(bits_of([](BitMeasurer& stream) { stream.ranged(0, -128, 127); }), 8u);
  EXPECT_EQ(bits_of([](BitMeasurer& stream) { stream.ranged(0, -128, 128); }), 9u);
  EXPECT_EQ(bits_of([](BitMeasurer& stream) {
              stream.ranged(0, std::numeric_limits<std::int64_t>::min(),
                            std::numeric_limits<std::int64_t>::max());
            }),
            64u);
  // 64 m in steps of 2^-11 m are 2^17 steps and one value more than 17 bits tell apart.
  EXPECT_EQ(bits_of([](BitMeasurer& stream) { stream.quantised(0.0, 0.0, 64.0, 0x1p-12); }), 18u);
  EXPECT_EQ(
      bits_of([](BitMeasurer& stream) { stream.quantised(0.0, 0.0, 64.0 - 0x1p-11, 0x1p-12); }),
      17u);
  EXPECT_EQ(bits_of([](BitMeasurer& stream) { stream.quantised(0.0, 0.0, 63.0, 0.0005 / 2); }), 17u)
      << "in steps of 2^-11 m, the power of two below 0.0005";
  for (std::uint64_t value = 0; value < 1000; ++value)
    EXPECT_EQ(
        golomb_size(value, 0),
        2 * static_cast<unsigned>(std::floor(std::log2(static_cast<double>(value) + 1.0))) + 1);
}

TEST(BitStream, RoundsByNoMoreThanTheStatedErrorAndNeverTwice) {
  for (unsigned seed = 1; seed <= 2000; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937_64 random(seed);
    const double middle = between(random, -1.0, 1.0) * std::pow(10.0, between(random, -3.0, 6.0));
    const double span = std::pow(10.0, between(random, -3.0, 6.0)),
                 error = span * std::pow(10.0, between(random, -7.0, -0.1));
    const double low = middle - span, high = middle + span;
    const auto grid = Quantisation::of(low, high, error);
    if (!grid) continue;
    EXPECT_LE(grid->error(), error);
    EXPECT_GT(2.0 * grid->error(), error) << "a step twice as long would not do";
    for (int i = 0; i < 20; ++i) {
      const double value = i == 0   ? low
                           : i == 1 ? high
                           : i == 2 ? std::nextafter(low, high)
                           : i == 3 ? std::nextafter(high, low)
                                    : between(random, low, high);
      std::vector<std::byte> bytes;
      BitWriter(bytes).quantised(value, low, high, error);
      double read = 0.0;
      ASSERT_TRUE(BitReader(bytes).quantised(read, low, high, error));
      EXPECT_LE(std::abs(read - value), error) << value;
      EXPECT_EQ(grid->value(grid->count(read)), read) << "what is on the grid stays where it is";
    }
    if (low <= 0.0 && high >= 0.0) {
      EXPECT_EQ(grid->value(grid->count(0.0)), 0.0);
    }
  }
}

TEST(BitStream, HasNoGridForARangeOrErrorThatNoneCovers) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN(),
                   infinite = std::numeric_limits<double>::infinity();
  EXPECT_FALSE(Quantisation::of(1.0, 1.0, 0.1));
  EXPECT_FALSE(Quantisation::of(2.0, 1.0, 0.1));
  EXPECT_FALSE(Quantisation::of(0.0, 1.0, 0.0));
  EXPECT_FALSE(Quantisation::of(0.0, 1.0, -0.1));
  EXPECT_FALSE(Quantisation::of(0.0, infinite, 0.1));
  EXPECT_FALSE(Quantisation::of(nan, 1.0, 0.1));
  EXPECT_FALSE(Quantisation::of(0.0, 1.0, nan));
  EXPECT_FALSE(Quantisation::of(0.0, 1.0, 1e-300)) << "more than 48 bits";
  EXPECT_FALSE(Quantisation::of(1e18, 1e18 + 1e6, 0.01)) << "finer than a double is there";
}

TEST(BitStream, RefusesWhatIsOutOfRange) {
  std::vector<std::byte> bytes;
  BitWriter(bytes).bits(20'001u, 15);
  std::int64_t depth = 0;
  EXPECT_FALSE(BitReader(bytes).ranged(depth, -11'000, 9'000)) << "one more than the greatest";
  bytes.clear();
  const auto grid = Quantisation::of(0.0, 10.0, 0.5);
  ASSERT_TRUE(grid);
  ASSERT_EQ(grid->last, 10u);
  BitWriter(bytes).bits(11u, grid->bits);
  double value = 0.0;
  EXPECT_FALSE(BitReader(bytes).quantised(value, *grid));
  const std::vector<std::byte> zeros(16);
  std::uint64_t number = 0;
  EXPECT_FALSE(BitReader(zeros).golomb(number, 0)) << "longer than any number";
  bytes = {std::byte{0xff}};
  BitReader reader(bytes);
  EXPECT_TRUE(reader.bits(number, 3));
  EXPECT_FALSE(reader.finish()) << "what fills up the last byte is zeros";
}

TEST(BitStream, SurvivesHostileBytesAndWritesAgainWhatItAccepts) {
  for (unsigned seed = 1; seed <= 3000; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937_64 random(seed);
    std::vector<std::byte> bytes(random() % 40);
    for (std::byte& byte : bytes) byte = static_cast<std::byte>(random() & random());
    BitReader reader(bytes);
    BuoyMessage read;
    if (!exchange(reader, read)) continue;
    std::vector<std::byte> again;
    {
      BitWriter writer(again);
      exchange(writer, read);
    }
    BitReader rest(bytes, reader.at());
    ASSERT_EQ(again.size(), reader.bytes_read());
    for (std::size_t bit = 0; bit < reader.at(); ++bit)
      ASSERT_EQ(static_cast<unsigned>(again[bit / 8]) >> bit % 8 & 1u,
                static_cast<unsigned>(bytes[bit / 8]) >> bit % 8 & 1u)
          << "bit " << bit;
  }
}

TEST(BitStream, ReadsNothingFromFewerBits) {
  std::mt19937_64 random(5);
  BuoyMessage buoy = random_buoy(random);
  std::vector<std::byte> bytes;
  BitMeasurer measurer;
  exchange(measurer, buoy);
  {
    BitWriter writer(bytes);
    exchange(writer, buoy);
  }
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    BitReader reader(Bytes(bytes).first(size));
    BuoyMessage read;
    ASSERT_FALSE(exchange(reader, read)) << size << " of " << bytes.size() << " bytes";
  }
}

/// The code bit by bit, as its definition says: zeros up to a one, as many bits of the head, then
/// `order` bits; nothing if they end before.
std::optional<std::uint64_t> golomb_bit_by_bit(Bytes bytes, std::size_t at, unsigned order) {
  const auto left = [&] { return 8 * bytes.size() - at; };
  const auto next = [&] {
    const std::uint64_t bit = static_cast<std::uint64_t>(bytes[at / 8]) >> at % 8 & 1u;
    ++at;
    return bit;
  };
  unsigned length = 0;
  for (;; ++length) {
    if (left() == 0) return std::nullopt;
    if (next() == 1) break;
  }
  if (left() < length + order) return std::nullopt;
  std::uint64_t head = 0, tail = 0;
  for (unsigned bit = 0; bit < length; ++bit) head |= next() << bit;
  for (unsigned bit = 0; bit < order; ++bit) tail |= next() << bit;
  return (head + (std::uint64_t{1} << length) - 1) << order | tail;
}

TEST(BitStream, ReadsGolombCodesFromEachBitToTheLastAsTheirDefinitionSays) {
  std::mt19937_64 random(11);
  for (unsigned order = 0; order <= golomb_order_max; ++order)
    for (std::size_t at = 0; at < 16; ++at)
      for (unsigned width = 0; width <= 56; ++width) {
        const std::uint64_t value =
            width == 0 ? 0 : (random() | std::uint64_t{1} << 63) >> (64 - width);
        std::vector<std::byte> bytes;
        {
          BitWriter writer(bytes);
          writer.bits(random() & ((1u << at) - 1), static_cast<unsigned>(at));
          writer.golomb(value, order);
        }
        bytes.resize(bytes.size() + 9);
        for (std::size_t size = (at + 7) / 8; size <= bytes.size();
             ++size) {  // cut off, whole, and with zeros behind
          const Bytes seen = Bytes(bytes).first(size);
          BitReader reader(seen, at);
          std::uint64_t read = 0;
          const bool is_read = reader.golomb(read, order);
          const std::optional<std::uint64_t> expected = golomb_bit_by_bit(seen, at, order);
          ASSERT_EQ(is_read, expected.has_value())
              << "order " << order << ", from bit " << at << ", value " << value << ", " << size
              << " bytes";
          if (is_read) {
            ASSERT_EQ(read, *expected);
            ASSERT_EQ(read, value);
          }
        }
      }
}

}  // namespace
}  // namespace rink::rti::testing
