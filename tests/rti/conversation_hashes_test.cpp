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
            (Hashes{0xab93e7de1004a303u, 0x253a1678bf576032u, 0x5cb6e9c791504233u,
                    0x897a70500fc55908u, 0x7e248c427f978138u, 0x841d5949877e48deu}));
}
TEST(ConversationHashes, OfObjects) {
  EXPECT_EQ(sail({{register_one, update, update, delete_one, name, ask}}),
            (Hashes{0x1490d3ca960cbc7au, 0x19776ed82b47a944u, 0x4f2b901167537511u,
                    0x4433b062cce2b1beu, 0x30dfb672c274f399u, 0xc6751100402aff49u}));
}
TEST(ConversationHashes, OfInteractions) {
  EXPECT_EQ(sail({{say, say, say, declare}, prepare, 200}),
            (Hashes{0x2362cea9a3a41541u, 0x4134f653de943cebu, 0x855b474e8cf9b921u,
                    0x1ab2cdda4a66ad49u, 0x0f2bcc91e301b81au, 0xd2b1c8fc414dcd25u}));
}
TEST(ConversationHashes, OfOwnership) {
  EXPECT_EQ(sail({{trade, trade, trade, trade, register_one, update, declare}}),
            (Hashes{0x7eac0203f477e686u, 0x4fd2c265053f429du, 0x95f548e89884668fu,
                    0xc4bfa1610532c4f4u, 0x88c369884cd95139u, 0xfe45c7a1a3c095c9u}));
}
TEST(ConversationHashes, OfLeaving) {
  EXPECT_EQ(sail({{register_one, trade, trade, update, synchronize, name, watch}, prepare, 12}),
            (Hashes{0x32460b1b678fb8a6u, 0xcc003bed9c8b68ebu, 0x96aec55b613c817cu,
                    0x9ce34e02bf18e752u, 0x288f40d16d4417acu, 0xf11dcd621763949du}));
}
TEST(ConversationHashes, OfRegions) {
  EXPECT_EQ(sail({{make_region, use_region, use_region, use_region, register_one, update, say},
                  publish_all,
                  0,
                  0,
                  false,
                  filtered("region")}),
            (Hashes{0x3f2ee3fa28b6c12du, 0xd166546a3914809eu, 0x959c1c1aad8a31f9u,
                    0x6b79114215e992eau, 0xf4a0de0e905b131bu, 0x92405489a46aa7e2u}));
  EXPECT_EQ(sail({{make_region, use_region, use_region, register_one, update, declare, trade},
                  prepare,
                  40,
                  0,
                  false,
                  filtered("region")}),
            (Hashes{0x66b559d8e0bcc567u, 0x7a2f1179d2b85359u, 0xdb6c574a727f6979u,
                    0x844bda231d020b39u, 0x1051e6c8d99d1237u, 0x3254b36d64b9afc7u}));
}
TEST(ConversationHashes, OfTiersAndBudgets) {
  const std::vector<Service> services{make_region, use_region, use_region,  use_region,
                                      update,      update,     register_one};
  EXPECT_EQ(sail({services, publish_all, 0, 0, false,
                  filtered("region with tiers(at=0.25 at=0.5 at=0.75)")}),
            (Hashes{0xc3f136210129c686u, 0xb8a983e546c325c7u, 0x59495408e6020b1eu,
                    0x35b1b0c70374fe3eu, 0xa2831d96c65f9501u, 0xe64a2a42c46f032fu}));
  EXPECT_EQ(
      sail({services, publish_all, 60, 300, true, filtered("region with priority(budget=60)")}),
      (Hashes{0xbf65759b33cd8f39u, 0xbeb187a88619b904u, 0x703a5a8678a4620eu, 0x1ca4906d395d6364u,
              0x10360f12c942fdb7u, 0xc38b8e8574cedc25u}));
}
TEST(ConversationHashes, OfTimeManagement) {
  const std::vector<Service> services{keep_time,   keep_time,    keep_time,  say_in_time,
                                      say_in_time, register_one, delete_one, update};
  EXPECT_EQ(sail({services}),
            (Hashes{0x54e2c3330402d212u, 0xdeec4fe2a47e6d8au, 0x7168007aebb70ad6u,
                    0xb2b4c3abd320626au, 0x959dd7a2f584a869u, 0xbd07c51fbdfbc4bfu}));
  EXPECT_EQ(sail({services, prepare, 40}),
            (Hashes{0x0681e61dde310261u, 0x826b69a6d1fea98eu, 0x363e2240295666f0u,
                    0x19a651b8d12833f1u, 0x536f563af8b733edu, 0x381e0cf2315bdebdu}));
}
TEST(ConversationHashes, OfTimeManagementAmongChangingOwners) {
  EXPECT_EQ(sail({{keep_time, keep_time, say_in_time, register_one, trade, trade, declare, say},
                  prepare,
                  60}),
            (Hashes{0x9c7667c104bf226eu, 0x2b8a399ae6cd03ecu, 0x03791f281d9ae52eu,
                    0x3689de02f9d12d26u, 0x8fbcf5384a8e9ff0u, 0x9c18ee47e72808e5u}));
}
TEST(ConversationHashes, OfBestEffort) {
  const std::vector<Service> services{register_one, update,    update,     update,
                                      update,       transport, delete_one, say};
  EXPECT_EQ(sail({services, prepare, 0, 400}),
            (Hashes{0x016ae13e5ef0861fu, 0x1073b2a05df952ceu, 0xd497f05e40ffefc3u,
                    0x796fde992f2804f1u, 0x19a932f8801d3730u, 0xc90aa308e1094e6eu}));
  EXPECT_EQ(sail({services, prepare, 30, 300}),
            (Hashes{0x80a940b667f05e4au, 0xec4b6df4cab7f18bu, 0xf304baaeda33de15u,
                    0x2093647b6ba35770u, 0x48788ea64c74a41au, 0xdf2f98bf02053741u}));
}
TEST(ConversationHashes, OfManagement) {
  EXPECT_EQ(sail({{manage, manage, declare, register_one, update, say, synchronize}}),
            (Hashes{0x5d42519c96571d40u, 0xeb69f0229c277084u, 0x5e9f916dab748008u,
                    0x7a85e1bd128c761bu, 0x10d352afd201acdcu, 0xbb1739f5d89848f3u}));
  EXPECT_EQ(sail({{manage, manage, manage, register_one, keep_time, trade, watch}, prepare, 25}),
            (Hashes{0xae9c8c2b7f61bc23u, 0x662a036f14fdb23au, 0x5f207ae48e5a07d1u,
                    0x856946381d726a7au, 0x0ba4421ef79baf47u, 0x6b0536b588c261bcu}));
}
TEST(ConversationHashes, OfThoseWhoDoNotRead) {
  EXPECT_EQ(sail({{register_one, update, update, delete_one, ask, say}, prepare, 50, 0, true}),
            (Hashes{0x872e46956b150e25u, 0x37c5768706126710u, 0x91ab23bde6d75a55u,
                    0xf6deb31cb9fb3d94u, 0x2501e3a30ede1e97u, 0x5bcdf87e23f4be23u}));
}
TEST(ConversationHashes, OfLittleRoom) {
  EXPECT_EQ(sail({{register_one, register_one, update, update, say, delete_one},
                  prepare,
                  80,
                  0,
                  true,
                  cramped()}),
            (Hashes{0x25575aa8990af24du, 0x7ed0b2f4cb708a37u, 0x916e6c9cbc2f8d8eu,
                    0xcc6e791a84408654u, 0xa66a766d1332d5dbu, 0xc48f338e0c5fd9b4u}));
  EXPECT_EQ(sail({{register_one, update, keep_time, keep_time, say_in_time, say_in_time},
                  prepare,
                  80,
                  0,
                  false,
                  cramped()}),
            (Hashes{0x6c8438cacd50e899u, 0x9c72666d9cedaff1u, 0xa248288c7c04a07eu,
                    0x68e473d4b9f13cc6u, 0xcb05232e4c71893bu, 0xd07a128d072255e0u}));
}
TEST(ConversationHashes, OfEverythingAtOnce) {
  const std::vector<Service> services{declare,     register_one, update,     update,    say,
                                      delete_one,  ask,          name,       transport, trade,
                                      trade,       make_region,  use_region, keep_time, say_in_time,
                                      synchronize, manage,       watch};
  for (const auto& [seed, hashes] : std::vector<std::pair<std::uint64_t, Hashes>>{
           {1,
            {0x841cc9c101fddd02u, 0x3b341da9d9768a3eu, 0x15d933a266928cebu, 0xb9fee3798d5bc5afu,
             0xe3e3d00f33e354aeu, 0x3cef657a956b34a5u}},
           {2,
            {0x185f8f089dd21059u, 0xf79714ec727e4056u, 0x701de9470b17ac61u, 0x399f72f73d11a77fu,
             0xe353cf1164c7f57cu, 0xabae7166e7dff62du}},
           {3,
            {0x24b6d17c8e328774u, 0x0acfb54322b80ae8u, 0x4294cb421711e1e7u, 0x3b0deea778ec73cau,
             0x186ffc625472edc3u, 0x57bb7343a0c4aa8au}},
           {4,
            {0x2b4f83a07caf6823u, 0xea19ea8b61fc6c15u, 0xda973019b5475269u, 0x8b12d301c92883b8u,
             0x1f922f81551ac1b8u, 0xd9c76bb4c4477374u}}})
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
  EXPECT_EQ(all.hashes(), (Hashes{0x890d711bbba7f31cu, 0x82b0f7f97dcc63ceu, 0x6bb11cbda2412affu,
                                  0xfbc5acc89b2a9dbbu}));
}

}  // namespace
}  // namespace rink::rti::testing::at_the_regatta
