// Ownership between federates as the RTI serves it: who may ask what, who is told, and what is left
// of one who leaves.
#include "rti/federation/services/ownership_service.h"

#include <gtest/gtest.h>

#include <string>
#include <string_view>
#include <vector>

#include "tests/rti/federation/service_ground.h"

namespace rink::rti {
namespace {

struct Told {
  OwnershipNotice notice;
  std::uint32_t object;
  AttributeBits attributes;
  std::string tag;
  friend bool operator==(const Told&, const Told&) = default;
};

std::ostream& operator<<(std::ostream& stream, const Told& told) {
  return stream << "notice " << int{static_cast<std::uint8_t>(told.notice)} << " of object "
                << told.object << ", attributes " << static_cast<std::uint32_t>(told.attributes)
                << " '" << told.tag << "'";
}

/// Ann has registered a body; Bob publishes bodies and knows it, and Eve knows it only.
struct Quay : ServiceGround, ::testing::Test {
  std::uint32_t join(std::string_view name) {
    const std::uint32_t slot = admit(name);
    owners.joined(slot);
    return slot;
  }
  void SetUp() override {
    objects.publications.set_class(bob, body_class, both);
    for (const std::uint32_t slot : {bob, eve}) ground.distribution->of(slot).known.insert(boat);
  }
  Status ask(std::uint32_t slot, OwnershipRequest request, AttributeSet attributes,
             std::string_view tag = "", std::uint32_t object = 0xffffffff) {
    std::vector<std::byte> bytes;
    ObjectBlockWriter().append(
        bytes,
        OwnershipRequestMessage{static_cast<std::uint8_t>(request), attributes.bits,
                                std::as_bytes(std::span(tag))},
        object == 0xffffffff ? number_of(boat) : object);
    Reader reader(Bytes(bytes).subspan(1));
    return owners.handle_requests(slot, reader);
  }
  /// What it was told of ownership since it was asked last.
  std::vector<Told> told(std::uint32_t slot) {
    std::vector<Told> all;
    Reader reader(federate(slot).outbox.tail());
    while (!reader.is_at_end()) {
      std::uint8_t kind = 0;
      OwnershipNoticeMessage message;
      EXPECT_TRUE(reader.number(kind) && exchange(reader, message));
      EXPECT_EQ(kind, static_cast<std::uint8_t>(MessageKind::ownership_notice));
      const auto* letters = reinterpret_cast<const char*>(message.tag.data());
      EXPECT_TRUE(read_objects(reader, [&](ObjectHandle object) {
        all.push_back({static_cast<OwnershipNotice>(message.word), object.value, message.attributes,
                       std::string(letters, message.tag.size())});
        return true;
      }));
    }
    federate(slot).outbox.clear();
    return all;
  }
  Told of_boat(OwnershipNotice notice, AttributeSet attributes, std::string tag = "") const {
    return {notice, number_of(boat), attributes.bits, std::move(tag)};
  }
  using Words = std::vector<Told>;
  using Request = OwnershipRequest;
  using Notice = OwnershipNotice;

  OwnershipService owners{ground.basis(),
                          {ground.ownership, *ground.distribution, objects.publications,
                           objects.known, objects.newest, objects.objects}};
  const std::uint32_t ann = join("ann"), bob = join("bob"), eve = join("eve");
  const ObjectSlot boat = add_object(ann, body_class);
  const AttributeSet privilege{privilege_to_delete_object};
};

TEST_F(Quay, LetsOnlyAnOwnerGiveAndOnlyAPublisherTake) {
  EXPECT_EQ(ask(bob, Request::offer, position), Violation::not_owned);
  EXPECT_EQ(ask(bob, Request::divest, position), Violation::not_owned);
  EXPECT_EQ(ask(eve, Request::acquire, position), Violation::undeclared);
  EXPECT_EQ(ask(bob, Request::acquire, AttributeSet(1u << 9)), Violation::unknown_name);
  EXPECT_EQ(ask(bob, Request::acquire, position, "", 12345), Violation::unknown_name);
  const std::uint32_t stranger = join("stranger");
  objects.publications.set_class(stranger, body_class, both);
  EXPECT_EQ(ask(stranger, Request::acquire, position), Violation::unknown_name)
      << "it does not know the object";
  EXPECT_EQ(ground.ownership.owned_by(ann, boat), both | privilege);
}

TEST_F(Quay, AsksAnOwnerToReleaseWhatIsWantedAndTellsBothWhenItIsGiven) {
  EXPECT_EQ(ask(bob, Request::acquire, position, "please"), Status());
  EXPECT_EQ(told(ann), Words{of_boat(Notice::release_requested, position, "please")});
  EXPECT_EQ(told(bob), Words{});
  EXPECT_EQ(ask(ann, Request::give_if_wanted, both), Status());
  EXPECT_EQ(told(ann), (Words{of_boat(Notice::divested, position), of_boat(Notice::kept, colour)}));
  EXPECT_EQ(told(bob), Words{of_boat(Notice::acquired, position)});
  EXPECT_EQ(ground.ownership.owned_by(bob, boat), position);
  EXPECT_EQ(ground.ownership.owned_by(ann, boat), colour | privilege);
}

TEST_F(Quay, TellsWhoAsksIfAvailableThatItIsNot) {
  ask(bob, Request::acquire_if_available, both);
  EXPECT_EQ(told(bob), Words{of_boat(Notice::unavailable, both)});
  EXPECT_EQ(told(ann), Words{});
}

/// Others hear of it only as far as they may own it.
TEST_F(Quay, OffersToThoseWhoPublishAndKnowTheObject) {
  objects.publications.set_class(bob, body_class, position);
  ask(ann, Request::offer, both, "who?");
  EXPECT_EQ(told(bob), Words{of_boat(Notice::assumption_requested, position, "who?")});
  EXPECT_EQ(told(eve), Words{});
  ask(bob, Request::acquire, position);
  EXPECT_EQ(told(ann), Words{of_boat(Notice::confirmation_requested, position)});
  ask(ann, Request::confirm, position, "yours");
  EXPECT_EQ(told(bob), Words{of_boat(Notice::acquired, position, "yours")});
  EXPECT_EQ(ground.ownership.owner_of(boat, AttributeHandle{0}), bob);
}

TEST_F(Quay, TakesWhatIsNoLongerPublishedAndOffersItToOthers) {
  const AttributeSet before = objects.publications.set_class(ann, body_class, colour);
  owners.published_changed(ann, body_class, before);
  EXPECT_EQ(ground.ownership.owned_by(ann, boat), colour | privilege);
  EXPECT_EQ(ground.ownership.unowned(boat), position);
  EXPECT_EQ(told(bob), Words{of_boat(Notice::assumption_requested, position)});
  owners.published_changed(ann, body_class, objects.publications.set_class(ann, body_class, {}));
  EXPECT_EQ(ground.ownership.unowned(boat), both | privilege)
      << "who publishes nothing of a class cannot delete its objects either";
}

TEST_F(Quay, OffersWhatHasNoOwnerToWhoBeginsToPublish) {
  ask(ann, Request::divest, both);
  told(bob), told(eve);
  objects.publications.set_class(eve, body_class, position);
  owners.published_changed(eve, body_class, {});
  EXPECT_EQ(told(eve), Words{of_boat(Notice::assumption_requested, position)});
  EXPECT_EQ(told(bob), Words{}) << "it was asked already";
}

TEST_F(Quay, DeletesOrDivestsWhatOneWhoLeavesHadAsItChose) {
  const ObjectSlot raft = add_object(bob, body_class);
  ground.distribution->of(ann).known.insert(raft);
  hand_in(ResignDirectiveMessage{static_cast<std::uint8_t>(
              ResignAction::unconditionally_divest_attributes)},
          [&](Reader& reader) { return owners.handle_resign_directive(bob, reader); });
  owners.left(bob);
  EXPECT_TRUE(ground.objects[raft].is_alive);
  EXPECT_EQ(ground.ownership.unowned(raft), both | privilege);
  hand_in(ResignDirectiveMessage{static_cast<std::uint8_t>(ResignAction::delete_objects)},
          [&](Reader& reader) { return owners.handle_resign_directive(ann, reader); });
  owners.left(ann);
  EXPECT_FALSE(ground.objects[boat].is_alive);
}

TEST_F(Quay, SaysWhoOwnsAnAttribute) {
  const auto owner_told = [&] {
    const std::uint8_t number = static_cast<std::uint8_t>(AttributeHandle{0}.value);
    EXPECT_EQ(hand_in(QueryOwnershipMessage{number_of(boat), number},
                      [&](Reader& reader) { return owners.handle_query(eve, reader); }),
              Status());
    std::uint32_t owner = 0;
    for_each_said_to<InformOwnershipMessage>(
        federate(eve), [&](const auto& message) { owner = message.federate; });
    return owner;
  };
  EXPECT_EQ(owner_told(), federate(ann).handle.value);
  ask(ann, Request::divest, position);
  told(bob);
  EXPECT_EQ(owner_told(), FederateHandle::none);
}

}  // namespace
}  // namespace rink::rti
