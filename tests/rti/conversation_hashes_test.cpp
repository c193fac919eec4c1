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
            (Hashes{0xf7e8aa4cf106ba5eu, 0x3b9c98b524d084c7u, 0xb5719ffc71389c07u,
                    0xe0da44bd09d7ab4du, 0x8dbe0b6a16f33382u, 0x861696199bd63c34u}));
}
TEST(ConversationHashes, OfObjects) {
  EXPECT_EQ(sail({{register_one, update, update, delete_one, name, ask}}),
            (Hashes{0x0b6067d27f5ffc3bu, 0x97dbff3633f3dad5u, 0xaa1df9cc04fee6b1u,
                    0x420555deeaacfa72u, 0xcc611712eb754c33u, 0x81a725223527927cu}));
}
TEST(ConversationHashes, OfInteractions) {
  EXPECT_EQ(sail({{say, say, say, declare}, prepare, 200}),
            (Hashes{0xf2c10f0cd88988b1u, 0x25caa2cb27f1632bu, 0xc7c01ddb5fafb2f1u,
                    0xbe911ad3a79678e1u, 0xa462933994b6ba9au, 0xe50985af71a29ce1u}));
}
TEST(ConversationHashes, OfOwnership) {
  EXPECT_EQ(sail({{trade, trade, trade, trade, register_one, update, declare}}),
            (Hashes{0x75b8c0793b58694eu, 0x33dc48b4d30b4c57u, 0x7f56d0cf803df08fu,
                    0xbf572f0ef7e5a04eu, 0x19bf23e1732b893au, 0x11417c6d330acb8eu}));
}
TEST(ConversationHashes, OfLeaving) {
  EXPECT_EQ(sail({{register_one, trade, trade, update, synchronize, name, watch}, prepare, 12}),
            (Hashes{0x70a448333507e0aau, 0xbefc897ac40bb68fu, 0x1f5d75d6e9b5c96au,
                    0xfc4bb3b8e00c32f2u, 0xd986d1b27f1ea992u, 0x02b0da29225ef4dfu}));
}
TEST(ConversationHashes, OfRegions) {
  EXPECT_EQ(sail({{make_region, use_region, use_region, use_region, register_one, update, say},
                  publish_all,
                  0,
                  0,
                  false,
                  filtered("region")}),
            (Hashes{0x5224a13c5b648b6bu, 0x7e7f322728995027u, 0x4c9f0bbb8cfdbdd2u,
                    0x89208efc0bd83f46u, 0x8a5373891a9c8cbbu, 0x8317c6f4381f0f11u}));
  EXPECT_EQ(sail({{make_region, use_region, use_region, register_one, update, declare, trade},
                  prepare,
                  40,
                  0,
                  false,
                  filtered("region")}),
            (Hashes{0x242af93fc7620d4du, 0x79dfa4419b0a4ae5u, 0xabbe7c0bd5db2cc6u,
                    0x073ae16f0ddf6d95u, 0x82519e8c1e906b67u, 0x186b72298aa337dcu}));
}
TEST(ConversationHashes, OfTiersAndBudgets) {
  const std::vector<Service> services{make_region, use_region, use_region,  use_region,
                                      update,      update,     register_one};
  EXPECT_EQ(sail({services, publish_all, 0, 0, false,
                  filtered("region with tiers(at=0.25 at=0.5 at=0.75)")}),
            (Hashes{0x9d77f247dc41ccecu, 0xc83a0d957468492fu, 0x9234b1ffd92c6b47u,
                    0x0be2a9326c62a956u, 0x1650a7f159041417u, 0x043d655362236fbcu}));
  EXPECT_EQ(
      sail({services, publish_all, 60, 300, true, filtered("region with priority(budget=60)")}),
      (Hashes{0x246f16e536c28a0au, 0x4e1d74b9bc288720u, 0x3f3374ec80aae2d4u, 0x6b727bb79c6f4d35u,
              0x7e0b487c292b3398u, 0x4403116967606c4du}));
}
TEST(ConversationHashes, OfTimeManagement) {
  const std::vector<Service> services{keep_time,   keep_time,    keep_time,  say_in_time,
                                      say_in_time, register_one, delete_one, update};
  EXPECT_EQ(sail({services}),
            (Hashes{0xd02d49e6c0731df0u, 0x0bd8d75775714305u, 0x8ce6ccd4c40ce77bu,
                    0x1ae1f722095c4d5fu, 0xe3363966a53ebe64u, 0xa2393d8320b3440fu}));
  EXPECT_EQ(sail({services, prepare, 40}),
            (Hashes{0x1759f31c01c4d14du, 0xef725537d6884a6au, 0x7afb403f46863ed5u,
                    0xfb5117485c28fddbu, 0x418c219a58cfd219u, 0x374365743bb0c250u}));
}
TEST(ConversationHashes, OfTimeManagementAmongChangingOwners) {
  EXPECT_EQ(sail({{keep_time, keep_time, say_in_time, register_one, trade, trade, declare, say},
                  prepare,
                  60}),
            (Hashes{0x63cdd3a734f292ceu, 0xea358c0b68378503u, 0xfc47f2bd984336e0u,
                    0x476ab9357c32d03eu, 0x8a8b27b102a0736cu, 0xc644cecc980a1887u}));
}
TEST(ConversationHashes, OfBestEffort) {
  const std::vector<Service> services{register_one, update,    update,     update,
                                      update,       transport, delete_one, say};
  EXPECT_EQ(sail({services, prepare, 0, 400}),
            (Hashes{0xb8a80ce1ae0cbb8au, 0x3771bca7ce797bd8u, 0x6ad5ed99f111d272u,
                    0x6fd53fbdbfb40ec4u, 0xe4e3f3fd92d7250du, 0x734c49df75676f23u}));
  EXPECT_EQ(sail({services, prepare, 30, 300}),
            (Hashes{0x3fe3b17c84085b68u, 0x506aab52c34b1c87u, 0xe8319fc6f457d26bu,
                    0x3112a1e445605891u, 0xf6440db4f79a3dedu, 0xcc6dba0f50661930u}));
}
TEST(ConversationHashes, OfManagement) {
  EXPECT_EQ(sail({{manage, manage, declare, register_one, update, say, synchronize}}),
            (Hashes{0x54f92f8f22decccau, 0x15f32693f1ccafdbu, 0x5292797cca6f6778u,
                    0x2e2688601eb09851u, 0x6bcd0b484a741051u, 0xbbc9553927b8a7a8u}));
  EXPECT_EQ(sail({{manage, manage, manage, register_one, keep_time, trade, watch}, prepare, 25}),
            (Hashes{0x9c1ee8e1739fda1au, 0x36e8ec42b96c209eu, 0x5e2854cf257cb02cu,
                    0xfc554189e0ce4a9cu, 0x48f0f79674969296u, 0xce0e3584e03d8eedu}));
}
TEST(ConversationHashes, OfThoseWhoDoNotRead) {
  EXPECT_EQ(sail({{register_one, update, update, delete_one, ask, say}, prepare, 50, 0, true}),
            (Hashes{0xd8f80c626a72af14u, 0xeb87ba5472920b58u, 0x42b9d09a327f6c91u,
                    0x7b485a0943a8fda0u, 0xb400f1b88e23a1ecu, 0x93b117b4f93c6af0u}));
}
TEST(ConversationHashes, OfLittleRoom) {
  EXPECT_EQ(sail({{register_one, register_one, update, update, say, delete_one},
                  prepare,
                  80,
                  0,
                  true,
                  cramped()}),
            (Hashes{0x56cdf00003f88e9eu, 0x939a2b8a258cd4c9u, 0x81cf6bf7bef88402u,
                    0x6589d1263cca57c8u, 0xf972ca88ec7c0967u, 0x7c40f2329ce63355u}));
  EXPECT_EQ(sail({{register_one, update, keep_time, keep_time, say_in_time, say_in_time},
                  prepare,
                  80,
                  0,
                  false,
                  cramped()}),
            (Hashes{0x89fbd4be0852c24eu, 0xedd9e78d44ea886du, 0xea2a501ff35ad045u,
                    0xa19c73a5ee09977eu, 0x0f8ddcf6e1701565u, 0x9b574bf04536e96eu}));
}
TEST(ConversationHashes, OfEverythingAtOnce) {
  const std::vector<Service> services{declare,     register_one, update,     update,    say,
                                      delete_one,  ask,          name,       transport, trade,
                                      trade,       make_region,  use_region, keep_time, say_in_time,
                                      synchronize, manage,       watch};
  for (const auto& [seed, hashes] : std::vector<std::pair<std::uint64_t, Hashes>>{
           {1,
            {0xacbbba4544ab41f2u, 0xa2fd266cac8226cau, 0x2bdffd8b1a0a1903u, 0xfd88d398f400346cu,
             0xea71af745a2a67c3u, 0x43b0bddbcfff610fu}},
           {2,
            {0x6c48637f81ad570fu, 0x1b99900e5898d073u, 0xb30310f74683b412u, 0xc112f27de0aecb8bu,
             0x4c8e252e6972be5eu, 0xe89f8a0455ccf3acu}},
           {3,
            {0x682ecb71c52f8e22u, 0xe2339f7e1a10abbfu, 0xfc1434f5f1522e6fu, 0xa628d88efa451b4cu,
             0x2fba275b08bef118u, 0x0883cfc8e188893du}},
           {4,
            {0x7d7a870ea0048b96u, 0x933c142292d6cf61u, 0x510d6de19915eb41u, 0x9e50ba4d6ad0fcf0u,
             0xd7fc9a73643d119eu, 0x34269442c90f6016u}}})
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
