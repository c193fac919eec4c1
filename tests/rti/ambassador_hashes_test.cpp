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
            0x12b9b15cfcf21e09u);
  EXPECT_EQ(hash_of({{declare, declare, switch_advisories, register_one, update, say}}),
            0x22aef21912aa5febu);
}
TEST(AmbassadorHashes, OfObjects) {
  EXPECT_EQ(hash_of({{register_one, update, update, delete_one, name, ask}}), 0xb5e7ab6dbf2595ccu);
}
TEST(AmbassadorHashes, OfInteractions) {
  EXPECT_EQ(hash_of({{say, say, say, declare}, prepare, 200}), 0xb6bc9c784fea8b0fu);
}
TEST(AmbassadorHashes, OfOwnership) {
  EXPECT_EQ(hash_of({{trade, trade, trade, trade, register_one, update, declare}}),
            0xc2ec5766785c5d08u);
}
TEST(AmbassadorHashes, OfLeaving) {
  EXPECT_EQ(hash_of({{register_one, trade, trade, update, synchronize, name, watch}, prepare, 12}),
            0x1cca34b2dc9220e4u);
}
TEST(AmbassadorHashes, OfRegions) {
  EXPECT_EQ(hash_of({{make_region, use_region, use_region, register_one, update, declare, trade},
                     prepare,
                     40,
                     0,
                     false,
                     filtered("region")}),
            0x163087c2a049bde4u);
}
TEST(AmbassadorHashes, OfTimeManagement) {
  const std::vector<Service> services{keep_time,   keep_time,    keep_time,  say_in_time,
                                      say_in_time, register_one, delete_one, update};
  EXPECT_EQ(hash_of({services}), 0x2bf5e0d7f4a9dd8bu);
  EXPECT_EQ(hash_of({services, prepare, 40}), 0x3577afc314bf60cau);
  EXPECT_EQ(
      hash_of(
          {{keep_time, say_in_time, register_one, trade, trade, declare, say, hush}, prepare, 60}),
      0xcc8ca87ab43118d3u);
}
TEST(AmbassadorHashes, OfBestEffort) {
  const std::vector<Service> services{register_one, update,    update,     update,
                                      update,       transport, delete_one, say};
  EXPECT_EQ(hash_of({services, prepare, 0, 400}), 0xb13b71d54cd1495du);
  EXPECT_EQ(hash_of({services, prepare, 30, 300}), 0x012dced1033255f2u);
  EXPECT_EQ(
      hash_of({{register_one, update, update, trade, declare, keep_time, hush}, prepare, 0, 400}),
      0x3e3d237f647526d6u);
}
TEST(AmbassadorHashes, OfUpdatesWithinCallbacks) {
  EXPECT_EQ(hash_of({{register_one, update, update, say, answer}}), 0x8c92cc288849a104u);
  EXPECT_EQ(hash_of({{register_one, update, update, transport, answer}, prepare, 0, 400}),
            0x72bb807a218f9061u);
}
TEST(AmbassadorHashes, OfManagement) {
  EXPECT_EQ(hash_of({{manage, manage, declare, register_one, update, say, synchronize}}),
            0xb3c8051cfe8a68d9u);
  EXPECT_EQ(hash_of({{manage, manage, manage, register_one, keep_time, trade, watch}, prepare, 25}),
            0x4466d51bebf7063fu);
}
TEST(AmbassadorHashes, OfLittleRoom) {
  EXPECT_EQ(hash_of({{register_one, update, keep_time, keep_time, say_in_time, say_in_time},
                     prepare,
                     80,
                     0,
                     false,
                     cramped()}),
            0xa81ac0f26419316bu);
}
TEST(AmbassadorHashes, OfHeldAndEvokedCallbacks) {
  std::vector<Service> services = everything;
  services.insert(services.end(), {hush, evoke, evoke, evoke});
  const Course course{services, prepare, 60, 350, false, filtered("region")};
  EXPECT_EQ(hash_of(course, 1), 0x0c62f14a088e018eu);
  EXPECT_EQ(hash_of(course, 1, CallbackModel::evoked), 0x39820f7d52ef2603u);
}
TEST(AmbassadorHashes, OfEverythingAtOnce) {
  const Course course{everything, prepare, 60, 350, true, filtered("region")};
  EXPECT_EQ(hash_of(course, 1), 0x936e870216a9e5f8u);
  EXPECT_EQ(hash_of(course, 2), 0xe5c8de79c46c4d4bu);
  EXPECT_EQ(hash_of(course, 3), 0x5a5f9ed4d7f53805u);
}

}  // namespace
}  // namespace rink::rti::testing::at_the_regatta
