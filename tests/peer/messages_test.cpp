// Messages as bytes: what is written is read, what was altered is refused; and peers that claim
// what is not theirs are named.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vector>

#include "game/peer/assembly.h"
#include "game/peer/session/session.h"
#include "game/physics/snapshot_stream.h"
#include "tests/peer/shared_scenes.h"

namespace rink::peer::test {
namespace {

Handover some_arrivals() {
  SharedScene scene = shared_scene(6, 0.2);
  scene.world.advance(0.2);
  Handover message{.window = 3,
                   .bodies = {},
                   .rest_contacts = {{.low = 2, .high = 5, .axis = 1, .age = {}}},
                   .keys = scene.keys,
                   .observations = {}};
  message.observations = {{.bat = 4,
                           .owner = 1,
                           .time = 0.2,
                           .position = {1.0, 2.0},
                           .pucks = {{.number = 9, .radius = 0.04}, {}}},
                          {}};
  for (std::uint32_t body = 0; body < 20; ++body)
    message.bodies.push_back({body, physics::Subdomain::state_in(scene.world, body)});
  return message;
}

template <class Message>
void expect_kept(Message message) {
  const std::vector<std::uint8_t> bytes = written(message);
  EXPECT_EQ(bytes.size(), measured(message));
  Message received;
  ASSERT_TRUE(read(bytes, received));
  EXPECT_EQ(written(received), bytes);
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    std::vector<std::uint8_t> altered = bytes;
    altered[i] = static_cast<std::uint8_t>(altered[i] ^ (1u << (i % 8)));
    EXPECT_FALSE(read(altered, received)) << i;
  }
  for (std::size_t length = 0; length < bytes.size(); ++length)
    EXPECT_FALSE(read(std::span(bytes).first(length), received)) << length;
}

TEST(Messages, AreReadAsWrittenAndRefusedIfAltered) {
  expect_kept(some_arrivals());
  const std::vector<ClaimedFlight> flights{{0.5, 99, 0.0f, 1.0f, 2.0f, 3.0f}, {0.6, 98}, {0.0, 0}};
  expect_kept(Claims{.window = 2,
                     .known_count = 7,
                     .bodies = {{4, 2, true}, {9, 1, false}},
                     .flights = flights,
                     .presses = {{3, {1.0, -2.0}, 5}, {}}});
  expect_kept(Verdict{.window = 5,
                      .accepts = true,
                      .halo = std::numeric_limits<float>::infinity(),
                      .at_once_max = 3,
                      .events = 9,
                      .leaves = true,
                      .listed = {0, 7, 255},
                      .critical = {{0.5, 70, false}, {0.75, 2, true}},
                      .reports = {{80, 70, 40, ~std::uint64_t{0}}, {}},
                      .annexes = {{0.5f, 1.0f, 2.0f, 3.0f}, {}}});
}

/// What nearly all messages among many peers are, so that it decides what these carry
/// (docs/peer-to-peer.md, "What is said").
TEST(Messages, ThatSayNothingTakeAFewBytes) {
  constexpr std::size_t head = 1, window = 2, checksum = 4;
  EXPECT_EQ(
      written(Handover{
                  .window = 300, .bodies = {}, .rest_contacts = {}, .keys = {}, .observations = {}})
          .size(),
      head + window + checksum);
  EXPECT_EQ(
      written(Claims{.window = 300, .known_count = 100, .bodies = {}, .flights = {}, .presses = {}})
          .size(),
      head + window + 1 + checksum);
  EXPECT_EQ(
      written(
          Verdict{.window = 300, .accepts = true, .halo = 0.5f, .at_once_max = 2, .events = 100})
          .size(),
      head + window + 4 + 1 + 1 + checksum);
}

TEST(Messages, GrowByWhatIsThereAlone) {
  const Verdict plain{.window = 5, .accepts = true, .halo = 0.5f};
  Verdict verdict = plain;
  verdict.goals = {{1.5, 7, true}};
  expect_kept(verdict);
  EXPECT_EQ(written(verdict).size(), written(plain).size() + 1 + 13);
  verdict = plain, verdict.admission.reached = {3, 4};
  expect_kept(verdict);
  Handover handover;
  const std::size_t nothing = written(handover).size();
  handover.free_flights = {
      {.position = {1.0, 2.0}, .velocity = {3.0, 4.0}, .time = 0.5, .number = 8}, {}};
  expect_kept(handover);
  EXPECT_EQ(written(handover).size(), nothing + 1 + 2 * 44);
}

/// docs/peer-to-peer.md, "What is said in every window".
TEST(Messages, SayOfBodiesWhatTheOnesBeforeThemHaveNot) {
  BodyState still;
  still.flight.radius = 0.04, still.mass = 0.2, still.inverse_mass = 5.0;
  BodyState flying = still;
  flying.flight = {.x = 1.0, .y = 1.5, .vx = -2.0, .vy = 0.5, .time = 0.25, .radius = 0.04};
  Handover message;
  message.window = 3, message.bodies = {{7, still}};
  const std::size_t without = written(message).size();
  message.bodies.push_back({8, flying});
  expect_kept(message);
  const std::vector<std::uint8_t> bytes = written(message);
  ASSERT_EQ(bytes.size(), without + 2 + 5 * 8);
  const auto body = bytes.end() - 4 - 2 - 5 * 8;  // before the checksum
  EXPECT_THAT(std::vector(body, body + 2), testing::ElementsAre(0x02, 0x1f));
  message.bodies.back().state = still;
  EXPECT_EQ(written(message).size(), without + 2) << "one like it";
  Handover received;
  ASSERT_TRUE(read(bytes, received));
  EXPECT_TRUE(are_same(received.bodies.back().state, flying));
}

TEST(Messages, WithFieldsThatNoStateHasAreRefused) {
  for (const bool is_state : {true, false}) {  // 32 fields, and one more
    const std::uint8_t top = is_state ? 0x0f : 0x10;
    std::vector<std::uint8_t> bytes{0x80 | 1, 3, 1, 2, 0x80, 0x80, 0x80, 0x80, top};
    BodyState state;
    StateFields fields(state);
    for (std::size_t field = 28; field < fields.count(); ++field)
      bytes.insert(bytes.end(), fields.size_of(field), 0);
    physics::add_checksum(bytes, 4);
    Handover received;
    EXPECT_EQ(read(bytes, received), is_state);
  }
}

TEST(Messages, KeepListsOfBodiesInAnyOrder) {
  const std::vector<std::uint32_t> wanted{5, 0, 0xffffffff, 7, 7, 0x80000000};
  const Verdict verdict{.window = 5, .accepts = true, .wanted = wanted};
  expect_kept(verdict);
  Verdict received;
  ASSERT_TRUE(read(written(verdict), received));
  EXPECT_EQ(received.wanted, wanted);
  Verdict rising = verdict;
  rising.wanted = {60, 61, 62, 100};
  EXPECT_EQ(written(rising).size(),
            written(Verdict{.window = 5, .accepts = true}).size() + 1 + 1 + 4)
      << "a head, a count and a byte each";
}

/// A loss may come instead of any of them, and all look for it in whatever they do not understand.
TEST(Messages, OfAWindowAreNeverTakenForALossNorALossForThem) {
  Loss loss{.step = 12, .gone = {0, 1}, .finished = {1}};
  Handover handover;
  Claims claims;
  Verdict verdict;
  EXPECT_FALSE(read(written(loss), handover) || read(written(loss), claims) ||
               read(written(loss), verdict));
  EXPECT_FALSE(read(written(some_arrivals()), loss) || read(written(Claims{}), loss) ||
               read(written(Verdict{}), loss));
}

TEST(Messages, WithAPartThatIsSaidToBeThereAndIsEmptyAreRefused) {
  std::vector<std::uint8_t> bytes{0x80 | 2, 3, 0};  // flights of bodies, window 3, none
  physics::add_checksum(bytes, 4);
  Handover handover;
  EXPECT_FALSE(read(bytes, handover));
}

TEST(Messages, KeepNumbersOfAnyLength) {
  for (const std::uint64_t events : {std::uint64_t{0}, std::uint64_t{127}, std::uint64_t{128},
                                     std::uint64_t{1} << 32, ~std::uint64_t{0}}) {
    const Verdict verdict{.window = 0xffffffff, .events = events};
    expect_kept(verdict);
    Verdict received;
    ASSERT_TRUE(read(written(verdict), received));
    EXPECT_EQ(received.events, events);
    EXPECT_EQ(received.window, 0xffffffffu);
  }
}

TEST(Messages, WhoseFlightsDoNotAddUpAreRefused) {
  Claims claims{
      .window = 2, .known_count = 0, .bodies = {{4, 3, true}}, .flights = {{}, {}}, .presses = {}};
  Claims received;
  EXPECT_FALSE(read(written(claims), received));
}

TEST(Messages, WithAnnexesWhoseSidesAreInNoOrderAreRefused) {
  for (const float side : {0.25f, std::numeric_limits<float>::quiet_NaN()}) {
    Verdict received;
    EXPECT_FALSE(read(written(Verdict{.annexes = {{0.5f, 0.0f, side, 1.0f}}}), received)) << side;
  }
}

TEST(Messages, WithThrustsThatAreNoNumberAreRefused) {
  Claims received;
  EXPECT_FALSE(
      read(written(Claims{
               .window = 2, .bodies = {}, .flights = {}, .presses = {{3, {std::nan(""), 0.0}, 5}}}),
           received));
  EXPECT_FALSE(read(
      written(Claims{.window = 2, .bodies = {}, .flights = {}, .presses = {{3, {1.0, 0.0}, 0}}}),
      received));
}

/// Two halves of a gas, the left one's peer after a window.
struct TwoPeers {
  SharedScene scene = shared_scene(0, 1.0);
  Division division = Division::into_strips(scene.world.spec().field, 2);
  Peer left{scene.world.spec(), division, 0, scene.world.body_count(), 0.3},
      right{scene.world.spec(), division, 1, scene.world.body_count(), 0.3};
  TwoPeers() {
    for (Peer* peer : {&left, &right}) {
      for (std::uint32_t body = 0; body < scene.world.body_count(); ++body)
        peer->consider(body, physics::Subdomain::state_in(scene.world, body));
      peer->begin(0.01);
      peer->play();
    }
  }
};

TEST(Peer, NamesWhoClaimsABodyThatIsNotItsOwn) {
  TwoPeers two;
  Claims claims = two.right.claims_for(0);
  claims.bodies.push_back({two.left.owned().front(), 0, true});
  two.left.receive(1, claims);
  EXPECT_FALSE(two.left.judge().accepts);
  EXPECT_EQ(
      two.left.accusation().text(),
      "peer 1 claims body " + std::to_string(two.left.owned().front()) + ", which it does not own");
}

TEST(Peer, NamesWhoCountsOtherwise) {
  TwoPeers two;
  Claims claims = two.right.claims_for(0);
  ++claims.known_count;
  two.left.receive(1, claims);
  EXPECT_FALSE(two.left.judge().accepts);
  EXPECT_THAT(two.left.accusation().text(), testing::StartsWith("peer 1 counts"));
}

TEST(Peer, NamesWhoReportsOnOtherInstantsThanAllWereAskedAbout) {
  TwoPeers two;
  two.right.receive(0, two.left.claims_for(1)), two.left.receive(1, two.right.claims_for(0));
  Verdict verdict = two.right.judge();
  verdict.reports.push_back({});
  two.left.receive(1, verdict);
  EXPECT_EQ(two.left.accusation().text(), "peer 1 reports on 1 instants instead of 0");
}

TEST(Peer, NamesWhoHandsOverABodyThatIsNotItsOwn) {
  TwoPeers two;
  const std::uint32_t body = two.left.owned().front();
  two.left.receive(1, two.right.claims_for(0)), two.right.receive(0, two.left.claims_for(1));
  two.left.receive(1, two.right.judge()), two.right.receive(0, two.left.judge());
  ASSERT_EQ(two.left.conclude(), Outcome::final);
  ASSERT_EQ(two.right.conclude(), Outcome::final);
  Handover handover = two.right.handover_for(0, 0.02);
  const std::vector<std::uint8_t> before = bytes_of(two.left.share().state(body));
  handover.bodies.push_back({body, two.right.share().state(two.right.owned().front())});
  two.left.receive(1, handover);
  two.left.commit(0.02);
  EXPECT_EQ(two.left.accusation().text(),
            "peer 1 hands over body " + std::to_string(body) + ", which it does not own");
  EXPECT_EQ(bytes_of(two.left.share().state(body)), before);
}

/// A ghost is hit by somebody who is too far off to be known here, far from all that the peer owns:
/// the window stands, though the ghost is elsewhere in this peer's run.
TEST(Peer, KnowsOfAGhostThatWentAstrayWhereItWasWhenTheWindowBegan) {
  physics::World world(physics::test::rink_of(4.0, 2.0));
  const Vector2 ghost_place(2.2, 1.0);
  const std::uint32_t ghost =
      world.add(physics::PuckSpec{.position = ghost_place, .velocity = {0.5, 0.0}, .radius = 0.03})
          .index;
  world.add(physics::PuckSpec{.position = {2.9, 1.0}, .velocity = {-40.0, 0.0}, .radius = 0.03});
  world.add(physics::PuckSpec{.position = {0.5, 0.5}, .radius = 0.03});
  const Division division(world.spec().field,
                          {{{0.0, 0.0, 2.0, 2.0}, 0}, {{2.0, 0.0, 4.0, 2.0}, 1}}, 2);
  Peer left(world.spec(), division, 0, world.body_count(), 0.3),
      right(world.spec(), division, 1, world.body_count(), 0.3);
  for (Peer* peer : {&left, &right}) {
    for (std::uint32_t body = 0; body < world.body_count(); ++body)
      peer->consider(body, physics::Subdomain::state_in(world, body));
    peer->begin(0.02), peer->play();
  }
  left.receive(1, right.claims_for(0)), right.receive(0, left.claims_for(1));
  left.receive(1, right.judge()), right.receive(0, left.judge());
  ASSERT_EQ(left.conclude(), Outcome::final);
  ASSERT_EQ(right.conclude(), Outcome::final);
  const Vector2 here = left.world().position({ghost}), there = right.world().position({ghost});
  EXPECT_GT((here - there).norm(), 0.05) << "it went astray";
  EXPECT_EQ(left.known_place(ghost), ghost_place);
  EXPECT_EQ(right.known_place(ghost), there);
  left.receive(1, right.handover_for(0, 0.04)), right.receive(0, left.handover_for(1, 0.04));
  left.commit(0.04), right.commit(0.04);
  for (const Peer* peer : {&left, &right}) {
    const bool has_it =
        peer->share().owns(ghost) || std::ranges::binary_search(peer->ghosts(), ghost);
    if (has_it) {
      EXPECT_EQ(peer->known_place(ghost), there) << peer->number();
    }
  }
  EXPECT_TRUE(left.share().owns(ghost) || std::ranges::binary_search(left.ghosts(), ghost));
}

}  // namespace
}  // namespace rink::peer::test
