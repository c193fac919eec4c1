// The part of a peer as its standby keeps it: played again it is the part, every double of it; it
// goes back by a step, and knows each key once.
#include "game/peer/standby/standby_copy.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <iostream>

#include "game/peer/assembly.h"
#include "game/peer/cuts.h"
#include "game/peer/standby/known_bodies.h"
#include "game/peer/standby/packed_states.h"
#include "game/peer/standby/standby_feed.h"
#include "tests/peer/shared_scenes.h"

namespace rink::peer::test {
namespace {

using testing::ElementsAre;

PartRecord step(std::uint64_t number, std::vector<Key> log, bool is_whole = false) {
  return {.step = number,
          .own_keys = std::move(log),
          .piece_count = is_whole ? 1u : 0u,
          .time = 0.1 * static_cast<double>(number)};
}

std::vector<double> times(const std::vector<Key>& log) {
  std::vector<double> all;
  for (const Key& key : log) all.push_back(key.time);
  return all;
}

const Key first{.time = 0.05}, second{.time = 0.15}, third{.time = 0.25};

TEST(PeerMirror, HasEachKeyOfItsPartOnceHoweverItWasToldOfIt) {
  StandbyCopy copy;
  copy.begin({});
  ASSERT_TRUE(copy.add(step(1, {first})));
  EXPECT_THAT(times(copy.log()), ElementsAre(0.05));
  copy.add(PartSnapshot{});
  ASSERT_TRUE(copy.add(step(2, {second})));
  EXPECT_THAT(times(copy.log()), ElementsAre(0.05, 0.15));
  // Who has nothing yet is told the keys of all the story with a whole part.
  ASSERT_TRUE(copy.add(step(7, {third}, true)));
  copy.add(PartSnapshot{.is_first = true, .log = {first, second, third}});
  EXPECT_THAT(times(copy.log()), ElementsAre(0.05, 0.15, 0.25));
  ASSERT_TRUE(copy.add(step(8, {})));
  EXPECT_THAT(times(copy.log()), ElementsAre(0.05, 0.15, 0.25));
}

TEST(PeerMirror, TakesTheNextStepOrAWholePartAndGoesBackByOne) {
  StandbyCopy copy;
  EXPECT_FALSE(copy.add(step(1, {}))) << "nothing to add to";
  ASSERT_TRUE(copy.add(step(4, {first}, true)));
  EXPECT_FALSE(copy.is_at(4)) << "its snapshot is still to come";
  copy.add(PartSnapshot{.is_first = true, .log = {first}});
  EXPECT_FALSE(copy.add(step(6, {second}))) << "a step was left out";
  EXPECT_FALSE(copy.add(step(4, {second}))) << "a step twice";
  ASSERT_TRUE(copy.add(step(5, {second})));
  ASSERT_TRUE(copy.rewind(5));
  ASSERT_TRUE(copy.rewind(4));
  EXPECT_THAT(times(copy.log()), ElementsAre(0.05))
      << "the step that was taken back took its keys along";
  ASSERT_TRUE(copy.add(step(5, {third})));
  EXPECT_THAT(times(copy.log()), ElementsAre(0.05, 0.25));
  EXPECT_FALSE(copy.rewind(3));
}

/// Nobody can go back to a snapshot's step from a snapshot that came later.
TEST(PeerMirror, GoesBackBehindANewSnapshot) {
  StandbyCopy copy;
  copy.begin({});
  for (const std::uint64_t number : {1, 2}) ASSERT_TRUE(copy.add(step(number, {first})));
  copy.add(PartSnapshot{.pending = {second}});
  ASSERT_TRUE(copy.rewind(1));
  EXPECT_THAT(times(copy.log()), ElementsAre(0.05));
  for (const std::uint64_t number : {2, 3}) ASSERT_TRUE(copy.add(step(number, {})));
  EXPECT_EQ(copy.snapshot_size(), 0u);
  ASSERT_TRUE(copy.rewind(2));
}

TEST(StandbyFeed, CutsASnapshotIntoPiecesThatMakeItAgain) {
  PartSnapshot snapshot;
  snapshot.log.resize(40'000, first);
  const std::vector<std::uint8_t> bytes = written(snapshot);
  constexpr StandbyLimits limits;
  StandbyFeed feed(limits);
  EXPECT_FALSE(feed.is_due());
  for (std::uint64_t work = 0; work < limits.replay_work; work += 100'000)
    feed.note({.work = 100'000});
  EXPECT_TRUE(feed.is_due());
  feed.begin(7, bytes);
  EXPECT_FALSE(feed.is_due());
  std::vector<std::uint8_t> put_together;
  for (std::vector<SnapshotPiece> pieces = feed.take(false); !pieces.empty();
       pieces = feed.take(false)) {
    ASSERT_EQ(pieces.size(), 1u);
    SnapshotPiece piece;
    ASSERT_TRUE(read(written(pieces.front()), piece));
    EXPECT_LE(piece.bytes.size(), limits.piece_bytes);
    EXPECT_EQ(piece.offset, put_together.size());
    EXPECT_EQ(piece.step, 7u);
    put_together.insert(put_together.end(), piece.bytes.begin(), piece.bytes.end());
  }
  EXPECT_EQ(put_together, bytes);
}

TEST(StandbyFeed, MayNotAnnounceASnapshotWithoutEnd) {
  SnapshotPiece piece{.step = 7, .total = SnapshotPiece::total_max, .bytes = {1}};
  EXPECT_TRUE(read(written(piece), piece));
  ++piece.total;
  EXPECT_FALSE(read(written(piece), piece));
  PartRecord record{.step = 7, .piece_count = SnapshotPiece::count_max, .time = 0.0};
  EXPECT_TRUE(read(written(record), record));
  ++record.piece_count;
  EXPECT_FALSE(read(written(record), record));
}

TEST(PackedStates, AreTheStatesInFewBytes) {
  std::size_t packed_bytes = 0, bodies = 0;
  for (std::uint64_t number = 0; number < 30; ++number) {
    SharedScene scene = shared_scene(number, 1.0);
    const Validator validator(scene.world);
    physics::test::RandomKeys::advance(scene.world, 0.5);
    StatePacker packer(validator);
    for (std::uint32_t body = 0; body < scene.world.body_count(); ++body)
      packer.add(body, physics::Subdomain::state_in(scene.world, body));
    const std::vector<std::uint8_t> bytes = packer.take();
    const auto read_back = unpacked(bytes, validator);
    ASSERT_TRUE(read_back);
    ASSERT_EQ(read_back->size(), scene.world.body_count());
    for (const auto& [body, state] : *read_back)
      EXPECT_TRUE(are_same(state, physics::Subdomain::state_in(scene.world, body)));
    packed_bytes += bytes.size(), bodies += read_back->size();
    for (std::size_t size = 0; size < bytes.size(); size += 1 + size / 4) {
      const auto less = unpacked(std::span(bytes).first(size), validator);
      EXPECT_TRUE(!less || less->size() < read_back->size());
    }
  }
  std::cout << static_cast<double>(packed_bytes) / static_cast<double>(bodies)
            << " bytes per body\n";
  EXPECT_LT(packed_bytes, 120 * bodies);
}

struct Bytes {
  std::uint64_t claims = 0, records = 0, told = 0, snapshots = 0;
};

/// What `keeper` makes of a record that was sent without what it knows.
PartRecord heard(PartRecord record, const Peer& peer, const Peer& keeper, const Validator& scene,
                 Bytes& sums) {
  leave_out_known(record, keeper.number(), peer.share(), scene);
  const std::vector<std::uint8_t> bytes = written(record);
  sums.told += bytes.size();
  PartRecord received;
  EXPECT_TRUE(read(bytes, received));
  EXPECT_EQ(put_back_known(received, keeper.share(), scene), "");
  return received;
}

std::vector<RestContact> in_order(std::vector<RestContact> contacts, const Peer& peer) {
  return sound_contacts(std::move(contacts), peer.share().subdomain());
}

void expect_same(const Part& part, const Peer& peer, const std::string& where) {
  std::vector<std::uint32_t> owned = peer.owned(), played;
  std::ranges::sort(owned);
  for (const auto& [body, state] : part.bodies) {
    played.push_back(body);
    EXPECT_TRUE(!peer.share().owns(body) || are_same(state, peer.share().state(body)))
        << where << ", body " << body;
  }
  EXPECT_EQ(played, owned) << where;
  EXPECT_TRUE(are_same(in_order(part.rest_contacts, peer),
                       in_order(peer.share().own_rest_contacts(), peer)))
      << where;
  EXPECT_EQ(part.time, peer.now());
}

/// Plays scene `number` among peers, each of whose parts is played again from its log now and then.
void expect_parts_played_again(std::uint64_t number, Bytes& sums) {
  constexpr std::uint64_t window_count = 60;
  Random random(11 * number + 5);
  const double length = std::pow(10.0, uniform(random, -3.0, -1.0));
  SharedScene scene = shared_scene(number, length * static_cast<double>(window_count));
  const physics::WorldSpec spec = scene.world.spec();
  const Validator validator(scene.world);
  const PeerNumber peer_count = 2 + below(random, 5);
  const Division division = random_division(spec.field, random, peer_count);
  Assembly assembly(scene.world, division, uniform(random, 0.05, 0.5), length);
  std::ranges::stable_sort(scene.keys, {},
                           [](const Key& key) { return std::pair(key.time, key.bat); });
  for (const Key& key : scene.keys) assembly.press(key);
  assembly.advance();
  std::vector<StandbyCopy> copies(peer_count);
  for (Peer& peer : assembly.peers()) {
    peer.part_log().begin(validator);
    copies[peer.number()].add(PartRecord{.step = 1, .piece_count = 1, .time = peer.now()});
    copies[peer.number()].add(peer.part_log().snapshot());
  }
  for (std::uint64_t window = 2; window <= window_count; ++window) {
    const double start = assembly.now();
    assembly.advance();
    for (Peer& peer : assembly.peers()) {
      const std::string where = "scene " + std::to_string(number) + ", peer " +
                                std::to_string(peer.number()) + " of " +
                                std::to_string(peer_count) + ", window " + std::to_string(window);
      StandbyCopy& copy = copies[peer.number()];
      PartRecord record = peer.part_log().record(), told;
      record.step = window;
      const std::vector<std::uint8_t> bytes = written(record);
      sums.records += bytes.size();
      const Peer& keeper = assembly.peers()[(peer.number() + 1) % peer_count];
      ASSERT_EQ(written(heard(record, peer, keeper, validator, sums)), bytes) << where;
      ASSERT_TRUE(read(bytes, told)) << where;
      told.time = peer.now();
      ASSERT_EQ(fault_of(told, validator, start, told.time), "") << where;
      ASSERT_TRUE(copy.add(std::move(told))) << where;
      if (window % 7 == 0 || window == window_count || number % 4 == 1)
        expect_same(copy.part(spec, validator, division, peer.number()), peer, where);
      if (below(random, 20) != 0) continue;
      const PartSnapshot snapshot = peer.part_log().snapshot();
      ASSERT_EQ(fault_of(snapshot, validator, peer.now()), "") << where;
      sums.snapshots += written(snapshot).size();
      copy.add(snapshot);
    }
    if (testing::Test::HasFailure()) return;
  }
  for (const Peer& peer : assembly.peers()) sums.claims += peer.counters().claim_bytes;
}

void expect_parts_played_again(std::uint64_t begin, std::uint64_t end) {
  Bytes sums;
  for (std::uint64_t number = begin; number < end && !testing::Test::HasFailure(); ++number)
    expect_parts_played_again(number, sums);
  std::cout << "bytes of claims " << sums.claims << ", of records " << sums.records
            << ", without what their keepers know " << sums.told << ", of snapshots "
            << sums.snapshots << '\n';
  EXPECT_LT(sums.told, sums.records);
}

TEST(StandbyCopy, PlaysThePartAgainBitForBit) { expect_parts_played_again(0, 40); }

/// One impact, which takes longer where flights are slowed.
TEST(PartLog, CountsTheWorkOfAReplayByEventsAndDrag) {
  for (const double drag : {0.0, 0.1}) {
    physics::WorldSpec spec = physics::test::rink_of(4.0, 2.0);
    spec.puck_drag = drag;
    physics::World world(spec);
    world.add(physics::PuckSpec{.position = {0.5, 1.0}, .velocity = {1.0, 0.0}, .radius = 0.05});
    world.add(physics::PuckSpec{.position = {0.9, 1.01}, .velocity = {-1.0, 0.0}, .radius = 0.05});
    const Validator validator(world);
    Assembly assembly(world, Division::into_strips(spec.field, 2), 0.25, 0.1);
    assembly.advance();
    Peer& peer = assembly.peers().front();
    peer.part_log().begin(validator);
    assembly.advance();
    EXPECT_EQ(peer.part_log().record().work, drag > 0.0 ? 2u : 1u);
  }
}

/// A liar's: whoever takes the part over would be named for it by all to whom it hands the body.
TEST(PartReplay, HoldsNoBodyWithoutARestContact) {
  const SharedScene scene = shared_scene(3, 0.1);
  const Validator validator(scene.world);
  PartSnapshot snapshot;
  StatePacker packer(validator);
  for (std::uint32_t body = 0; body < scene.world.body_count(); ++body) {
    BodyState state = physics::Subdomain::state_in(scene.world, body);
    BodyState flagged = state;
    do ++flagged.flags;
    while (!physics::Subdomain::is_held_along(flagged, 0));
    if (state.kind == physics::BodyKind::puck) state = flagged;
    packer.add(body, state);
  }
  snapshot.states = packer.take();
  ASSERT_EQ(fault_of(snapshot, validator, 0.0), "");
  const PartReplay replay(scene.world.spec(), validator, snapshot, 0.0);
  const Part part = replay.part(Cuts::whole(scene.world.spec().field).division(1), 0);
  ASSERT_EQ(part.bodies.size(), scene.world.body_count());
  Handover handed_on;
  handed_on.bodies = part.bodies, handed_on.rest_contacts = part.rest_contacts;
  EXPECT_EQ(validator.fault_of(handed_on, 0.0), "");
}

TEST(KnownBodies, ThatAreNotHereOrCameBeforeTheRunAreRefused) {
  const SharedScene scene = shared_scene(0, 1.0);
  const Validator validator(scene.world);
  const std::uint32_t count = scene.world.body_count();
  Share share(scene.world.spec(), count, 2);
  PartRecord record;
  record.committed.known = {count};
  EXPECT_EQ(put_back_known(record, share, validator),
            "says that body " + std::to_string(count) + " is here, which is not");
  record.committed.known = {0};
  EXPECT_EQ(put_back_known(record, share, validator), "says that body 0 is here, which is not");
  record = {.repeated = {.known = {0}}};
  EXPECT_EQ(put_back_known(record, share, validator), "sends a ghost of a run without its state");
  share.put(0, physics::Subdomain::state_in(scene.world, 0));
  share.add_ghost(0, 1), share.begin_window();
  record = {.committed = {.known = {0, 0}}};
  EXPECT_EQ(put_back_known(record, share, validator), "has body 0 twice");
  record = {.committed = {.states = {1, 2, 3}, .known = {0}}};
  EXPECT_EQ(put_back_known(record, share, validator), "sends what are no states of bodies");
  record = {.committed = {.known = {0}}};
  EXPECT_EQ(put_back_known(record, share, validator), "");
  EXPECT_TRUE(record.committed.known.empty());
  const auto bodies = unpacked(record.committed.states, validator);
  ASSERT_TRUE(bodies && bodies->size() == 1);
  EXPECT_TRUE(are_same(bodies->front().state, share.state(0)));
}

class StandbyCopyLong : public testing::TestWithParam<std::uint64_t> {};
TEST_P(StandbyCopyLong, PlaysThePartAgainBitForBit) {
  expect_parts_played_again(100 + 100 * GetParam(), 200 + 100 * GetParam());
}
INSTANTIATE_TEST_SUITE_P(Part, StandbyCopyLong, testing::Range<std::uint64_t>(0, 5));

}  // namespace
}  // namespace rink::peer::test
