// What peers tell each other of where their players look, and what they are told: read as written,
// and never trusted.
#include <gtest/gtest.h>

#include <random>

#include "game/net/peer/interest/peer_replicas.h"
#include "game/net/peer/interest/sender_interest.h"
#include "game/peer/assembly.h"
#include "tests/physics/scenes.h"

namespace rink::game {
namespace {

TEST(EncodedInterest, IsReadAsWrittenAndNamesTheCellsThatTheRegionTouches) {
  std::mt19937_64 random(4);
  const auto uniform = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  for (int k = 0; k < 1000; ++k) {
    const double x = uniform(-5.0, 25.0), y = uniform(-5.0, 15.0), reach = uniform(0.01, 4.0),
                 cell = k % 2 == 0 ? 0.0 : uniform(0.05, 3.0);
    const im::Region region{x - reach, y - reach, x + reach, y + reach};
    const EncodedInterest encoded = interest_at(region, cell);
    const auto read = interest_from(bytes_of(encoded));
    ASSERT_TRUE(read);
    EXPECT_EQ(*read, encoded);
    if (cell == 0.0) continue;
    const im::Region told = region_of(encoded, cell);
    for (const auto& [here, there] : {std::pair(region.low_x, told.low_x),
                                      {region.low_y, told.low_y},
                                      {region.high_x, told.high_x},
                                      {region.high_y, told.high_y}})
      EXPECT_EQ(std::floor(here / cell), std::floor(there / cell));
  }
}

TEST(EncodedInterest, IsRefusedIfNoPlayerCouldHaveIt) {
  EXPECT_TRUE(interest_from(bytes_of(EncodedInterest{})));
  const std::vector<std::byte> good = bytes_of(interest_at({1.0, 2.0, 3.0, 4.0}, 0.0));
  for (std::size_t size = 0; size < good.size(); ++size)
    EXPECT_FALSE(interest_from(rti::Bytes(good).first(size)));
  std::vector<std::byte> bad = good;
  bad[0] = std::byte{3};
  EXPECT_FALSE(interest_from(bad)) << "no such form";
  bad = bytes_of(EncodedInterest{EncodedInterest::Form::region, 1.0f, 2.0f, 3.0f, 4.0f});
  std::swap_ranges(bad.begin() + 1, bad.begin() + 5, bad.begin() + 9);
  EXPECT_FALSE(interest_from(bad)) << "low above high";
  bad = good;
  for (std::size_t k = 1; k < 5; ++k) bad[k] = std::byte{0xff};
  EXPECT_FALSE(interest_from(bad)) << "not a number";
}

/// Pucks that nothing happens to are told of once, and once more to whoever looked away and comes
/// back.
TEST(SenderInterest, TellsWhoLooksAgainOfWhatIsThereThoughNothingHappenedToIt) {
  physics::World world(physics::test::rink_of(8.0, 2.0));
  for (const double x : {1.0, 1.5, 2.0})
    world.add(physics::PuckSpec{.position = {x, 1.0}, .radius = 0.05});
  const physics::BodyId bat = world.add(physics::BatSpec{.position = {7.0, 1.0}});
  peer::Assembly assembly(
      world,
      peer::Division(world.spec().field, {{{0.0, 0.0, 4.0, 2.0}, 0}, {{4.0, 0.0, 8.0, 2.0}, 1}}, 2),
      0.1, 0.02);
  const peer::Peer& sender = assembly.peers()[0];
  SenderInterest interest("region", {.world = {0.0, 0.0, 8.0, 2.0}}, "on-event",
                          std::vector<im::Role>(4), 0.05);
  interest.add_player(1, bat.index);
  const im::Region view{0.5, 0.5, 2.5, 1.5};
  std::uint32_t window = 0;
  const auto bytes_told = [&] {
    assembly.advance();
    interest.match(sender);
    return interest.updates_for(sender, 1, window++, [](std::uint32_t) { return std::nullopt; })
        .size();
  };
  interest.look(1, view);
  const std::size_t all = bytes_told();
  EXPECT_GT(all, 3u * 5u) << "a number, an instant and a place of each";
  EXPECT_EQ(interest.scope_of(1).size(), 3u);
  EXPECT_EQ(bytes_told(), 0u) << "nothing happened";
  interest.look_away(1);
  interest.look(1, view);
  EXPECT_EQ(bytes_told(), all);
  EXPECT_EQ(bytes_told(), 0u);
}

TEST(PeerReplicas, SurvivesWhateverItIsTold) {
  std::mt19937_64 random(5);
  for (const bool has_trajectories : {false, true}) {
    PeerReplicas picture(has_trajectories, {},
                         std::vector<physics::BodyKind>(50, physics::BodyKind::puck));
    for (int k = 0; k < 20'000; ++k) {
      std::vector<std::byte> bytes(random() % 24);
      for (std::byte& byte : bytes) byte = static_cast<std::byte>(random() & 0x7f);
      picture.receive(1, bytes, 20.0);
      picture.forget_received();
    }
    picture.drop_forgotten();
    for (const auto& [body, replica] : picture.all())
      EXPECT_TRUE(body < 50 && replica.is_there && replica.source == 1);
    picture.forget(1);
    for (const auto& [body, replica] : picture.all()) EXPECT_FALSE(replica.is_there);
    picture.drop_forgotten();
    EXPECT_TRUE(picture.all().empty());
  }
}

}  // namespace
}  // namespace rink::game
