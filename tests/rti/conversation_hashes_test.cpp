// Whole conversations, held by hashes of every byte that each federate is sent: who changes how a
// federation works finds out here that the wire, or the order of what is said, has changed as well.
#include <gtest/gtest.h>

#include <utility>
#include <vector>

#include "rti/wire/membership_messages.h"
#include "tests/rti/scenes/regatta_courses.h"

namespace rink::rti::testing::at_the_regatta {
namespace {

using Hashes = std::vector<std::uint64_t>;

/// The hashes by seat, and that of the counters.
Hashes sail(const Course& course, std::uint64_t seed = 1) {
  Regatta all(seed, seat_count, course.settings);
  sail(all, course);
  return all.hashes();
}

TEST(ConversationHashes, OfDeclarations) {
  EXPECT_EQ(sail({{declare, declare, declare, register_one, update, say}, stand_by}),
            (Hashes{0x389a6f3ad939a045u, 0x607282f60a9eb8cfu, 0x244f55c920508e6eu,
                    0xf23516c6564a5284u, 0x1b12f140e8d4be7du, 0x9f625bde6da761b5u}));
}
TEST(ConversationHashes, OfObjects) {
  EXPECT_EQ(sail({{register_one, update, update, delete_one, name, ask}}),
            (Hashes{0x195256915bc282c6u, 0x1c4a5019b840479du, 0x30e7e75a376a9d2fu,
                    0xa764d4f40ca04996u, 0xcf1ca215292a85a7u, 0xf1570c8395cc9bf9u}));
}
TEST(ConversationHashes, OfInteractions) {
  EXPECT_EQ(sail({{say, say, say, declare}, prepare, 200}),
            (Hashes{0xf2c10f0cd88988b1u, 0x25caa2cb27f1632bu, 0xc7c01ddb5fafb2f1u,
                    0xbe911ad3a79678e1u, 0xa462933994b6ba9au, 0xe50985af71a29ce1u}));
}
TEST(ConversationHashes, OfOwnership) {
  EXPECT_EQ(sail({{trade, trade, trade, trade, register_one, update, declare}}),
            (Hashes{0x7755c8d5200898a3u, 0xd71f2b5840f2f8f8u, 0x4dae20759e5b9fccu,
                    0x77aea44d981c6e15u, 0x3913b95b3269dd0au, 0x63f72bc8587c8f82u}));
}
TEST(ConversationHashes, OfLeaving) {
  EXPECT_EQ(sail({{register_one, trade, trade, update, synchronize, name, watch}, prepare, 12}),
            (Hashes{0x8538526d46099579u, 0x3066488ab898d647u, 0x18874b94de04e629u,
                    0xb4cb08afba614ed9u, 0x80e917ecf75f5013u, 0xfa5363e80714355fu}));
}
TEST(ConversationHashes, OfRegions) {
  EXPECT_EQ(sail({{make_region, use_region, use_region, use_region, register_one, update, say},
                  publish_all,
                  0,
                  0,
                  false,
                  filtered("region")}),
            (Hashes{0x7618889c117f2c99u, 0x1725cad23688443fu, 0xc3471bf35763c0a9u,
                    0xa09dbaf36e99b9e8u, 0x3c23386b8e646deeu, 0x9bbdfe1e23a2f609u}));
  EXPECT_EQ(sail({{make_region, use_region, use_region, register_one, update, declare, trade},
                  prepare,
                  40,
                  0,
                  false,
                  filtered("region")}),
            (Hashes{0xd3387f56cfafb8b4u, 0xba4cb7f922f47fe0u, 0xb857abae09c9ca20u,
                    0xaf1d2d2e8ca33c5cu, 0xc63c957f62fb7065u, 0x0731b63d5f41a27fu}));
}
TEST(ConversationHashes, OfTiersAndBudgets) {
  const std::vector<Service> services{make_region, use_region, use_region,  use_region,
                                      update,      update,     register_one};
  EXPECT_EQ(sail({services, publish_all, 0, 0, false,
                  filtered("region with tiers(at=0.25 at=0.5 at=0.75)")}),
            (Hashes{0x9c57af9964aea61eu, 0x0b3c88a1cf3cc0a9u, 0x05baf9d95dcaef41u,
                    0x4a8ce16ff55e82f5u, 0xd9a0fe8a1923d5a3u, 0xde780b39e82623c0u}));
  EXPECT_EQ(
      sail({services, publish_all, 60, 300, true, filtered("region with priority(budget=60)")}),
      (Hashes{0x953a06dc3838a5bfu, 0xde4fd5ee7fa556bfu, 0x164349490e27fd1cu, 0x8f3c608c9d196547u,
              0x1dc1422f6ee63c83u, 0x3578073de9bfe9e5u}));
}
TEST(ConversationHashes, OfTimeManagement) {
  const std::vector<Service> services{keep_time,   keep_time,    keep_time,  say_in_time,
                                      say_in_time, register_one, delete_one, update};
  EXPECT_EQ(sail({services}),
            (Hashes{0x026c2599f25875a3u, 0x87a7c7386213c06du, 0xac10f68445e061a2u,
                    0x7cd99312c6b15fd4u, 0x53ba515c14330c1du, 0x92591cee9a1fb651u}));
  EXPECT_EQ(sail({services, prepare, 40}),
            (Hashes{0x7246619aafcb8ab0u, 0xbd720db9689d1c9du, 0x60928e945bcca5e9u,
                    0x6c71e552875b5a72u, 0xdd8e6581a851623du, 0x5bea30f49e370f28u}));
}
TEST(ConversationHashes, OfTimeManagementAmongChangingOwners) {
  EXPECT_EQ(sail({{keep_time, keep_time, say_in_time, register_one, trade, trade, declare, say},
                  prepare,
                  60}),
            (Hashes{0x7ce69465b96198b0u, 0xfedd4f3a086d7c27u, 0x555ea86dd451410cu,
                    0xd3f5fe36cf132401u, 0x0fb6e73cc40e80e6u, 0x5f04d77dba86f03fu}));
}
TEST(ConversationHashes, OfBestEffort) {
  const std::vector<Service> services{register_one, update,    update,     update,
                                      update,       transport, delete_one, say};
  EXPECT_EQ(sail({services, prepare, 0, 400}),
            (Hashes{0x03af734d124b99c4u, 0x2f93bcee4cb2e690u, 0x40fa9516dbe3db68u,
                    0x87f897d23ca8bde8u, 0xa435a08d44d92955u, 0x372a7424d3d43bcbu}));
  EXPECT_EQ(sail({services, prepare, 30, 300}),
            (Hashes{0xac2188ffd47b68f7u, 0xebbda14f3a886ce7u, 0x3733bceeaefbf51fu,
                    0x3a5a734689754874u, 0x5fe66e60fbed2495u, 0xb967ae27cd5ac082u}));
}
TEST(ConversationHashes, OfManagement) {
  EXPECT_EQ(sail({{manage, manage, declare, register_one, update, say, synchronize}}),
            (Hashes{0x641902192796a44fu, 0xf6221f6bd85c5c01u, 0x755bd14e456c9d1eu,
                    0xaa76c9841e12cfbdu, 0xd21ee889b82582b9u, 0xfe8adf9741c42401u}));
  EXPECT_EQ(sail({{manage, manage, manage, register_one, keep_time, trade, watch}, prepare, 25}),
            (Hashes{0xdfc1edf152a17984u, 0xde9f1b31e5355214u, 0x4509be24f7625937u,
                    0x100f4d7bb825002fu, 0x5d8c72cfa50ac1c5u, 0xcb3542129e82dbccu}));
}
TEST(ConversationHashes, OfThoseWhoDoNotRead) {
  EXPECT_EQ(sail({{register_one, update, update, delete_one, ask, say}, prepare, 50, 0, true}),
            (Hashes{0x7c637786155e41e1u, 0x9ef5870f4354d2eeu, 0x94612125d5a756d0u,
                    0x10421c1a2f6dde08u, 0xf028c485db9d5230u, 0x36668c316948da3fu}));
}
TEST(ConversationHashes, OfLittleRoom) {
  EXPECT_EQ(sail({{register_one, register_one, update, update, say, delete_one},
                  prepare,
                  80,
                  0,
                  true,
                  cramped()}),
            (Hashes{0x0aec0bb078bafa87u, 0xe607f3b892772a6fu, 0x719ee0b4c0b3c816u,
                    0xe254b0dbff5f1d5eu, 0x2a8f01f9cf204dc6u, 0x0a1fb77d9c966adfu}));
  EXPECT_EQ(sail({{register_one, update, keep_time, keep_time, say_in_time, say_in_time},
                  prepare,
                  80,
                  0,
                  false,
                  cramped()}),
            (Hashes{0x1fc85a87e2e991deu, 0x0176b3aad843fd00u, 0xb0b119916030e205u,
                    0x79fde44b1b85638bu, 0x12b9ad3453da67fau, 0x328912d09a741565u}));
}
TEST(ConversationHashes, OfEverythingAtOnce) {
  const std::vector<Service> services{declare,     register_one, update,     update,    say,
                                      delete_one,  ask,          name,       transport, trade,
                                      trade,       make_region,  use_region, keep_time, say_in_time,
                                      synchronize, manage,       watch};
  for (const auto& [seed, hashes] : std::vector<std::pair<std::uint64_t, Hashes>>{
           {1,
            {0x2a4c008f1d2c2b6fu, 0x96b8040567912796u, 0xdd91582ab9a5fe19u, 0x9afbd18b4947f91bu,
             0x5cac7215d190845du, 0xc185f7cbd98a04c5u}},
           {2,
            {0x0bca58e2d05a0574u, 0x9e86563e8ad8c2cfu, 0xbfcda54deae6e1e9u, 0x9c0cc807c8479c10u,
             0x72db07bd7618d8f0u, 0x39b203949a96463au}},
           {3,
            {0xb9b229d2d2227346u, 0xe7da8aee0a40e138u, 0x733d01c71a9aa38au, 0x9e9c0747f5692217u,
             0xcd40ee042c1a7023u, 0x4d52ecd13d1ce924u}},
           {4,
            {0x97682c58abb40484u, 0x8021f8a9d0af3452u, 0x0f1593648c47264eu, 0x6a7caa1b48615c03u,
             0xd63771d59fd2106eu, 0x35fbac6228aa0a25u}}})
    EXPECT_EQ(sail({services, prepare, 60, 350, true, filtered("region")}, seed), hashes) << seed;
}

/// Those who have not joined ask and are answered, whoever speaks nonsense goes.
TEST(ConversationHashes, OfStrangers) {
  Regatta all(7, 3);
  for (int round = 0; round < 60; ++round) {
    const std::size_t seat = all.below(3);
    Sailor& sailor = all.sailor(seat);
    if (sailor.is_lost) {
      all.enter(seat);
    } else if (all.one_in(3)) {
      const auto noise = std::array{std::byte{3},
                                    std::byte{0},
                                    std::byte{0},
                                    std::byte{0},
                                    static_cast<std::byte>(all.below(64)),
                                    std::byte{1},
                                    std::byte{2}};
      all.execution.receive(sailor.connection, noise);
    }
    const ConnectionId stranger = all.admit_stranger(seat);
    Recorder deaf;
    Ambassador asking(regatta(), deaf);
    if (all.one_in(2)) asking.list_federation_executions();
    if (all.one_in(2)) asking.create_federation_execution(all.one_in(2) ? "rink" : "other");
    if (all.one_in(2)) asking.query_management();
    if (all.one_in(2)) asking.join(all.one_in(2) ? "rink" : "other", "sailor 1", "tester");
    all.execution.receive(stranger, asking.outgoing());
    all.tick();
    all.execution.disconnect(stranger, "gone");
  }
  EXPECT_EQ(all.hashes(), (Hashes{0xa9b74c401c63ddb2u, 0x5b66414b963b956cu, 0x6c476a250e3a936du,
                                  0xcecba5e02f2f71efu}));
}

}  // namespace
}  // namespace rink::rti::testing::at_the_regatta
