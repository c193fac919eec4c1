// What the standard says of federation management, sentence by sentence (IEEE 1516.1-2010, clause
// 4).
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "rti/wire/federation_messages.h"
#include "tests/rti/errors.h"
#include "tests/rti/rig.h"

namespace rink::rti::testing {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::Not;

// 4.9
TEST(Conformance, AFederateThatHasJoinedMayNotJoinAgain) {
  Rig rig(Carrier::in_process);
  Station& station = rig.join("once");
  EXPECT_EQ(error_thrown_by([&] { station.ambassador.join("rink", "twice", "tester"); }),
            HlaError::federate_already_execution_member);
}

// 4.9
TEST(Conformance, AFederateNameIsUniqueWithinTheFederationExecution) {
  Rig rig(Carrier::in_process);
  rig.join("one");
  EXPECT_EQ(rig.join("one").heard.refusal, Refusal::name_taken);
}

// 4.10
TEST(Conformance, AFederateThatIsNotJoinedMayUseNoServiceOfAMember) {
  Rig rig(Carrier::in_process);
  Station& station = rig.connect();
  EXPECT_EQ(error_thrown_by([&] { station.ambassador.register_synchronization_point("start"); }),
            HlaError::federate_not_execution_member);
  EXPECT_EQ(error_thrown_by([&] { station.ambassador.synchronization_point_achieved("start"); }),
            HlaError::federate_not_execution_member);
  Station& gone = rig.join("gone");
  gone.ambassador.resign();
  EXPECT_EQ(error_thrown_by([&] { gone.ambassador.watch_federates(); }),
            HlaError::federate_not_execution_member);
}

// 4.11, 4.12
TEST(Conformance, ASuccessfulRegistrationIsConfirmedToItsFederateOnly) {
  Rig rig(Carrier::in_process);
  Station &a = rig.join("a"), &b = rig.join("b");
  a.ambassador.register_synchronization_point("start", bytes_of("why"));
  rig.settle();
  EXPECT_THAT(a.heard.log, ElementsAre("joined", "registered start", "announced start with why"));
  EXPECT_THAT(b.heard.log, ElementsAre("joined", "announced start with why"));
}

// 4.12
TEST(Conformance, ALabelThatIsInUseFailsToRegister) {
  Rig rig(Carrier::in_process);
  Station &a = rig.join("a"), &b = rig.join("b");
  a.ambassador.register_synchronization_point("start");
  rig.settle();
  b.ambassador.register_synchronization_point("start");
  rig.settle();
  EXPECT_THAT(b.heard.log, Contains("not registered start: label not unique"));
  for (Station* each : {&a, &b}) each->ambassador.synchronization_point_achieved("start");
  rig.settle();
  b.ambassador.register_synchronization_point("start");
  rig.settle();
  EXPECT_EQ(b.heard.log.back(), "announced start")
      << "a label is free again when its point was reached";
}

// 4.12
TEST(Conformance, ASetWithAMemberThatIsNotJoinedFailsToRegister) {
  Rig rig(Carrier::in_process);
  Station &a = rig.join("a"), &b = rig.join("b");
  const std::vector<FederateHandle> stranger{a.ambassador.federate(), {77}},
      left{b.ambassador.federate()};
  a.ambassador.register_synchronization_point("start", {}, stranger);
  b.ambassador.resign();
  rig.settle();
  a.ambassador.register_synchronization_point("then", {}, left);
  rig.settle();
  EXPECT_THAT(a.heard.log,
              ElementsAre("joined", "not registered start: a member of the set is not joined",
                          "not registered then: a member of the set is not joined"));
}

// 4.11, 4.13
TEST(Conformance, APointWithASetIsAnnouncedToItsMembersOnlyAndAwaitsNobodyElse) {
  Rig rig(Carrier::in_process);
  Station &a = rig.join("a"), &b = rig.join("b"), &c = rig.join("c");
  const std::vector<FederateHandle> set{b.ambassador.federate(), c.ambassador.federate()};
  a.ambassador.register_synchronization_point("half", {}, set);
  rig.settle();
  Station& late = rig.join("late");
  EXPECT_THAT(a.heard.log, ElementsAre("joined", "registered half"));
  EXPECT_THAT(late.heard.log, ElementsAre("joined"));
  b.ambassador.synchronization_point_achieved("half");
  rig.settle();
  EXPECT_THAT(b.heard.log, Not(Contains("synchronized half")));
  c.ambassador.synchronization_point_achieved("half");
  rig.settle();
  EXPECT_THAT(b.heard.log, Contains("synchronized half"));
  EXPECT_THAT(c.heard.log, Contains("synchronized half"));
  EXPECT_THAT(a.heard.log, Not(Contains("synchronized half")));
}

// 4.11
TEST(Conformance, APointWithoutASetIsAnnouncedToThoseWhoJoinBeforeItIsReached) {
  Rig rig(Carrier::in_process);
  Station& a = rig.join("a");
  a.ambassador.register_synchronization_point("start");
  rig.settle();
  Station& late = rig.join("late");
  EXPECT_THAT(late.heard.log, ElementsAre("joined", "announced start"));
  a.ambassador.synchronization_point_achieved("start");
  rig.settle();
  EXPECT_THAT(a.heard.log, Not(Contains("synchronized start")));
  late.ambassador.synchronization_point_achieved("start");
  rig.settle();
  EXPECT_THAT(a.heard.log, Contains("synchronized start"));
}

// 4.14
TEST(Conformance, ALabelThatIsNotAnnouncedCannotBeAchieved) {
  Rig rig(Carrier::in_process);
  Station& a = rig.join("a");
  EXPECT_EQ(error_thrown_by([&] { a.ambassador.synchronization_point_achieved("start"); }),
            HlaError::synchronization_point_label_not_announced);
  EXPECT_TRUE(a.ambassador.is_joined());
}

// 4.14, 4.15
TEST(Conformance, ThoseWhoFailedAreNamedWhenTheFederationIsSynchronized) {
  Rig rig(Carrier::in_process);
  Station &a = rig.join("a"), &b = rig.join("b");
  a.ambassador.register_synchronization_point("start");
  rig.settle();
  a.ambassador.synchronization_point_achieved("start");
  b.ambassador.synchronization_point_achieved("start", false);
  rig.settle();
  EXPECT_EQ(a.heard.log.back(),
            "synchronized start without " + std::to_string(b.ambassador.federate().value));
}

// 4.15
TEST(Conformance, AFederateThatResignsOrIsLostIsNoLongerAwaited) {
  Rig rig(Carrier::in_process);
  Station &a = rig.join("a"), &b = rig.join("b"), &c = rig.join("c");
  a.ambassador.register_synchronization_point("start");
  rig.settle();
  a.ambassador.synchronization_point_achieved("start");
  b.ambassador.resign();
  c.link->close();
  rig.settle();
  EXPECT_EQ(a.heard.log.back(), "synchronized start");
}

}  // namespace
}  // namespace rink::rti::testing
