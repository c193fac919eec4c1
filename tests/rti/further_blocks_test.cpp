// A federate registers as many objects as it likes in its life: when a block of handles is used up,
// the RTI has given it a further one.
#include <gtest/gtest.h>

#include <string>

#include "rti/wire/declaration_messages.h"
#include "rti/wire/membership_messages.h"
#include "rti/wire/message.h"
#include "tests/rti/bare.h"
#include "tests/rti/rig.h"
#include "tests/rti/warden.h"

namespace rink::rti::testing {
namespace {

const AttributeSet both{position, speed};

struct Life {
  Rig rig{Carrier::in_process};
  Station &owner = rig.join("owner"), &watcher = rig.join("watcher");

  Life() {
    owner.ambassador.publish_object_class_attributes(vessel, both);
    rig.settle();
  }
  ObjectHandle place(std::string_view name = {}) {
    return owner.ambassador.register_object_instance(vessel, name);
  }
  /// Registers and deletes `count` objects, a few thousand to a round; true if each had a handle.
  bool come_and_go(std::uint32_t count) {
    bool are_all_there = true;
    for (std::uint32_t i = 0; i < count; ++i) {
      const ObjectHandle object = place();
      are_all_there = are_all_there && object;
      if (object) owner.ambassador.delete_object_instance(object);
      if (i % 4096 == 4095) rig.round();
    }
    rig.round();
    return are_all_there;
  }
};

TEST(FurtherBlocks, LetAFederateRegisterMoreThanABlockHolds) {
  Life life;
  const ObjectHandle first = life.place("first");
  EXPECT_TRUE(life.come_and_go(object_block - 1));
  EXPECT_TRUE(life.come_and_go(1000)) << "in the further block";
  const ObjectHandle later = life.place("later");
  ASSERT_TRUE(later);
  EXPECT_NE(later.value / object_block, first.value / object_block);
  life.rig.settle();
  EXPECT_TRUE(life.owner.ambassador.is_joined()) << life.owner.heard.lost;
  EXPECT_EQ(life.rig.execution().object_count(), 2u);

  // Objects of both blocks live on alike.
  life.watcher.ambassador.subscribe_object_class_attributes(vessel, both);
  life.rig.settle();
  ASSERT_EQ(life.watcher.heard.objects.size(), 2u);
  for (const ObjectHandle each : {first, later})
    life.owner.ambassador.update_attribute_values(each, both, values_of(1.0f, 2.0f, 3.0f),
                                                  {1.0, 0});
  life.rig.settle();
  EXPECT_EQ(life.watcher.heard.objects.at(first.value).updates, 1);
  EXPECT_EQ(life.watcher.heard.objects.at(later.value).updates, 1);
  life.owner.ambassador.delete_object_instance(first);
  life.rig.settle();
  EXPECT_EQ(life.watcher.heard.objects.count(first.value), 0u);
  EXPECT_EQ(life.rig.execution().object_count(), 1u);
  EXPECT_TRUE(life.owner.ambassador.is_joined()) << life.owner.heard.lost;
}

TEST(FurtherBlocks, GoWithTheFederateAndAllThatIsInThem) {
  Life life;
  ASSERT_TRUE(life.place());
  EXPECT_TRUE(life.come_and_go(object_block - 1));
  ASSERT_TRUE(life.place());
  life.rig.settle();
  ASSERT_EQ(life.rig.execution().object_count(), 2u);
  life.owner.ambassador.resign();
  life.rig.settle();
  EXPECT_EQ(life.rig.execution().object_count(), 0u);
}

TEST(FurtherBlocks, LeaveTheLimitOfWhatIsThereAtOnce) {
  FederationSettings settings;
  settings.objects_per_federate_max = 100;
  Rig rig(Carrier::in_process, settings);
  Station& owner = rig.join("owner");
  owner.ambassador.publish_object_class_attributes(vessel, both);
  std::vector<ObjectHandle> objects;
  for (int i = 0; i < 100; ++i)
    objects.push_back(owner.ambassador.register_object_instance(vessel));
  for (int i = 0; i < 50; ++i) {
    owner.ambassador.delete_object_instance(objects[static_cast<std::size_t>(i)]);
    owner.ambassador.register_object_instance(vessel);
  }
  rig.settle();
  EXPECT_TRUE(owner.ambassador.is_joined()) << "150 in its life, 100 at once";
  EXPECT_EQ(rig.execution().object_count(), 100u);
  owner.ambassador.register_object_instance(vessel);
  rig.settle();
  EXPECT_FALSE(owner.heard.lost.empty());
  EXPECT_EQ(rig.execution().counters().drops[static_cast<std::size_t>(Violation::over_limit)], 1u);
}

/// Who enters from now on leaves a block behind that was used, `first` and all that follow.
void use_up_all_blocks(Bare& bare, std::uint32_t first, ConnectionId connection) {
  for (std::uint32_t block = first; block < object_block_max; ++block, ++connection) {
    bare.enter(connection, "guest");
    bare.execution.receive(
        connection,
        frame_of(PublishObjectClassMessage{vessel_number, both.bits},
                 RegisterObjectMessage{block * object_block, vessel_number, ""}, ResignMessage{}));
    bare.tick();
  }
}

/// The handle behind the last of a block is the first of another's.
TEST(FurtherBlocks, AreNotTakenFromOthersByWhoIsGivenNone) {
  Bare bare;
  const auto come_and_go = [&](ObjectHandle object) {
    bare.execution.receive(1, frame_of(RegisterObjectMessage{object.value, vessel_number, ""},
                                       DeleteObjectMessage{object.value}));
  };
  bare.enter(1, "hoarder");
  bare.execution.receive(1, frame_of(PublishObjectClassMessage{vessel_number, both.bits}));
  use_up_all_blocks(bare, 2, 2);
  for (std::uint32_t number = 0; number < object_block; ++number) {
    come_and_go({object_block + number});
    if (number % 4096 == 0) bare.tick();
  }
  bare.tick();
  ASSERT_EQ(bare.dropped.count(1), 0u) << bare.dropped[1];
  come_and_go({2 * object_block});
  bare.tick();
  EXPECT_EQ(bare.drops(Violation::over_limit), 1u);
  EXPECT_EQ(bare.execution.object_count(), 0u);
}

/// The RTI itself, which is the owner of management objects, is no exception.
TEST(FurtherBlocks, AreNotTakenFromOthersByTheRti) {
  Bare bare;
  const ObjectHandle own = bare.witness.register_object_instance(vessel);
  ASSERT_EQ(own.value, 0u) << "the handle that would come after the last of all";
  use_up_all_blocks(bare, 1, 1);
  bare.witness.subscribe_object_class_attributes(federate_class,
                                                 harbour().attributes(federate_class));
  bare.tick();
  bare.tick();
  EXPECT_EQ(bare.execution.object_count(), 1u) << "the witness's alone";
  EXPECT_TRUE(bare.witness_heard.objects.empty());
  EXPECT_TRUE(bare.witness.is_joined()) << bare.witness_heard.lost;
}

/// Each subscription after a time without registers the federation's object and one for each
/// federate.
TEST(FurtherBlocks, AreNotTakenByTheRtiOnceItHasUsedItsOwn) {
  constexpr std::uint32_t federates = 100, reported = federates + 1, rti_block = federates;
  Bare bare;
  for (ConnectionId connection = 1; connection < federates; ++connection) {
    bare.execution.connect(connection);
    bare.execution.receive(connection, frame_of(join_of("f" + std::to_string(connection))));
  }
  bare.tick();
  const auto look = [&] {
    bare.witness.subscribe_object_class_attributes(federation_class,
                                                   harbour().attributes(federation_class));
    bare.tick();
  };
  const auto look_away = [&] {
    bare.witness.unsubscribe_object_class(federation_class);
    bare.tick();
    ASSERT_EQ(bare.execution.object_count(), 0u);
  };
  look();
  ASSERT_EQ(bare.execution.object_count(), reported);
  look_away();
  use_up_all_blocks(bare, rti_block + 1, federates);
  std::uint32_t left = object_block - reported;
  for (; left >= reported; left -= reported) {
    look();
    ASSERT_EQ(bare.execution.object_count(), reported);
    look_away();
  }
  look();
  EXPECT_EQ(bare.execution.object_count(), left) << "as many as there are handles";
  ASSERT_EQ(bare.witness_heard.objects.size(), 1u);
  EXPECT_EQ(bare.witness_heard.objects.begin()->first / object_block, rti_block);
  look_away();
  look();
  EXPECT_EQ(bare.execution.object_count(), 0u);
  EXPECT_TRUE(bare.witness_heard.objects.empty());
  EXPECT_TRUE(bare.witness.is_joined()) << bare.witness_heard.lost;
}

}  // namespace
}  // namespace rink::rti::testing
