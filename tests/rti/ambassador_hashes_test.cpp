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
            0x252f7bae507c7d30u);
  EXPECT_EQ(hash_of({{declare, declare, switch_advisories, register_one, update, say}}),
            0xb43f54b611298cfdu);
}
TEST(AmbassadorHashes, OfObjects) {
  EXPECT_EQ(hash_of({{register_one, update, update, delete_one, name, ask}}), 0x08134ba58626f695u);
}
TEST(AmbassadorHashes, OfInteractions) {
  EXPECT_EQ(hash_of({{say, say, say, declare}, prepare, 200}), 0x54540d3531d290b7u);
}
TEST(AmbassadorHashes, OfOwnership) {
  EXPECT_EQ(hash_of({{trade, trade, trade, trade, register_one, update, declare}}),
            0x498cba5652cb91deu);
}
TEST(AmbassadorHashes, OfLeaving) {
  EXPECT_EQ(hash_of({{register_one, trade, trade, update, synchronize, name, watch}, prepare, 12}),
            0x0659c61c53ecf867u);
}
TEST(AmbassadorHashes, OfRegions) {
  EXPECT_EQ(hash_of({{make_region, use_region, use_region, register_one, update, declare, trade},
                     prepare,
                     40,
                     0,
                     false,
                     filtered("region")}),
            0x7fec1b51bfbe3fa2u);
}
TEST(AmbassadorHashes, OfTimeManagement) {
  const std::vector<Service> services{keep_time,   keep_time,    keep_time,  say_in_time,
                                      say_in_time, register_one, delete_one, update};
  EXPECT_EQ(hash_of({services}), 0x37e4ccc82eb272f7u);
  EXPECT_EQ(hash_of({services, prepare, 40}), 0xc57ac8b35a8869a1u);
  EXPECT_EQ(
      hash_of(
          {{keep_time, say_in_time, register_one, trade, trade, declare, say, hush}, prepare, 60}),
      0x391d50e79932d659u);
}
TEST(AmbassadorHashes, OfBestEffort) {
  const std::vector<Service> services{register_one, update,    update,     update,
                                      update,       transport, delete_one, say};
  EXPECT_EQ(hash_of({services, prepare, 0, 400}), 0x1b53a5994a160b5cu);
  EXPECT_EQ(hash_of({services, prepare, 30, 300}), 0xff692a9182ad9f32u);
  EXPECT_EQ(
      hash_of({{register_one, update, update, trade, declare, keep_time, hush}, prepare, 0, 400}),
      0x398950cbbc391665u);
}
TEST(AmbassadorHashes, OfUpdatesWithinCallbacks) {
  EXPECT_EQ(hash_of({{register_one, update, update, say, answer}}), 0x37b1726b7d217445u);
  EXPECT_EQ(hash_of({{register_one, update, update, transport, answer}, prepare, 0, 400}),
            0xb4dd587967e3e5b4u);
}
TEST(AmbassadorHashes, OfManagement) {
  EXPECT_EQ(hash_of({{manage, manage, declare, register_one, update, say, synchronize}}),
            0x05c9b5f89ea75f45u);
  EXPECT_EQ(hash_of({{manage, manage, manage, register_one, keep_time, trade, watch}, prepare, 25}),
            0xd513c343977ddf2cu);
}
TEST(AmbassadorHashes, OfLittleRoom) {
  EXPECT_EQ(hash_of({{register_one, update, keep_time, keep_time, say_in_time, say_in_time},
                     prepare,
                     80,
                     0,
                     false,
                     cramped()}),
            0x072ef31ea49c113bu);
}
TEST(AmbassadorHashes, OfHeldAndEvokedCallbacks) {
  std::vector<Service> services = everything;
  services.insert(services.end(), {hush, evoke, evoke, evoke});
  const Course course{services, prepare, 60, 350, false, filtered("region")};
  EXPECT_EQ(hash_of(course, 1), 0x872b873e1573bbd9u);
  EXPECT_EQ(hash_of(course, 1, CallbackModel::evoked), 0x8a0923a676c9522fu);
}
TEST(AmbassadorHashes, OfEverythingAtOnce) {
  const Course course{everything, prepare, 60, 350, true, filtered("region")};
  EXPECT_EQ(hash_of(course, 1), 0xa31783aa2ff22086u);
  EXPECT_EQ(hash_of(course, 2), 0xf159e72862cda05cu);
  EXPECT_EQ(hash_of(course, 3), 0xb7d78b623afc540bu);
}

}  // namespace
}  // namespace rink::rti::testing::at_the_regatta
