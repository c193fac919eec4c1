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
            (Hashes{0x963372a6b5f65b67u, 0xc7252664c58b9fefu, 0xde165ed1bd644377u,
                    0x5d44ca3ea4b90cfdu, 0x39506b6a4e7faa59u, 0x1d5f77c21dbbac5eu}));
}
TEST(ConversationHashes, OfObjects) {
  EXPECT_EQ(sail({{register_one, update, update, delete_one, name, ask}}),
            (Hashes{0x78e561668e9e66f3u, 0x32d378f3796b3e98u, 0x41691d88b98f01e0u,
                    0x708676a37a1e7cdeu, 0x48d6c9a3ea4379f9u, 0x35322ae7074bdac2u}));
}
TEST(ConversationHashes, OfInteractions) {
  EXPECT_EQ(sail({{say, say, say, declare}, prepare, 200}),
            (Hashes{0xf2c10f0cd88988b1u, 0x25caa2cb27f1632bu, 0xc7c01ddb5fafb2f1u,
                    0xbe911ad3a79678e1u, 0xa462933994b6ba9au, 0xe50985af71a29ce1u}));
}
TEST(ConversationHashes, OfOwnership) {
  EXPECT_EQ(sail({{trade, trade, trade, trade, register_one, update, declare}}),
            (Hashes{0x9e1fb5c7105526a6u, 0x3c7240a2a6d6ded2u, 0x5de2db5b4351ec9du,
                    0x0fddd5a4edba4712u, 0x92e3ffbee00117b9u, 0x5ce77dcaf48c100du}));
}
TEST(ConversationHashes, OfLeaving) {
  EXPECT_EQ(sail({{register_one, trade, trade, update, synchronize, name, watch}, prepare, 12}),
            (Hashes{0x57b3259c3bbb01cdu, 0xc0c21552b32f9373u, 0x6eed399abdbfe525u,
                    0x3266c7efd5a1b4e5u, 0x6d2cb1bb3226fd3du, 0xc62902517c9f7807u}));
}
TEST(ConversationHashes, OfRegions) {
  EXPECT_EQ(sail({{make_region, use_region, use_region, use_region, register_one, update, say},
                  publish_all,
                  0,
                  0,
                  false,
                  filtered("region")}),
            (Hashes{0x7c9e74d7d0141d78u, 0x76a26b10b924bbe4u, 0xf12c3ec99b90d936u,
                    0x1dc5ba64e3729132u, 0x8d6d7acd06e03173u, 0x9c24e6369d799855u}));
  EXPECT_EQ(sail({{make_region, use_region, use_region, register_one, update, declare, trade},
                  prepare,
                  40,
                  0,
                  false,
                  filtered("region")}),
            (Hashes{0x7a8ec588a32aa166u, 0xd91d190f1aa49de5u, 0x09e2ef35ed58720au,
                    0x07b8f060ea91668bu, 0x6909f0313aac5092u, 0x92b180ea7855d64bu}));
}
TEST(ConversationHashes, OfTiersAndBudgets) {
  const std::vector<Service> services{make_region, use_region, use_region,  use_region,
                                      update,      update,     register_one};
  EXPECT_EQ(sail({services, publish_all, 0, 0, false,
                  filtered("region with tiers(at=0.25 at=0.5 at=0.75)")}),
            (Hashes{0xc2794ba84adee959u, 0x2a227ac5ed7fd206u, 0x13cdc409a3378489u,
                    0x27927e014eba353fu, 0x5a80d9b0aff751e7u, 0xc419312987f4686au}));
  EXPECT_EQ(
      sail({services, publish_all, 60, 300, true, filtered("region with priority(budget=60)")}),
      (Hashes{0x788a9d7390352ea6u, 0x65399ed78bdd2745u, 0x7802f6c48e9e1202u, 0x99e0c2e9c1a16eb2u,
              0x205f988a2f9fac0bu, 0xfa997123d2b2871bu}));
}
TEST(ConversationHashes, OfTimeManagement) {
  const std::vector<Service> services{keep_time,   keep_time,    keep_time,  say_in_time,
                                      say_in_time, register_one, delete_one, update};
  EXPECT_EQ(sail({services}),
            (Hashes{0x408601ccd6d64593u, 0x4157cd22739f0754u, 0xc70f7c3f657e8097u,
                    0x439ca70c20d17bd7u, 0x48f7a773b20681bau, 0x9ffd4c0dcdf3a365u}));
  EXPECT_EQ(sail({services, prepare, 40}),
            (Hashes{0xa90ec493749c2412u, 0x754135a67b83e8dcu, 0xf40101b5bf5ab266u,
                    0x9fa346068a73cfa5u, 0x5f3e396163029841u, 0xb45a5577ae969bd5u}));
}
TEST(ConversationHashes, OfTimeManagementAmongChangingOwners) {
  EXPECT_EQ(sail({{keep_time, keep_time, say_in_time, register_one, trade, trade, declare, say},
                  prepare,
                  60}),
            (Hashes{0xd97cae39093dbe56u, 0xc425d51bfa0b6f87u, 0x2f2ee2d4b34666cdu,
                    0x7620276f609539bfu, 0xd45a09501af1c8acu, 0x744734e5dd3f38d9u}));
}
TEST(ConversationHashes, OfBestEffort) {
  const std::vector<Service> services{register_one, update,    update,     update,
                                      update,       transport, delete_one, say};
  EXPECT_EQ(sail({services, prepare, 0, 400}),
            (Hashes{0xadeb51a75f260b76u, 0x628d6f5c95017184u, 0x93e7fcccae4ff741u,
                    0xba74f45cb1ef98e6u, 0x8cc3a046e82e42c3u, 0x5fc6285a22d07319u}));
  EXPECT_EQ(sail({services, prepare, 30, 300}),
            (Hashes{0xcb006b78f7b5c80cu, 0x78b1249dc599806du, 0x303bf3ba53d50f0bu,
                    0x0f155925d0373692u, 0xa7ec5e58a54149cau, 0x853a2938600c2702u}));
}
TEST(ConversationHashes, OfManagement) {
  EXPECT_EQ(sail({{manage, manage, declare, register_one, update, say, synchronize}}),
            (Hashes{0xf26a3066b9c0a43fu, 0x05171587409ecd59u, 0x0ef6e0d17073051au,
                    0x6b41ad4cad8d4a59u, 0xae3c9f75f8d2983cu, 0x174e8b67b3e02761u}));
  EXPECT_EQ(sail({{manage, manage, manage, register_one, keep_time, trade, watch}, prepare, 25}),
            (Hashes{0x7f930219231c7a46u, 0x6ef9d38efd9a2471u, 0xaa75edcfcb985857u,
                    0xb1bf30fc9049ccd7u, 0x4c81e18f186bfe93u, 0x99ea5d329d7b2c17u}));
}
TEST(ConversationHashes, OfThoseWhoDoNotRead) {
  EXPECT_EQ(sail({{register_one, update, update, delete_one, ask, say}, prepare, 50, 0, true}),
            (Hashes{0x13f5bf4a8cd1f751u, 0xb6f7190a9710694eu, 0xaf410b8b3bd115d0u,
                    0x11459dfafbf17985u, 0xfef0df07f06539b8u, 0xdbc68c23de0a9e54u}));
}
TEST(ConversationHashes, OfLittleRoom) {
  EXPECT_EQ(sail({{register_one, register_one, update, update, say, delete_one},
                  prepare,
                  80,
                  0,
                  true,
                  cramped()}),
            (Hashes{0x2572487900ce2acbu, 0x04ad08333d782164u, 0x008c3724c6c36090u,
                    0xdcf2bf36725c7434u, 0x6f083eb64bc894c3u, 0xe2218a024ee231fcu}));
  EXPECT_EQ(sail({{register_one, update, keep_time, keep_time, say_in_time, say_in_time},
                  prepare,
                  80,
                  0,
                  false,
                  cramped()}),
            (Hashes{0x56b3c4f0c56248d9u, 0x9fb9678140b075c9u, 0x678fbac3d0a80657u,
                    0x0995be42184defa3u, 0x6966dc071717d0acu, 0x9cd36a793e3697eeu}));
}
TEST(ConversationHashes, OfEverythingAtOnce) {
  const std::vector<Service> services{declare,     register_one, update,     update,    say,
                                      delete_one,  ask,          name,       transport, trade,
                                      trade,       make_region,  use_region, keep_time, say_in_time,
                                      synchronize, manage,       watch};
  for (const auto& [seed, hashes] : std::vector<std::pair<std::uint64_t, Hashes>>{
           {1,
            {0x1cd2eaa8c2042d10u, 0xa8d2452618fd03f0u, 0xa5c1fe3c80a6638bu, 0x03b227aaa39fa1d6u,
             0x6a0e6d009fb3da35u, 0x910c6affd2a48695u}},
           {2,
            {0x33495bee62737519u, 0x03a1822be8cd08e5u, 0xba1bb46368de983du, 0x2d27be85e80a94cau,
             0x09a39c735fe0a7e6u, 0xe38999d25e47476du}},
           {3,
            {0x73160198ecfeda65u, 0x5a842806449aada3u, 0x3a13a69be7cb3805u, 0xc8d1a7fa5caa19beu,
             0xfe419dc70275e18du, 0x9ac6c16c1559963fu}},
           {4,
            {0xda622d1587cd7041u, 0x15088013216f7bc3u, 0xdb3d976815f2c553u, 0x50170d639ef0b4ebu,
             0x86ff2511856a6896u, 0x4f029bf63b1e71e7u}}})
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
