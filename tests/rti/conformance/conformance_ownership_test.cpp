// Sentences of clause 7 (ownership management) of IEEE 1516.1-2010, each held against federates
// that speak with the RTI.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/rti/errors.h"
#include "tests/rti/rig.h"

namespace rink::rti::testing {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::Not;
using Note = Recorder::OwnershipNote;

const AttributeSet privilege{privilege_to_delete_object};

/// Two pilots who publish and hear of vessels, and one who only looks; the first has registered a
/// vessel that all know.
struct SharedVessel {
  Rig rig{Carrier::in_process};
  Station& taker = rig.join("taker");  // whose words arrive first
  Station& owner = rig.join("owner");
  Station& looker = rig.join("looker");
  ObjectHandle vessel_1;

  SharedVessel() {
    for (Station* each : {&owner, &taker, &looker})
      each->ambassador.subscribe_object_class_attributes(vessel, motion);
    for (Station* each : {&owner, &taker})
      each->ambassador.publish_object_class_attributes(vessel, motion);
    vessel_1 = owner.ambassador.register_object_instance(vessel);
    rig.settle();
  }
  Note note(const char* what, AttributeSet set, const char* tag = "") const {
    return {what, vessel_1.value, set.bits, tag};
  }
  bool owns(Station& station, AttributeSet set) const {
    bool is_owned = true;
    for (std::uint32_t i = 0; i < attribute_max; ++i)
      if (set.contains({i}))
        is_owned &= station.ambassador.is_attribute_owned_by_federate(vessel_1, {i});
    return is_owned;
  }
  bool owns_none(Station& station, AttributeSet set) const {
    bool is_owned = false;
    for (std::uint32_t i = 0; i < attribute_max; ++i)
      if (set.contains({i}))
        is_owned |= station.ambassador.is_attribute_owned_by_federate(vessel_1, {i});
    return !is_owned;
  }
  std::uint32_t owner_by_query(Station& asker, AttributeHandle attribute) {
    asker.ambassador.query_attribute_ownership(vessel_1, attribute);
    rig.settle();
    return asker.heard.owners.at({vessel_1.value, attribute.value});
  }
  void update(Station& station, AttributeSet set, const std::vector<std::byte>& values) {
    station.ambassador.update_attribute_values(vessel_1, set, values, {1.0, 0});
  }
  std::uint64_t drop_count() {
    std::uint64_t sum = 0;
    for (const std::uint64_t each : rig.execution().counters().drops) sum += each;
    return sum;
  }
};

// 7.1
TEST(Conformance,
     AnInstanceAttributeIsOwnedByTheFederateThatRegisteredItsObjectAndSoIsThePrivilegeToDelete) {
  SharedVessel harbour;
  EXPECT_TRUE(harbour.owns(harbour.owner, whole_vessel));
  EXPECT_TRUE(harbour.owns_none(harbour.taker, whole_vessel));
  EXPECT_EQ(harbour.owner_by_query(harbour.looker, position),
            harbour.owner.ambassador.federate().value);
  EXPECT_EQ(*testing::harbour().attribute(vessel, "HLAprivilegeToDeleteObject"),
            privilege_to_delete_object);
}

// 7.2
TEST(Conformance,
     AfterUnconditionalDivestitureNobodyOwnsTheAttributesAndThoseWhoMayAreAskedToAssumeThem) {
  SharedVessel harbour;
  harbour.owner.ambassador.unconditional_attribute_ownership_divestiture(harbour.vessel_1,
                                                                         AttributeSet{speed});
  EXPECT_TRUE(harbour.owns_none(harbour.owner, AttributeSet{speed}))
      << "ownership is gone with the call";
  harbour.rig.settle();
  EXPECT_EQ(harbour.owner_by_query(harbour.owner, speed), FederateHandle::none);
  EXPECT_EQ(harbour.owner_by_query(harbour.owner, position),
            harbour.owner.ambassador.federate().value);
  EXPECT_THAT(harbour.taker.heard.ownership,
              ElementsAre(harbour.note("assume", AttributeSet{speed})));
  EXPECT_THAT(harbour.looker.heard.ownership, IsEmpty()) << "it doesn't publish the class";
}

// 7.3, 7.4, 7.5, 7.6, 7.7
TEST(Conformance, NegotiatedDivestitureEndsWithTheConfirmationAndUntilThenItsOwnerOwns) {
  SharedVessel harbour;
  Ambassador& owner = harbour.owner.ambassador;
  owner.negotiated_attribute_ownership_divestiture(harbour.vessel_1, motion, bytes_of("take it"));
  harbour.rig.settle();
  EXPECT_THAT(harbour.taker.heard.ownership,
              ElementsAre(harbour.note("assume", motion, "take it")));
  EXPECT_TRUE(harbour.owns(harbour.owner, motion));
  harbour.taker.ambassador.attribute_ownership_acquisition(harbour.vessel_1, motion,
                                                           bytes_of("gladly"));
  harbour.rig.settle();
  EXPECT_THAT(harbour.owner.heard.ownership, ElementsAre(harbour.note("confirm", motion)));
  EXPECT_TRUE(harbour.owns(harbour.owner, motion)) << "asked is not divested";
  EXPECT_TRUE(harbour.owns_none(harbour.taker, motion));
  harbour.update(harbour.owner, motion, values_of(1.0f, 2.0f, 3.0f));
  owner.confirm_divestiture(harbour.vessel_1, motion, bytes_of("with care"));
  EXPECT_TRUE(harbour.owns_none(harbour.owner, motion));
  harbour.rig.settle();
  EXPECT_TRUE(harbour.owns(harbour.taker, motion));
  EXPECT_EQ(harbour.taker.heard.ownership.back(), harbour.note("acquired", motion, "with care"));
  EXPECT_EQ(harbour.taker.heard.objects.at(harbour.vessel_1.value).values.at(speed.value),
            values_of(3.0f))
      << "what was said before the hand-over has arrived";
  EXPECT_EQ(harbour.owner_by_query(harbour.looker, position),
            harbour.taker.ambassador.federate().value);
  harbour.update(harbour.taker, motion, values_of(4.0f, 5.0f, 6.0f));
  harbour.rig.settle();
  EXPECT_EQ(harbour.looker.heard.objects.at(harbour.vessel_1.value).values.at(speed.value),
            values_of(6.0f));
  EXPECT_EQ(harbour.owner.heard.objects.at(harbour.vessel_1.value).values.at(speed.value),
            values_of(6.0f))
      << "who gave it away hears of it now";
  EXPECT_EQ(harbour.drop_count(), 0u);
}

// 7.8
TEST(Conformance,
     AcquisitionOfUnownedAttributesIsNotifiedAndOfOwnedOnesAsksTheirOwnerToReleaseThem) {
  SharedVessel harbour;
  harbour.owner.ambassador.unconditional_attribute_ownership_divestiture(harbour.vessel_1,
                                                                         AttributeSet{speed});
  harbour.rig.settle();
  harbour.taker.ambassador.attribute_ownership_acquisition(harbour.vessel_1, motion,
                                                           bytes_of("please"));
  harbour.rig.settle();
  EXPECT_TRUE(harbour.owns(harbour.taker, AttributeSet{speed}));
  EXPECT_THAT(harbour.owner.heard.ownership,
              ElementsAre(harbour.note("release", AttributeSet{position}, "please")));
  EXPECT_TRUE(harbour.owns(harbour.owner, AttributeSet{position})) << "it is asked, not robbed";
}

// 7.9, 7.10
TEST(Conformance, AcquisitionIfAvailableOfWhatIsOwnedIsUnavailableAndItsOwnerIsNotAsked) {
  SharedVessel harbour;
  harbour.taker.ambassador.attribute_ownership_acquisition_if_available(harbour.vessel_1, motion);
  EXPECT_EQ(error_thrown_by([&] {
              harbour.taker.ambassador.attribute_ownership_acquisition_if_available(
                  harbour.vessel_1, motion);
            }),
            HlaError::attribute_already_being_acquired);
  harbour.rig.settle();
  EXPECT_THAT(harbour.taker.heard.ownership, ElementsAre(harbour.note("unavailable", motion)));
  EXPECT_THAT(harbour.owner.heard.ownership, IsEmpty());
}

// 7.12
TEST(Conformance, ReleaseDeniedEndsTheAcquisitionAsUnavailable) {
  SharedVessel harbour;
  harbour.taker.ambassador.attribute_ownership_acquisition(harbour.vessel_1, motion);
  harbour.rig.settle();
  harbour.owner.ambassador.attribute_ownership_release_denied(harbour.vessel_1, motion);
  harbour.rig.settle();
  EXPECT_THAT(harbour.taker.heard.ownership, ElementsAre(harbour.note("unavailable", motion)));
  EXPECT_TRUE(harbour.owns(harbour.owner, whole_vessel));
}

// 7.13
TEST(Conformance, DivestitureIfWantedGivesAwayWhatIsBeingAcquiredAndNothingElse) {
  SharedVessel harbour;
  harbour.taker.ambassador.attribute_ownership_acquisition(harbour.vessel_1, AttributeSet{speed});
  harbour.rig.settle();
  harbour.owner.ambassador.attribute_ownership_divestiture_if_wanted(harbour.vessel_1,
                                                                     whole_vessel);
  harbour.rig.settle();
  EXPECT_THAT(harbour.owner.heard.ownership,
              Contains(harbour.note("divested", AttributeSet{speed})));
  EXPECT_THAT(harbour.owner.heard.ownership,
              Contains(harbour.note("kept", AttributeSet{position, privilege_to_delete_object})));
  EXPECT_TRUE(harbour.owns(harbour.taker, AttributeSet{speed}));
  EXPECT_TRUE(harbour.owns(harbour.owner, AttributeSet{position, privilege_to_delete_object}));
}

// 7.14
TEST(Conformance, ACancelledNegotiatedDivestitureLeavesTheAttributesWithTheirOwner) {
  SharedVessel harbour;
  Ambassador& owner = harbour.owner.ambassador;
  EXPECT_EQ(error_thrown_by([&] {
              owner.cancel_negotiated_attribute_ownership_divestiture(harbour.vessel_1, motion);
            }),
            HlaError::attribute_divestiture_was_not_requested);
  owner.negotiated_attribute_ownership_divestiture(harbour.vessel_1, motion);
  harbour.rig.settle();
  harbour.taker.ambassador.attribute_ownership_acquisition_if_available(harbour.vessel_1, motion);
  harbour.rig.settle();
  owner.cancel_negotiated_attribute_ownership_divestiture(harbour.vessel_1, motion);
  harbour.rig.settle();
  EXPECT_EQ(harbour.taker.heard.ownership.back(), harbour.note("unavailable", motion));
  EXPECT_TRUE(harbour.owns(harbour.owner, whole_vessel));
}

// 7.15, 7.16
TEST(Conformance, ACancelledAcquisitionIsConfirmedUnlessTheAttributesWereAcquiredMeanwhile) {
  SharedVessel harbour;
  Ambassador& taker = harbour.taker.ambassador;
  EXPECT_EQ(error_thrown_by(
                [&] { taker.cancel_attribute_ownership_acquisition(harbour.vessel_1, motion); }),
            HlaError::attribute_acquisition_was_not_requested);
  taker.attribute_ownership_acquisition(harbour.vessel_1, motion);
  harbour.rig.settle();
  taker.cancel_attribute_ownership_acquisition(harbour.vessel_1, AttributeSet{speed});
  harbour.owner.ambassador.unconditional_attribute_ownership_divestiture(harbour.vessel_1,
                                                                         AttributeSet{position});
  harbour.rig.settle();
  EXPECT_THAT(harbour.taker.heard.ownership,
              Contains(harbour.note("cancelled", AttributeSet{speed})));
  EXPECT_TRUE(harbour.owns(harbour.taker, AttributeSet{position}));
  EXPECT_EQ(error_thrown_by([&] {
              taker.cancel_attribute_ownership_acquisition(harbour.vessel_1,
                                                           AttributeSet{position});
            }),
            HlaError::attribute_already_owned);
}

// 7.6: NoAcquisitionPending, where the other's cancellation crossed the confirmation
TEST(Conformance, AConfirmationThatComesAfterTheOtherCancelledGivesTheAttributesBack) {
  SharedVessel harbour;
  Ambassador& owner = harbour.owner.ambassador;
  owner.negotiated_attribute_ownership_divestiture(harbour.vessel_1, motion);
  EXPECT_EQ(error_thrown_by([&] { owner.confirm_divestiture(harbour.vessel_1, motion); }),
            HlaError::no_acquisition_pending);
  harbour.taker.ambassador.attribute_ownership_acquisition(harbour.vessel_1, motion);
  harbour.rig.settle();
  harbour.taker.ambassador.cancel_attribute_ownership_acquisition(harbour.vessel_1, motion);
  harbour.rig.settle();
  owner.confirm_divestiture(harbour.vessel_1, motion);
  harbour.rig.settle();
  EXPECT_EQ(harbour.owner.heard.ownership.back(), harbour.note("kept", motion));
  EXPECT_TRUE(harbour.owns(harbour.owner, whole_vessel));
  EXPECT_EQ(error_thrown_by([&] {
              owner.negotiated_attribute_ownership_divestiture(harbour.vessel_1, motion);
            }),
            HlaError::attribute_already_being_divested)
      << "still on offer";
  EXPECT_EQ(harbour.drop_count(), 0u);
}

// 7.2 c), 7.3 c), 7.6, 7.8, 7.12: preconditions
TEST(Conformance, EachServiceNamesWhatItsPreconditionsMiss) {
  SharedVessel harbour;
  Ambassador& owner = harbour.owner.ambassador;
  Ambassador& taker = harbour.taker.ambassador;
  Ambassador& looker = harbour.looker.ambassador;
  const ObjectHandle known = harbour.vessel_1, unknown{12345};
  const std::size_t said = taker.outgoing().size();
  EXPECT_EQ(error_thrown_by(
                [&] { taker.unconditional_attribute_ownership_divestiture(unknown, motion); }),
            HlaError::object_instance_not_known);
  EXPECT_EQ(error_thrown_by([&] {
              taker.unconditional_attribute_ownership_divestiture(known, AttributeSet{destination});
            }),
            HlaError::attribute_not_defined);
  EXPECT_EQ(
      error_thrown_by([&] { taker.unconditional_attribute_ownership_divestiture(known, motion); }),
      HlaError::attribute_not_owned);
  EXPECT_EQ(
      error_thrown_by([&] { taker.negotiated_attribute_ownership_divestiture(known, motion); }),
      HlaError::attribute_not_owned);
  EXPECT_EQ(error_thrown_by([&] { taker.attribute_ownership_release_denied(known, motion); }),
            HlaError::attribute_not_owned);
  EXPECT_EQ(error_thrown_by([&] {
              taker.update_attribute_values(known, motion, values_of(1.0f, 2.0f, 3.0f), {});
            }),
            HlaError::attribute_not_owned);
  EXPECT_EQ(error_thrown_by([&] { taker.delete_object_instance(known); }),
            HlaError::delete_privilege_not_held);
  EXPECT_EQ(taker.outgoing().size(), said) << "nothing is sent of what is refused";
  EXPECT_EQ(error_thrown_by([&] { owner.confirm_divestiture(known, motion); }),
            HlaError::attribute_divestiture_was_not_requested);
  EXPECT_EQ(error_thrown_by([&] { owner.attribute_ownership_acquisition(known, motion); }),
            HlaError::federate_owns_attributes);
  EXPECT_EQ(error_thrown_by([&] { looker.attribute_ownership_acquisition(known, motion); }),
            HlaError::object_class_not_published);
  looker.publish_object_class_attributes(vessel, AttributeSet{speed});
  EXPECT_EQ(error_thrown_by([&] { looker.attribute_ownership_acquisition(known, motion); }),
            HlaError::attribute_not_published);
}

// 6.14, 7.1
TEST(Conformance, WhoOwnsThePrivilegeMayDeleteAndItsRegistrantIsTold) {
  SharedVessel harbour;
  harbour.owner.ambassador.unconditional_attribute_ownership_divestiture(harbour.vessel_1,
                                                                         privilege);
  harbour.rig.settle();
  harbour.taker.ambassador.attribute_ownership_acquisition_if_available(harbour.vessel_1,
                                                                        privilege);
  harbour.rig.settle();
  EXPECT_EQ(
      error_thrown_by([&] { harbour.owner.ambassador.delete_object_instance(harbour.vessel_1); }),
      HlaError::delete_privilege_not_held);
  harbour.taker.ambassador.delete_object_instance(harbour.vessel_1);
  harbour.update(harbour.owner, motion, values_of(1.0f, 2.0f, 3.0f));  // crosses the deletion
  harbour.rig.settle();
  EXPECT_EQ(harbour.rig.execution().object_count(), 0u);
  EXPECT_EQ(harbour.rig.execution().counters().late_requests, 1u);
  EXPECT_EQ(harbour.owner.ambassador.counters().objects_removed, 1u);
  EXPECT_EQ(
      error_thrown_by([&] { harbour.update(harbour.owner, motion, values_of(1.0f, 2.0f, 3.0f)); }),
      HlaError::object_instance_not_known);
  EXPECT_EQ(harbour.drop_count(), 0u) << "an honest race drops nobody";
}

// 5.3
TEST(Conformance, UnpublishingAClassDivestsWhatWasOwnedOfIt) {
  SharedVessel harbour;
  harbour.owner.ambassador.publish_object_class_attributes(vessel, AttributeSet{position});
  EXPECT_TRUE(harbour.owns_none(harbour.owner, AttributeSet{speed}));
  harbour.rig.settle();
  EXPECT_EQ(harbour.owner_by_query(harbour.taker, speed), FederateHandle::none);
  EXPECT_EQ(harbour.owner_by_query(harbour.taker, position),
            harbour.owner.ambassador.federate().value);
  harbour.owner.ambassador.unpublish_object_class(vessel);
  harbour.rig.settle();
  EXPECT_EQ(harbour.owner_by_query(harbour.taker, privilege_to_delete_object),
            FederateHandle::none);
}

// 4.10
TEST(Conformance, AResignActionThatLeavesOwnershipBehindIsRefused) {
  SharedVessel harbour;
  Ambassador& owner = harbour.owner.ambassador;
  EXPECT_EQ(error_thrown_by([&] { owner.resign(ResignAction::no_action); }),
            HlaError::federate_owns_attributes);
  EXPECT_EQ(
      error_thrown_by([&] { owner.resign(ResignAction::cancel_pending_ownership_acquisitions); }),
      HlaError::federate_owns_attributes);
  harbour.taker.ambassador.attribute_ownership_acquisition(harbour.vessel_1, motion);
  EXPECT_EQ(error_thrown_by([&] { harbour.taker.ambassador.resign(ResignAction::no_action); }),
            HlaError::ownership_acquisition_pending);
  harbour.taker.ambassador.resign(ResignAction::cancel_pending_ownership_acquisitions);
  owner.unconditional_attribute_ownership_divestiture(harbour.vessel_1, AttributeSet{speed});
  harbour.rig.settle();
  owner.resign(ResignAction::unconditionally_divest_attributes);
  harbour.rig.settle();
  EXPECT_EQ(harbour.rig.execution().object_count(), 1u) << "divested, not deleted";
  EXPECT_EQ(harbour.owner_by_query(harbour.looker, position), FederateHandle::none);
}

// 4.10, 10.4
TEST(Conformance, ALostFederateLeavesByItsAutomaticResignDirective) {
  for (const ResignAction action : {ResignAction::cancel_then_delete_then_divest,
                                    ResignAction::unconditionally_divest_attributes}) {
    SharedVessel harbour;
    harbour.owner.ambassador.set_automatic_resign_directive(action);
    harbour.taker.ambassador.attribute_ownership_acquisition(harbour.vessel_1, motion);
    harbour.rig.settle();
    harbour.owner.link->close();
    harbour.rig.settle();
    const bool is_deleted = action == ResignAction::cancel_then_delete_then_divest;
    EXPECT_EQ(harbour.rig.execution().object_count(), is_deleted ? 0u : 1u);
    if (is_deleted) continue;
    EXPECT_TRUE(harbour.owns(harbour.taker, motion)) << "who waited for it has it";
  }
}

// 7.4
TEST(Conformance, WhoMayOwnAnOrphanOnlyLaterIsAskedThen) {
  SharedVessel harbour;
  harbour.owner.ambassador.unconditional_attribute_ownership_divestiture(harbour.vessel_1, motion);
  harbour.rig.settle();
  harbour.looker.ambassador.publish_object_class_attributes(vessel, AttributeSet{speed});
  Station& late = harbour.rig.join("late");
  late.ambassador.publish_object_class_attributes(vessel, motion);
  late.ambassador.subscribe_object_class_attributes(vessel, AttributeSet{speed});
  harbour.owner.ambassador.negotiated_attribute_ownership_divestiture(harbour.vessel_1, privilege);
  harbour.rig.settle();
  EXPECT_THAT(harbour.looker.heard.ownership,
              Contains(harbour.note("assume", AttributeSet{speed})));
  EXPECT_THAT(late.heard.ownership, IsEmpty())
      << "nothing that it subscribed to is in scope: it has no owner";
  harbour.taker.ambassador.attribute_ownership_acquisition_if_available(harbour.vessel_1,
                                                                        AttributeSet{speed});
  harbour.rig.settle();
  EXPECT_THAT(late.heard.ownership, Contains(harbour.note("assume", AttributeSet{position})))
      << "now it has discovered the object";
}

}  // namespace
}  // namespace rink::rti::testing
