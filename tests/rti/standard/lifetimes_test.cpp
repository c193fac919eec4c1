// Ends and beginnings through the standard's API: connections that are lost, objects that are
// deleted while callbacks wait, and callbacks that throw or destroy their ambassador.
#include <gtest/gtest.h>

#include <limits>

#include "tests/rti/standard/harbour.h"

namespace rink::standard::testing {
namespace {

using namespace rti1516e;

/// Either callback model, with a ship of the pilot's that the coast has discovered.
class StandardLifetimes : public ::testing::TestWithParam<CallbackModel> {
 protected:
  Harbour harbour;
  Sailor pilot{harbour, L"pilot", GetParam()}, coast{harbour, L"coast", GetParam()};
  ObjectInstanceHandle ship;

  void SetUp() override {
    pilot->publishObjectClassAttributes(pilot.ship(), pilot.both());
    coast->subscribeObjectClassAttributes(coast.ship(), coast.both());
    ship = pilot->registerObjectInstance(pilot.ship());
    ASSERT_TRUE(coast.hears("in scope 2"));
    ASSERT_TRUE(pilot.hears("wanted"));
  }
  /// What the RTI sends to `sailor` because of `act` waits for its turn when this returns.
  template <class Act>
  void let_wait(Sailor& sailor, Sailor& actor, const Act& act) {
    sailor->disableCallbacks();
    act();
    actor.hear_the_rti();
    sailor.hear_the_rti();
  }
};
INSTANTIATE_TEST_SUITE_P(Models, StandardLifetimes, ::testing::Values(HLA_EVOKED, HLA_IMMEDIATE),
                         [](const auto& info) {
                           return info.param == HLA_EVOKED ? "Evoked" : "Immediate";
                         });

TEST_P(StandardLifetimes, AFederateConnectsAgainAfterItsConnectionWasLost) {
  Log log;
  const std::unique_ptr<RTIambassador> rti(RTIambassadorFactory().createRTIambassador().release());
  for (int voyage = 0; voyage < 3; ++voyage) {
    Harbour mortal;
    rti->connect(log, GetParam(), mortal.address());
    EXPECT_THROW(rti->connect(log, GetParam(), mortal.address()), AlreadyConnected);
    rti->createFederationExecution(L"port", to_wide(model_file()));
    rti->joinFederationExecution(L"Ishmael", L"sailor", L"port");
    mortal.close();
    const auto patience = std::chrono::steady_clock::now() + std::chrono::seconds(5);
    const auto losses = static_cast<std::size_t>(voyage) + 1;
    const auto lost = [&] {
      const std::string all = log.all();
      return static_cast<std::size_t>(std::count(all.begin(), all.end(), '\n')) == losses;
    };
    while (!lost() && std::chrono::steady_clock::now() < patience)
      rti->evokeMultipleCallbacks(0.005, 0.05);
    EXPECT_TRUE(lost()) << log.all();
    EXPECT_THROW(rti->resignFederationExecution(NO_ACTION), NotConnected);
  }
  rti->disconnect();
  EXPECT_THROW(rti->evokeCallback(0.0), NotConnected);
}

TEST_P(StandardLifetimes, WhatWaitsOfAnObjectIsNotDeliveredOnceItIsDeleted) {
  let_wait(coast, pilot, [&] { pilot.update(ship, "12345678", "red"); });
  coast->localDeleteObjectInstance(ship);
  coast->enableCallbacks();
  coast->registerFederationSynchronizationPoint(L"later", {});
  EXPECT_TRUE(coast.hears("registered later"));
  EXPECT_FALSE(coast.log.has("reflected 12345678 red tag ")) << coast.log.all();

  const ObjectInstanceHandle second = pilot->registerObjectInstance(pilot.ship());
  ASSERT_TRUE(coast.hears("in scope 2", 2));
  let_wait(pilot, coast, [&] { coast->requestAttributeValueUpdate(second, {coast.x()}, {}); });
  pilot->deleteObjectInstance(second, {});
  pilot->enableCallbacks();
  pilot->registerFederationSynchronizationPoint(L"last", {});
  EXPECT_TRUE(pilot.hears("registered last"));
  EXPECT_FALSE(pilot.log.has("asked for 1 tag ")) << pilot.log.all();
}

/// Also where several wait and are delivered one after the other.
TEST_P(StandardLifetimes, WhatACallbackDecidesHoldsForTheNextOne) {
  const auto three_updates = [&] {
    let_wait(coast, pilot, [&] {
      for (const char* const colour : {"red", "green", "blue"})
        pilot.update(ship, "12345678", colour);
    });
  };
  const auto count = [&] {
    return coast.log.count("reflected 12345678 red tag ") +
           coast.log.count("reflected 12345678 green tag ") +
           coast.log.count("reflected 12345678 blue tag ");
  };
  three_updates();
  coast.log.on_callback = [&] { coast->disableCallbacks(); };
  coast->enableCallbacks();
  for (std::size_t delivered = 1; delivered <= 3; ++delivered) {
    EXPECT_TRUE(coast.until([&] { return count() == delivered; })) << coast.log.all();
    coast->evokeMultipleCallbacks(0.01, 0.05);
    EXPECT_EQ(count(), delivered);
    coast->enableCallbacks();
  }
  coast.log.on_callback = [] {};
  three_updates();
  coast.log.on_callback = [&] { coast->localDeleteObjectInstance(ship); };
  coast->enableCallbacks();
  EXPECT_TRUE(coast.until([&] { return count() == 4; }));
  coast.log.on_callback = [] {};
  coast->registerFederationSynchronizationPoint(L"later", {});
  EXPECT_TRUE(coast.hears("registered later"));
  EXPECT_EQ(count(), 4u);
}

TEST_P(StandardLifetimes, ADeletionInTimeIsForgottenAtOnceAndBackIfItIsRetracted) {
  EXPECT_FALSE(pilot->deleteObjectInstance(ship, {}, HLAfloat64Time(1.0)).isValid());
  EXPECT_THROW(pilot->getKnownObjectClassHandle(ship), ObjectInstanceNotKnown);
  EXPECT_TRUE(coast.hears("removed"));

  pilot->enableTimeRegulation(HLAfloat64Interval(1.0));
  ASSERT_TRUE(pilot.hears("regulating 0"));
  const ObjectInstanceHandle second = pilot->registerObjectInstance(pilot.ship());
  const auto handle = pilot->deleteObjectInstance(second, {}, HLAfloat64Time(5.0));
  EXPECT_TRUE(handle.isValid());
  EXPECT_THROW(pilot->getKnownObjectClassHandle(second), ObjectInstanceNotKnown);
  EXPECT_THROW(pilot.update(second, "12345678", "red"), ObjectInstanceNotKnown);
  pilot->retract(handle);
  EXPECT_EQ(pilot->getKnownObjectClassHandle(second), pilot.ship());
  pilot.update(second, "12345678", "red");
}

/// The coast is not constrained: the removal comes at once, and its retraction after it.
TEST_P(StandardLifetimes, ARemovalThatIsRetractedIsToldWithItsRetraction) {
  pilot->enableTimeRegulation(HLAfloat64Interval(1.0));
  ASSERT_TRUE(pilot.hears("regulating 0"));
  let_wait(coast, pilot, [&] {
    const auto handle = pilot->deleteObjectInstance(ship, data_of("bye"), HLAfloat64Time(5.0));
    pilot.hear_the_rti();
    coast.hear_the_rti();
    pilot->retract(handle);
  });
  EXPECT_EQ(coast->getKnownObjectClassHandle(ship), coast.ship());
  coast->enableCallbacks();
  EXPECT_TRUE(coast.hears("removed tag bye at 5"));
  EXPECT_TRUE(coast.hears("retracted"));
  EXPECT_THROW(coast->getKnownObjectClassHandle(ship), ObjectInstanceNotKnown);
}

/// In the immediate model it is printed, and the next callback follows.
TEST_P(StandardLifetimes, CallbacksMayThrowAnything) {
  coast.log.on_callback = [] { throw 42; };
  pilot->deleteObjectInstance(ship, {});
  const auto until_removed = [&] {
    for (int tries = 0; tries < 100 && !coast.log.has("removed"); ++tries) {
      coast->evokeCallback(0.05);
      if (GetParam() == HLA_IMMEDIATE) std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
  };
  if (GetParam() == HLA_EVOKED) EXPECT_THROW(until_removed(), RTIinternalError);
  else until_removed();
  EXPECT_TRUE(coast.log.has("removed"));
  coast.log.on_callback = [] {};
  coast->registerFederationSynchronizationPoint(L"sail", {});
  EXPECT_TRUE(coast.hears("registered sail"));
  EXPECT_THROW(coast->getObjectInstanceName(ship), ObjectInstanceNotKnown);
}

TEST_P(StandardLifetimes, AnAmbassadorMayBeDestroyedWithinItsCallback) {
  std::atomic<bool> is_over = false;
  Log log;
  std::unique_ptr<RTIambassador> rti(RTIambassadorFactory().createRTIambassador().release());
  log.on_callback = [&] {
    if (is_over) return;
    rti.reset();
    is_over = true;
  };
  RTIambassador* const same = rti.get();
  same->connect(log, GetParam(), harbour.address());
  same->joinFederationExecution(L"guest", L"sailor", L"port", {to_wide(model_file())});
  same->registerFederationSynchronizationPoint(L"leave", {});
  const auto patience = std::chrono::steady_clock::now() + std::chrono::seconds(5);
  while (!is_over && std::chrono::steady_clock::now() < patience)
    if (GetParam() == HLA_EVOKED) same->evokeCallback(0.1);
    else std::this_thread::sleep_for(std::chrono::milliseconds(1));
  EXPECT_TRUE(is_over);
  EXPECT_TRUE(pilot.until([&] {
    try {
      pilot->getFederateHandle(L"guest");
      return false;
    } catch (const NameNotFound&) {
      return true;
    }
  }));
}

TEST_P(StandardLifetimes, NoWaitIsTooLong) {
  const auto point = [&](const std::wstring& label) {
    pilot->registerFederationSynchronizationPoint(label, {});
    pilot.hear_the_rti();
  };
  for (const double seconds : {1e300, std::numeric_limits<double>::infinity()}) {
    if (GetParam() == HLA_IMMEDIATE) break;  // nothing comes to end the wait
    point(seconds == 1e300 ? L"great" : L"endless");
    pilot->evokeCallback(seconds);
    pilot->evokeMultipleCallbacks(-seconds, seconds);
  }
  EXPECT_FALSE(pilot->evokeCallback(std::numeric_limits<double>::quiet_NaN()));
}

}  // namespace
}  // namespace rink::standard::testing
