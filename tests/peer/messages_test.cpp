// Messages as bytes: what is written is read, what was altered is refused; and peers that claim what is not theirs are named.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "game/peer/assembly.h"
#include "tests/peer/shared_scenes.h"

namespace rink::peer::test {
namespace {

Arrivals some_arrivals() {
  SharedScene scene = shared_scene(6, 0.2);
  scene.world.advance(0.2);
  Arrivals message{.window = 3, .bodies = {}, .holds = {{.low = 2, .high = 5, .axis = 1, .age = {}}}, .keys = scene.keys, .glimpses = {}};
  message.glimpses = {{.bat = 4, .owner = 1, .time = 0.2, .position = {1.0, 2.0}, .pucks = {{.number = 9, .radius = 0.04}, {}}}, {}};
  for (std::uint32_t body = 0; body < 20; ++body) message.bodies.push_back({body, physics::Portion::state_in(scene.world, body)});
  return message;
}

template <class Message>
void expect_kept(const Message& message) {
  const std::vector<std::uint8_t> bytes = written(message);
  EXPECT_EQ(bytes.size(), measured(message));
  Message heard;
  ASSERT_TRUE(read(bytes, heard));
  EXPECT_EQ(written(heard), bytes);
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    std::vector<std::uint8_t> altered = bytes;
    altered[i] = static_cast<std::uint8_t>(altered[i] ^ (1u << (i % 8)));
    EXPECT_FALSE(read(altered, heard)) << i;
  }
  for (std::size_t length = 0; length < bytes.size(); ++length) EXPECT_FALSE(read(std::span(bytes).first(length), heard)) << length;
}

TEST(Messages, AreReadAsWrittenAndRefusedIfAltered) {
  expect_kept(some_arrivals());
  const std::vector<ClaimedFlight> flights{{0.5, 99, 0.0f, 1.0f, 2.0f, 3.0f}, {0.6, 98}, {0.0, 0}};
  expect_kept(Claims{.window = 2, .known_count = 7, .bodies = {{4, 2, true}, {9, 1, false}}, .flights = flights, .presses = {{3, {1.0, -2.0}, 5}, {}}});
  expect_kept(Verdict{.window = 5, .accepts = true, .halo = std::numeric_limits<double>::infinity(), .at_once_max = 3, .was_hopeless = true, .events = 9, .leaves = true, .listed = {0, 7, 255}});
}

TEST(Messages, WhoseFlightsDoNotAddUpAreRefused) {
  Claims claims{.window = 2, .known_count = 0, .bodies = {{4, 3, true}}, .flights = {{}, {}}, .presses = {}};
  Claims heard;
  EXPECT_FALSE(read(written(claims), heard));
}

TEST(Messages, WithThrustsThatAreNoNumberAreRefused) {
  Claims heard;
  EXPECT_FALSE(read(written(Claims{.window = 2, .bodies = {}, .flights = {}, .presses = {{3, {std::nan(""), 0.0}, 5}}}), heard));
  EXPECT_FALSE(read(written(Claims{.window = 2, .bodies = {}, .flights = {}, .presses = {{3, {1.0, 0.0}, 0}}}), heard));
}

/// Two halves of a gas, the left one's peer after a window.
struct TwoPeers {
  SharedScene scene = shared_scene(0, 1.0);
  Division division = Division::into_strips(scene.world.spec().field, 2);
  Peer left{scene.world.spec(), division, 0, scene.world.body_count(), 0.3}, right{scene.world.spec(), division, 1, scene.world.body_count(), 0.3};
  TwoPeers() {
    for (Peer* peer : {&left, &right}) {
      for (std::uint32_t body = 0; body < scene.world.body_count(); ++body) peer->consider(body, physics::Portion::state_in(scene.world, body));
      peer->begin(0.01);
      peer->play();
    }
  }
};

TEST(Peer, NamesWhoClaimsABodyThatIsNotItsOwn) {
  TwoPeers two;
  Claims claims = two.right.claims_for(0);
  claims.bodies.push_back({two.left.owned().front(), 0, true});
  two.left.hear(1, claims);
  EXPECT_FALSE(two.left.judge().accepts);
  EXPECT_EQ(two.left.accusation(), "peer 1 claims body " + std::to_string(two.left.owned().front()) + ", which it does not own");
}

TEST(Peer, NamesWhoCountsOtherwise) {
  TwoPeers two;
  Claims claims = two.right.claims_for(0);
  ++claims.known_count;
  two.left.hear(1, claims);
  EXPECT_FALSE(two.left.judge().accepts);
  EXPECT_THAT(two.left.accusation(), testing::StartsWith("peer 1 counts"));
}

TEST(Peer, NamesWhoHandsOverABodyThatIsNotItsOwn) {
  TwoPeers two;
  const std::uint32_t body = two.left.owned().front();
  two.left.hear(1, two.right.claims_for(0)), two.right.hear(0, two.left.claims_for(1));
  two.left.hear(1, two.right.judge()), two.right.hear(0, two.left.judge());
  ASSERT_EQ(two.left.conclude(), Outcome::final);
  ASSERT_EQ(two.right.conclude(), Outcome::final);
  Arrivals arrivals = two.right.arrivals_for(0, 0.02);
  const std::vector<std::uint8_t> before = bytes_of(two.left.state(body));
  arrivals.bodies.push_back({body, two.right.state(two.right.owned().front())});
  two.left.hear(1, arrivals);
  two.left.commit(0.02);
  EXPECT_EQ(two.left.accusation(), "peer 1 hands over body " + std::to_string(body) + ", which it does not own");
  EXPECT_EQ(bytes_of(two.left.state(body)), before);
}

}  // namespace
}  // namespace rink::peer::test
