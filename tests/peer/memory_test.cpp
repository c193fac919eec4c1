// A node takes memory for what it has, not for what is elsewhere.
#include <gtest/gtest.h>

#include <cstdint>
#include <string>

#include "tests/peer/memory_of_nodes.h"

namespace rink::peer::test {
namespace {

TEST(MemoryOfNodes, IsAtFourNodesAtMostTwoFifthsOfOneEngines) {
  if (allocated_bytes() == 0) GTEST_SKIP() << "nobody counts what is allocated here";
  constexpr std::uint32_t count = 40'000;
  constexpr double window = 0.04;
  constexpr int windows = 3;
  const auto gas = [] { return mixed_gas(count, 0.05); };
  const std::uint64_t engine = memory_of_engine(gas, window * windows);
  const physics::World whole = gas();
  std::uint64_t before = ~std::uint64_t{0};
  for (const PeerNumber nodes : {PeerNumber{1}, PeerNumber{2}, PeerNumber{4}}) {
    const NodeMemory memory = memory_of_nodes(whole, nodes, window, windows);
    RecordProperty("share_of_" + std::to_string(nodes), std::to_string(memory.share));
    RecordProperty("copies_of_" + std::to_string(nodes), std::to_string(memory.copies));
    EXPECT_LT(memory.all(), before) << nodes << " nodes";
    before = memory.all();
    if (nodes == 4) {
      EXPECT_LE(memory.all(), 2 * engine / 5)
          << memory.share << " and " << memory.copies << " bytes, where one engine has " << engine;
    }
  }
}

}  // namespace
}  // namespace rink::peer::test
