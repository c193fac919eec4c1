// What a peer knows of bodies, halos and keys between two windows, each subject by itself.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "game/peer/session/part_change.h"
#include "game/peer/window/accusation.h"
#include "game/peer/window/homes.h"
#include "game/peer/window/part_changes.h"
#include "game/peer/window/timed_keys.h"
#include "tests/peer/shared_scenes.h"

namespace rink::peer::test {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

TEST(Roles, KeepOwnBodiesWithoutGapsAndGhostsByNumber) {
  Roles roles(6);
  for (const std::uint32_t body : {4u, 1u, 3u}) roles.own(body);
  roles.add_ghost(5, 2), roles.add_ghost(0, 1);
  roles.disown(4);
  EXPECT_THAT(roles.owned(), ElementsAre(3u, 1u)) << "the last one has filled the gap";
  EXPECT_THAT(roles.ghosts(), ElementsAre(0u, 5u));
  EXPECT_TRUE(roles.has_ghost_of(2, 5) && !roles.has_ghost_of(1, 5));
  roles.disown(1), roles.disown(3);
  EXPECT_THAT(roles.owned(), IsEmpty());
  roles.remove_ghost(0);
  EXPECT_EQ(roles.place_of_ghost(5), 0u);
  EXPECT_EQ(roles.of(0), Role::away);
  roles.check();
}

TEST(Halos, CountOthersThatArePresentAlone) {
  Halos halos(Division::into_strips(field, 3), 0, 0.25);
  halos.set(1, 0.5), halos.set(2, infinity);
  EXPECT_EQ(halos.widest_other(), infinity);
  halos.set_present(2, false);
  EXPECT_EQ(halos.widest_other(), 0.5);
  EXPECT_FALSE(halos.are_whole());
  halos.set(0, infinity), halos.set(1, infinity);
  EXPECT_TRUE(halos.are_whole()) << "whoever is absent does not count";
  halos.divide(Division::into_strips(field, 4), 0.125);
  EXPECT_EQ(halos.of(3), 0.125);
  EXPECT_EQ(halos.present_count(), 2u) << "a new one is not present yet";
}

TEST(TimedKeys, TakeEffectInTheirWindowWhereTheBatIs) {
  Roles roles(4);
  roles.own(0), roles.add_ghost(1, 1);
  TimedKeys keys;
  const std::vector<Key> pressed{{0.3, 0, {1.0, 0.0}, 7}, {0.1, 0, {0.0, 0.0}, 5},
                                 {0.1, 1, {0.0, 0.0}, 6}, {0.3, 1, {0.0, 0.0}, 6},
                                 {0.1, 2, {0.0, 0.0}, 6}, {0.1, 9, {0.0, 0.0}, 6}};
  keys.add(pressed);
  keys.begin_window(0.2, roles);
  EXPECT_EQ(keys.due().size(), 2u) << "of the own bat and of the ghost";
  ASSERT_EQ(keys.later().size(), 1u) << "only an own bat's: a ghost's owner has it";
  EXPECT_EQ(keys.later().front().input, 7);
  keys.note_log(roles);
  ASSERT_EQ(keys.log().size(), 1u);
  EXPECT_EQ(keys.log().front().input, 5);
  keys.end_at(0.05, roles);
  EXPECT_THAT(keys.due(), IsEmpty()) << "the window ends before";
  EXPECT_EQ(keys.later().size(), 2u);
}

TEST(Accusation, NamesTheFirstLiar) {
  Accusation accusation;
  EXPECT_FALSE(accusation.is_made());
  EXPECT_FALSE(accusation.report(3, "lies"));
  accusation.report(1, "lies too");
  EXPECT_EQ(accusation.text(), "peer 3 lies");
  EXPECT_EQ(accusation.peer(), 3u);
}

/// Four pucks at rest in the left strip of two, ever nearer to the border at x = 2 m; the fifth is
/// beyond it.
struct LeftShare {
  physics::World world{physics::test::rink_of(4.0, 2.0)};
  Halos halos{Division::into_strips(field, 2), 0, 0.25};
  std::vector<std::uint32_t> all;
  Share share{world.spec(), 5, 2};
  LeftShare() {
    for (const double x : {0.5, 1.0, 1.5, 1.9, 2.1}) {
      all.push_back(world.add(physics::PuckSpec{.position = {x, 1.0}, .radius = 0.05}).index);
      share.put(all.back(), physics::Subdomain::state_in(world, all.back()));
    }
  }
  Settlement begin() {
    share.begin_window();
    return share.settle(all, halos);
  }
};

TEST(Share, KnowsWhoOwnsABodyAndWhoHasItAsAGhost) {
  LeftShare left;
  const Settlement settled = left.begin();
  EXPECT_THAT(settled.own, ElementsAre(0u, 1u, 2u, 3u));
  EXPECT_EQ(settled.came, settled.own);
  EXPECT_THAT(settled.left, IsEmpty());
  EXPECT_THAT(left.share.roles().ghosts(), ElementsAre(4u));
  EXPECT_THAT(left.share.known(1), ElementsAre(3u)) << "the others are outside its halo";
  EXPECT_FALSE(left.share.knows(1, 2));
  EXPECT_EQ(left.share.extent_max(), 0.05);
  left.halos.divide(Division(field, {{{0.0, 0.0, 1.25, 2.0}, 0}, {{1.25, 0.0, 4.0, 2.0}, 1}}, 2),
                    0.25);
  const Settlement shifted = left.share.settle(left.all, left.halos);
  EXPECT_THAT(shifted.own, ElementsAre(0u, 1u));
  EXPECT_THAT(shifted.came, IsEmpty());
  EXPECT_THAT(shifted.left, ElementsAre(2u, 3u));
  EXPECT_THAT(left.share.roles().ghosts(), ElementsAre(2u));
  EXPECT_FALSE(left.share.subdomain().is_there(3)) << "beyond the halo";
  left.share.check(0);
}

TEST(Homes, AreOutOfReachOfOtherHalos) {
  LeftShare left;
  Homes homes(left.share, left.halos);
  Window window{.end = 0.01};
  homes.settle(left.begin(), window);
  homes.choose_watched(window);
  left.share.play({}, window.end);
  homes.find_edge();
  EXPECT_THAT(homes.edge(), ElementsAre(3u)) << "0.25 m, and a quarter more with its radius";
  ASSERT_EQ(homes.outskirts().size(), 1u);
  EXPECT_EQ(homes.outskirts().front().body, 3u);
  EXPECT_TRUE(homes.are_fit());
  homes.check();
  left.halos.set(1, 0.5);
  EXPECT_FALSE(homes.are_fit()) << "a wider halo reaches further";
  homes.choose(window);
  homes.find_edge();
  EXPECT_THAT(homes.edge(), ElementsAre(2u, 3u));
  EXPECT_TRUE(homes.are_safe());
  left.halos.set_annexes(1, {{0.5, 0.5, 1.9, 0.6}});
  EXPECT_FALSE(homes.are_safe()) << "an annex reaches further";
}

TEST(PartChanges, ListWhatChangedAndAllIfAsked) {
  LeftShare left;
  PartChanges changes;
  changes.note(left.begin());
  EXPECT_THAT(changes.change(left.share, {}, false).bodies, IsEmpty()) << "before it begins";
  changes.begin();
  changes.note({.own = {}, .came = {2, 1, 2}, .left = {4}});
  const PartChange change = changes.change(left.share, {}, false);
  ASSERT_EQ(change.bodies.size(), 2u);
  EXPECT_EQ(change.bodies.front().number, 1u);
  EXPECT_THAT(change.gone, ElementsAre(4u));
  EXPECT_EQ(changes.change(left.share, {}, true).bodies.size(), 4u);
  changes.note_window(left.share);
  EXPECT_THAT(changes.change(left.share, {}, false).gone, IsEmpty()) << "of the window before";
}

TEST(PartChanges, AreShortWhereNothingChangedAndReadAsTheyWereWritten) {
  PartChange change{.step = 100,
                    .time = 1.5,
                    .bodies = {},
                    .gone = {},
                    .rest_contacts = {},
                    .keys = {},
                    .log = {}};
  EXPECT_EQ(written(change).size(), 14u) << "head, step, time, checksum";
  change.is_whole = true;
  change.gone = {3, 5};
  change.log = {{.time = 1.25, .bat = 2, .input = 1}};
  const std::vector<std::uint8_t> bytes = written(change);
  PartChange received;
  ASSERT_TRUE(read(bytes, received));
  EXPECT_EQ(written(received), bytes);
  EXPECT_TRUE(received.is_whole && received.step == 100 && received.time == 1.5);
  EXPECT_THAT(received.gone, ElementsAre(3u, 5u));
  ASSERT_EQ(received.log.size(), 1u);
  EXPECT_EQ(received.log.front().bat, 2u);
}

}  // namespace
}  // namespace rink::peer::test
