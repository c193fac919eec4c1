// What others say of places: numbers that are none are refused where they are read, for all that
// follows counts on numbers.
#include "game/replication/attributes.h"

#include <gtest/gtest.h>

#include <cstring>
#include <limits>

namespace rink::game {
namespace {

/// As a stranger writes it, who asserts nothing.
template <class... Floats>
std::vector<std::byte> bytes_of(Floats... numbers) {
  std::vector<std::byte> bytes;
  for (const float number : {numbers...}) {
    bytes.resize(bytes.size() + sizeof number);
    std::memcpy(bytes.data() + bytes.size() - sizeof number, &number, sizeof number);
  }
  return bytes;
}

template <class Value>
bool is_taken(const std::vector<std::byte>& bytes) {
  Value value;
  return decode(bytes, value);
}

std::vector<std::byte> after(std::vector<std::byte> head, const std::vector<std::byte>& bytes) {
  head.insert(head.end(), bytes.begin(), bytes.end());
  return head;
}

TEST(Attributes, OfPlacesAreNumbers) {
  const std::vector<std::byte> bat(4), kind_and_team(2), no_strengths(16);
  EXPECT_TRUE(is_taken<Position>(bytes_of(-1.0f, 2.0f)));
  EXPECT_TRUE(is_taken<SeatOffer>(after(bat, bytes_of(-1.0f, 2.0f))));
  EXPECT_TRUE(is_taken<Extent>(bytes_of(1.0f, 2.0f)));
  const auto shape = [&](const std::vector<std::byte>& halves) {
    return after(after(kind_and_team, halves), no_strengths);
  };
  EXPECT_TRUE(is_taken<Shape>(shape(bytes_of(0.0f, 0.1f))));
  constexpr float infinity = std::numeric_limits<float>::infinity();
  for (const float none : {std::numeric_limits<float>::quiet_NaN(), infinity, -infinity})
    for (const auto& bytes : {bytes_of(1.0f, none), bytes_of(none, 1.0f)}) {
      EXPECT_FALSE(is_taken<Position>(bytes)) << none;
      EXPECT_FALSE(is_taken<SeatOffer>(after(bat, bytes))) << none;
      EXPECT_FALSE(is_taken<Extent>(bytes)) << none;
      EXPECT_FALSE(is_taken<Shape>(shape(bytes))) << none;
    }
}

TEST(Attributes, OfAFieldHaveNoSideBelow0) {
  EXPECT_FALSE(is_taken<Extent>(bytes_of(1.0f, -2.0f)));
  EXPECT_FALSE(is_taken<Extent>(bytes_of(-1.0f, 2.0f)));
}

}  // namespace
}  // namespace rink::game
