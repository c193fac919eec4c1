// One function writes, reads and measures a record: the three agree, and readers refuse what no
// writer makes.
#include <gtest/gtest.h>

#include <array>
#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

#include "im/basics/byte_stream.h"

namespace rink {
namespace {

enum class Side : std::uint8_t { left, right };

struct Record {
  std::uint32_t number = 0;
  double place = 0.0;
  float extent = 0.0f;
  Side side = Side::left;
  bool is_there = false;
  std::uint64_t count = 0;
  std::vector<std::uint16_t> list{};
  std::string_view name{};
  bool operator==(const Record&) const = default;
};

template <class Stream>
bool exchange(Stream& stream, Record& record) {
  return stream.numbers(record.number, record.place, record.extent) &&
         stream.choice(record.side, Side::right) && stream.truth(record.is_there) &&
         stream.varint(record.count) && stream.number_list(record.list) &&
         stream.text(record.name, 20);
}

Record some_record() {
  return {.number = 0x04030201,
          .place = -1.5,
          .extent = 0.25f,
          .side = Side::right,
          .is_there = true,
          .count = 300,
          .list = {7, 0xffff},
          .name = "goal"};
}

template <class Buffer>
Buffer written(Record record) {
  Buffer bytes;
  ByteWriter writer(bytes);
  EXPECT_TRUE(exchange(writer, record));
  return bytes;
}

TEST(ByteStream, WritesTheSameBytesOnEveryMachine) {
  const std::vector<std::uint8_t> expected{1, 2,   3,    4,                        // number
                                           0, 0,   0,    0,    0,  0, 0xf8, 0xbf,  // place
                                           0, 0,   0x80, 0x3e,                     // extent
                                           1, 1,   0xac, 2,  // side, is_there, count
                                           2, 0,   0,    0,    7,  0, 0xff, 0xff,  // list
                                           4, 'g', 'o',  'a',  'l'};
  EXPECT_EQ(written<std::vector<std::uint8_t>>(some_record()), expected);
}

TEST(ByteStream, ReadsWhatItWroteAndMeasuresItsLength) {
  const auto bytes = written<std::vector<std::byte>>(some_record());
  Record record = some_record(), received;
  ByteMeasurer measurer;
  ASSERT_TRUE(exchange(measurer, record));
  EXPECT_EQ(measurer.size(), bytes.size());
  ByteReader reader(bytes);
  ASSERT_TRUE(exchange(reader, received));
  EXPECT_TRUE(reader.is_at_end());
  EXPECT_EQ(received, record);
}

TEST(ByteStream, RefusesWhatIsCutOff) {
  const auto bytes = written<std::vector<std::byte>>(some_record());
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    ByteReader reader(std::span<const std::byte>(bytes).first(size));
    Record received;
    EXPECT_FALSE(exchange(reader, received)) << size;
  }
}

/// Whether `read` takes the bytes.
template <class Read>
bool takes(std::initializer_list<unsigned> numbers, Read read) {
  std::vector<std::byte> bytes;
  for (const unsigned number : numbers) bytes.push_back(static_cast<std::byte>(number));
  ByteReader reader(bytes);
  return read(reader);
}

TEST(ByteStream, RefusesWhatIsOutOfRange) {
  const auto truth = [](ByteReader& reader) {
    bool value = false;
    return reader.truth(value);
  };
  EXPECT_TRUE(takes({1}, truth));
  EXPECT_FALSE(takes({2}, truth));
  const auto side = [](ByteReader& reader) {
    Side side{};
    return reader.choice(side, Side::right);
  };
  EXPECT_TRUE(takes({1}, side));
  EXPECT_FALSE(takes({2}, side));
  const auto name = [](ByteReader& reader) {
    std::string_view name;
    return reader.text(name, 1);
  };
  EXPECT_TRUE(takes({1, 'x'}, name));
  EXPECT_FALSE(takes({2, 'x', 'y'}, name));
  const auto finite = [](ByteReader& reader) {
    double value = 0.0;
    return reader.finite(value);
  };
  EXPECT_TRUE(takes({0, 0, 0, 0, 0, 0, 0xef, 0x7f}, finite));
  EXPECT_FALSE(takes({0, 0, 0, 0, 0, 0, 0xf0, 0x7f}, finite));
}

/// A damaged length would claim memory for four thousand million items.
TEST(ByteStream, TakesNoListThatIsLongerThanWhatIsLeft) {
  const auto list = [](ByteReader& reader) {
    std::vector<std::array<char, 4096>> list;
    return reader.size(list);
  };
  EXPECT_TRUE(takes({2, 0, 0, 0, 'x', 'y'}, list));
  EXPECT_FALSE(takes({3, 0, 0, 0, 'x', 'y'}, list));
  EXPECT_FALSE(takes({255, 255, 255, 255, 'x', 'y'}, list));
  const auto short_list = [](ByteReader& reader) {
    std::string list;
    return reader.short_size(list);
  };
  EXPECT_TRUE(takes({2, 'x', 'y'}, short_list));
  EXPECT_FALSE(takes({3, 'x', 'y'}, short_list));
}

}  // namespace
}  // namespace rink
