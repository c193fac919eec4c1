// Whole conversations as ambassadors hold them, as hashes of every byte that they send, every
// callback and its arguments, and their counters: who changes how an ambassador works finds out
// here that the wire, or the order of callbacks, has changed as well.
#include <gtest/gtest.h>

#include "tests/rti/scenes/regatta_courses.h"

namespace rink::rti::testing::at_the_regatta {
namespace {

std::uint64_t hash_of(const Course& course, std::uint64_t seed = 1,
                      CallbackModel model = CallbackModel::immediate) {
  Regatta all(seed, seat_count, course.settings, model);
  sail(all, course);
  return all.ambassador_hash();
}

void hush(Regatta& all, Sailor& sailor) {
  if (all.one_in(2)) sailor.ambassador.disable_callbacks();
  else sailor.ambassador.enable_callbacks();
}
void evoke(Regatta& all, Sailor& sailor) {
  sailor.ambassador.evoke_multiple_callbacks(all.below(8));
}
void switch_advisories(Regatta& all, Sailor& sailor) {
  Ambassador& to = sailor.ambassador;
  switch (all.below(6)) {
    case 0:
      return to.enable_object_class_relevance_advisory_switch();
    case 1:
      return to.disable_object_class_relevance_advisory_switch();
    case 2:
      return to.enable_attribute_scope_advisory_switch();
    case 3:
      return to.disable_attribute_scope_advisory_switch();
    case 4:
      return to.enable_interaction_relevance_advisory_switch();
    default:
      return to.disable_interaction_relevance_advisory_switch();
  }
}
/// From now on it updates a boat, if it may, at one in six updates of others, before it looks at
/// what it was told.
void answer(Regatta& all, Sailor& sailor) {
  sailor.meanwhile = [&all, &sailor] {
    if (all.one_in(6)) Regatta::attempt([&] { update(all, sailor); });
  };
}

const std::vector<Service> everything{declare,     register_one, update,     update,    say,
                                      delete_one,  ask,          name,       transport, trade,
                                      trade,       make_region,  use_region, keep_time, say_in_time,
                                      synchronize, manage,       watch};

TEST(AmbassadorHashes, OfDeclarations) {
  EXPECT_EQ(hash_of({{declare, declare, declare, register_one, update, say}, stand_by}),
            0x4240b4079a849f70u);
  EXPECT_EQ(hash_of({{declare, declare, switch_advisories, register_one, update, say}}),
            0xb82b42d8bd2bc624u);
}
TEST(AmbassadorHashes, OfObjects) {
  EXPECT_EQ(hash_of({{register_one, update, update, delete_one, name, ask}}), 0x097319f2c0536881u);
}
TEST(AmbassadorHashes, OfInteractions) {
  EXPECT_EQ(hash_of({{say, say, say, declare}, prepare, 200}), 0xb02058c2c43b784au);
}
TEST(AmbassadorHashes, OfOwnership) {
  EXPECT_EQ(hash_of({{trade, trade, trade, trade, register_one, update, declare}}),
            0x2e8a2b5aa1f6e503u);
}
TEST(AmbassadorHashes, OfLeaving) {
  EXPECT_EQ(hash_of({{register_one, trade, trade, update, synchronize, name, watch}, prepare, 12}),
            0x5112b4b323d0ab96u);
}
TEST(AmbassadorHashes, OfRegions) {
  EXPECT_EQ(hash_of({{make_region, use_region, use_region, register_one, update, declare, trade},
                     prepare,
                     40,
                     0,
                     false,
                     filtered("region")}),
            0x32c776b2c4b53a83u);
}
TEST(AmbassadorHashes, OfTimeManagement) {
  const std::vector<Service> services{keep_time,   keep_time,    keep_time,  say_in_time,
                                      say_in_time, register_one, delete_one, update};
  EXPECT_EQ(hash_of({services}), 0x31174cceb5915951u);
  EXPECT_EQ(hash_of({services, prepare, 40}), 0xe4bdec09db945c13u);
  EXPECT_EQ(
      hash_of(
          {{keep_time, say_in_time, register_one, trade, trade, declare, say, hush}, prepare, 60}),
      0x0d446402b173d03bu);
}
TEST(AmbassadorHashes, OfBestEffort) {
  const std::vector<Service> services{register_one, update,    update,     update,
                                      update,       transport, delete_one, say};
  EXPECT_EQ(hash_of({services, prepare, 0, 400}), 0x703c12b6708cd8afu);
  EXPECT_EQ(hash_of({services, prepare, 30, 300}), 0xb9421fa83498ec4bu);
  EXPECT_EQ(
      hash_of({{register_one, update, update, trade, declare, keep_time, hush}, prepare, 0, 400}),
      0xa5d4507814befd59u);
}
TEST(AmbassadorHashes, OfUpdatesWithinCallbacks) {
  EXPECT_EQ(hash_of({{register_one, update, update, say, answer}}), 0xb6dab850a7c9dda7u);
  EXPECT_EQ(hash_of({{register_one, update, update, transport, answer}, prepare, 0, 400}),
            0x89e92a774c010911u);
}
TEST(AmbassadorHashes, OfManagement) {
  EXPECT_EQ(hash_of({{manage, manage, declare, register_one, update, say, synchronize}}),
            0x8847ecc857a5d837u);
  EXPECT_EQ(hash_of({{manage, manage, manage, register_one, keep_time, trade, watch}, prepare, 25}),
            0xaab919d381b6c90bu);
}
TEST(AmbassadorHashes, OfLittleRoom) {
  EXPECT_EQ(hash_of({{register_one, update, keep_time, keep_time, say_in_time, say_in_time},
                     prepare,
                     80,
                     0,
                     false,
                     cramped()}),
            0xc15ae90d0848a132u);
}
TEST(AmbassadorHashes, OfHeldAndEvokedCallbacks) {
  std::vector<Service> services = everything;
  services.insert(services.end(), {hush, evoke, evoke, evoke});
  const Course course{services, prepare, 60, 350, false, filtered("region")};
  EXPECT_EQ(hash_of(course, 1), 0x99be4db22c97d509u);
  EXPECT_EQ(hash_of(course, 1, CallbackModel::evoked), 0x0a37141eb7002ce3u);
}
TEST(AmbassadorHashes, OfEverythingAtOnce) {
  const Course course{everything, prepare, 60, 350, true, filtered("region")};
  EXPECT_EQ(hash_of(course, 1), 0x34b5b42bae21764eu);
  EXPECT_EQ(hash_of(course, 2), 0xdaa4b47a69c62cfau);
  EXPECT_EQ(hash_of(course, 3), 0x3d338644621ff3d5u);
}

}  // namespace
}  // namespace rink::rti::testing::at_the_regatta
