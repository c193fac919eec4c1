// Lists in words.
#include "game/model/listed.h"

#include <gtest/gtest.h>

#include <vector>

namespace rink::game {
namespace {

TEST(ListInWords, HasCommasBetweenItsItemsAndNoneAtItsEnds) {
  std::vector<std::string> items;
  EXPECT_EQ(listed(items), "");
  items = {"tcp"};
  EXPECT_EQ(listed(items), "tcp");
  items = {"tcp", "udp", "shm"};
  EXPECT_EQ(listed(items), "tcp, udp, shm");
  EXPECT_EQ(listed(items, [](const std::string& word) { return word.substr(1); }), "cp, dp, hm");
}

}  // namespace
}  // namespace rink::game
