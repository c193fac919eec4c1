// The page's example of a message of the policy "exact" is what the sender writes.
#include <gtest/gtest.h>

#include <array>
#include <string>
#include <vector>

#include "game/replication/exact/exact_messages.h"
#include "tests/places.h"
#include "tests/temporary_folder.h"

namespace rink::game {
namespace {

TEST(WirePage, ShowsAKeyOfTheSecondOfThreeBatsAsItIsSent) {
  ExactStart start;
  start.tick_s = 0.05;
  ExactTick tick;
  tick.time = 1.0 + start.tick_s, tick.tag = 1'050'000'000;
  tick.keys = {{.time = 1.03125, .bat = 1, .before = {}, .after = {1, 0}}};
  const ExactContext context{.time = 1.0, .tag = 1'000'000'000, .start = &start, .bats = 3};
  std::vector<std::byte> bytes;
  std::vector<Drive> drives(3);
  {
    rti::BitWriter bits(bytes);
    ASSERT_TRUE(exact::exchange(bits, tick, context, drives));
  }
  std::string hex = "`";
  for (const std::byte each : bytes)
    for (const unsigned half :
         {std::to_integer<unsigned>(each) >> 4, std::to_integer<unsigned>(each) & 15u})
      hex += "0123456789abcdef"[half];
  const std::string page = test::text_of(test::source_folder() + "/docs/wire.md");
  EXPECT_NE(page.find(hex + "`"), std::string::npos) << hex;
}

}  // namespace
}  // namespace rink::game
