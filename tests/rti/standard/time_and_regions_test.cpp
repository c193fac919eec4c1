// Time management and data distribution management through the standard's API: clauses 8 and 9.
#include <gtest/gtest.h>

#include "tests/rti/standard/harbour.h"

namespace rink::standard::testing {
namespace {

using namespace rti1516e;

/// A regulating federate and a constrained one, each at both.
struct Clocks {
  Harbour harbour;
  Sailor pilot, coast;

  explicit Clocks(const std::wstring& time = L"")
      : pilot(harbour, L"pilot", HLA_EVOKED, time), coast(harbour, L"coast", HLA_EVOKED, time) {
    for (Sailor* const each : {&pilot, &coast}) {
      const auto lookahead = (*each)->getTimeFactory()->makeZero();
      if (each->log.all().empty()) (*each)->enableTimeRegulation(*lookahead);
      EXPECT_TRUE(each->until([&] { return each->log.all().find("regulating") == 0; }));
      (*each)->enableTimeConstrained();
      EXPECT_TRUE(
          each->until([&] { return each->log.all().find("constrained") != std::string::npos; }));
    }
    pilot->publishObjectClassAttributes(pilot.ship(), pilot.both());
    coast->subscribeObjectClassAttributes(coast.ship(), coast.both());
    coast->subscribeInteractionClass(coast.signal());
    pilot->publishInteractionClass(pilot.signal());
    ship = pilot->registerObjectInstance(pilot.ship());
    EXPECT_TRUE(coast.until([&] { return coast.log.found() == ship; }));
    EXPECT_TRUE(pilot.hears("listened to"));
  }
  ObjectInstanceHandle ship;
};

TEST(StandardTime, MessagesComeInTheOrderOfTheirStampsBeforeTheGrant) {
  Clocks clocks;
  Sailor &pilot = clocks.pilot, &coast = clocks.coast;
  pilot->updateAttributeValues(clocks.ship, {{pilot.x(), data_of("22222222")}}, data_of("b"),
                               HLAfloat64Time(2.0));
  const auto handle = pilot->updateAttributeValues(clocks.ship, {{pilot.x(), data_of("11111111")}},
                                                   data_of("a"), HLAfloat64Time(1.0));
  EXPECT_TRUE(handle.isValid());
  coast->timeAdvanceRequest(HLAfloat64Time(3.0));
  EXPECT_THROW(coast->timeAdvanceRequest(HLAfloat64Time(4.0)), InTimeAdvancingState);
  EXPECT_THROW(coast->modifyLookahead(HLAfloat64Interval(1.0)), InTimeAdvancingState);
  pilot->timeAdvanceRequest(HLAfloat64Time(3.0));
  EXPECT_TRUE(coast.hears("granted 3"));
  const std::string all = coast.log.all();
  const std::size_t first = all.find("ordered 11111111 tag a at 1"),
                    second = all.find("ordered 22222222 tag b at 2"),
                    granted = all.find("granted 3");
  EXPECT_LT(first, second) << all;
  EXPECT_LT(second, granted) << all;
  HLAfloat64Time now;
  coast->queryLogicalTime(now);
  EXPECT_EQ(now.getTime(), 3.0);
  EXPECT_TRUE(pilot.hears("granted 3"));
  EXPECT_THROW(pilot->timeAdvanceRequest(HLAfloat64Time(2.0)), LogicalTimeAlreadyPassed);
  EXPECT_THROW(pilot->updateAttributeValues(clocks.ship, {{pilot.x(), data_of("33333333")}}, {},
                                            HLAfloat64Time(1.0)),
               InvalidLogicalTime);
}

/// The core is ahead of what the federate has been told: the federate is advancing until it is.
TEST(StandardTime, AFederateAdvancesUntilItHasBeenToldTheGrant) {
  Clocks clocks;
  Sailor &pilot = clocks.pilot, &coast = clocks.coast;
  pilot->timeAdvanceRequest(HLAfloat64Time(1.0));
  coast->timeAdvanceRequest(HLAfloat64Time(1.0));
  EXPECT_TRUE(coast.hears("granted 1"));
  HLAfloat64Time now;
  for (int answer = 0; answer < 2; ++answer) pilot->queryGALT(now);  // comes behind the grant
  EXPECT_THROW(pilot->timeAdvanceRequest(HLAfloat64Time(2.0)), InTimeAdvancingState);
  pilot->queryLogicalTime(now);
  EXPECT_EQ(now.getTime(), 0.0);
  EXPECT_TRUE(pilot.hears("granted 1"));
  pilot->timeAdvanceRequest(HLAfloat64Time(2.0));
}

TEST(StandardTime, TheNextMessageEndsTheAdvance) {
  Clocks clocks;
  Sailor &pilot = clocks.pilot, &coast = clocks.coast;
  const ParameterHandle from = pilot->getParameterHandle(pilot.signal(), L"from");
  pilot->sendInteraction(pilot.signal(), {{from, data_of("abcd")}}, {}, HLAfloat64Time(1.5));
  coast->nextMessageRequest(HLAfloat64Time(5.0));
  pilot->timeAdvanceRequest(HLAfloat64Time(5.0));
  EXPECT_TRUE(coast.hears("granted 1.5"));
  EXPECT_TRUE(
      coast.log.has("received " + to_utf8(coast.signal().toString()) + " abcd tag  at 1.5"));
}

TEST(StandardTime, ARetractedMessageIsNotDelivered) {
  Clocks clocks;
  Sailor &pilot = clocks.pilot, &coast = clocks.coast;
  const auto first = pilot->updateAttributeValues(clocks.ship, {{pilot.x(), data_of("11111111")}},
                                                  {}, HLAfloat64Time(1.0));
  pilot->updateAttributeValues(clocks.ship, {{pilot.x(), data_of("22222222")}}, {},
                               HLAfloat64Time(2.0));
  pilot->retract(first);
  EXPECT_THROW(pilot->retract(MessageRetractionHandle()), InvalidMessageRetractionHandle);
  coast->timeAdvanceRequest(HLAfloat64Time(3.0));
  pilot->timeAdvanceRequest(HLAfloat64Time(3.0));
  EXPECT_TRUE(coast.hears("granted 3"));
  EXPECT_TRUE(coast.log.has("ordered 22222222 tag  at 2"));
  EXPECT_FALSE(coast.log.has("ordered 11111111 tag  at 1"));
}

TEST(StandardTime, BoundsAreThoseOfTheOtherFederates) {
  Clocks clocks;
  Sailor &pilot = clocks.pilot, &coast = clocks.coast;
  pilot->modifyLookahead(HLAfloat64Interval(0.5));
  HLAfloat64Interval lookahead;
  pilot->queryLookahead(lookahead);
  EXPECT_EQ(lookahead.getInterval(), 0.5);
  HLAfloat64Time galt;
  EXPECT_TRUE(coast.until([&] { return coast->queryGALT(galt) && galt.getTime() == 0.5; }));
  pilot->updateAttributeValues(clocks.ship, {{pilot.x(), data_of("11111111")}}, {},
                               HLAfloat64Time(0.75));
  HLAfloat64Time lits;
  EXPECT_TRUE(coast.until([&] { return coast->queryLITS(lits) && lits.getTime() == 0.5; }));
  pilot->disableTimeRegulation();
  EXPECT_TRUE(coast.until([&] { return !coast->queryGALT(galt); }));
  EXPECT_THROW(pilot->queryLookahead(lookahead), TimeRegulationIsNotEnabled);
  EXPECT_THROW(pilot->enableTimeConstrained(), TimeConstrainedAlreadyEnabled);
  pilot->disableTimeConstrained();
  pilot->enableAsynchronousDelivery();
  EXPECT_THROW(pilot->enableAsynchronousDelivery(), AsynchronousDeliveryAlreadyEnabled);
}

TEST(StandardTime, ADeletionHasItsTimeAndItsTag) {
  Clocks clocks;
  Sailor &pilot = clocks.pilot, &coast = clocks.coast;
  pilot->deleteObjectInstance(clocks.ship, data_of("bye"), HLAfloat64Time(1.0));
  coast->timeAdvanceRequest(HLAfloat64Time(2.0));
  pilot->timeAdvanceRequest(HLAfloat64Time(2.0));
  EXPECT_TRUE(coast.hears("removed tag bye at 1"));
}

/// An update whose attribute goes in receive order keeps the time that its sender gave.
TEST(StandardTime, WhatGoesInReceiveOrderKeepsItsTime) {
  Clocks clocks;
  Sailor &pilot = clocks.pilot, &coast = clocks.coast;
  const auto handle = pilot->updateAttributeValues(clocks.ship, {{pilot.flag(), data_of("red")}},
                                                   data_of("t"), HLAfloat64Time(1.0));
  EXPECT_FALSE(handle.isValid());
  coast->enableAsynchronousDelivery();
  EXPECT_TRUE(coast.hears("stamped red tag t at 1"));
  pilot->changeAttributeOrderType(clocks.ship, {pilot.flag()}, TIMESTAMP);
  EXPECT_TRUE(pilot
                  ->updateAttributeValues(clocks.ship, {{pilot.flag(), data_of("blue")}}, {},
                                          HLAfloat64Time(1.0))
                  .isValid());
}

TEST(StandardTime, IntegerTimesAdvanceByWholeSteps) {
  Clocks clocks(L"HLAinteger64Time");
  Sailor &pilot = clocks.pilot, &coast = clocks.coast;
  EXPECT_EQ(pilot->getTimeFactory()->getName(), L"HLAinteger64Time");
  EXPECT_THROW(pilot->timeAdvanceRequest(HLAfloat64Time(1.0)), InvalidLogicalTime);
  for (Integer64 step = 1; step <= 3; ++step) {
    pilot->updateAttributeValues(clocks.ship, {{pilot.x(), data_of("11111111")}}, {},
                                 HLAinteger64Time(step));
    pilot->timeAdvanceRequest(HLAinteger64Time(step));
    coast->timeAdvanceRequest(HLAinteger64Time(step));
    const std::string at = std::to_string(step);
    EXPECT_TRUE(coast.hears("granted " + at));
    EXPECT_TRUE(coast.log.has("ordered 11111111 tag  at " + at)) << coast.log.all();
    EXPECT_TRUE(pilot.hears("granted " + at));
  }
  // With no lookahead, the other may send at the next step at the earliest.
  HLAinteger64Time galt;
  EXPECT_TRUE(coast->queryGALT(galt));
  EXPECT_EQ(galt.getTime(), 4);
}

TEST(StandardRegions, OnlyOverlappingRegionsAreReflected) {
  const Harbour harbour;
  Sailor pilot(harbour, L"pilot"), coast(harbour, L"coast");
  const DimensionHandle east = pilot->getDimensionHandle(L"East");
  const auto region_of = [&](Sailor& sailor, unsigned long low, unsigned long high) {
    const RegionHandle region = sailor->createRegion({east});
    sailor->setRangeBounds(region, east, RangeBounds(low, high));
    sailor->commitRegionModifications({region});
    return region;
  };
  const RegionHandle here = region_of(coast, 100, 200), ship_at = region_of(pilot, 150, 151);
  coast->subscribeObjectClassAttributesWithRegions(coast.ship(), {{coast.both(), {here}}});
  pilot->publishObjectClassAttributes(pilot.ship(), pilot.both());
  const ObjectInstanceHandle ship =
      pilot->registerObjectInstanceWithRegions(pilot.ship(), {{pilot.both(), {ship_at}}});
  ASSERT_TRUE(coast.hears("in scope 2"));
  pilot.update(ship, "11111111", "red");
  EXPECT_TRUE(coast.hears("reflected 11111111 red tag "));
  pilot->setRangeBounds(ship_at, east, RangeBounds(300, 301));
  pilot->commitRegionModifications({ship_at});
  EXPECT_TRUE(coast.hears("out of scope 2"));
  pilot.update(ship, "22222222", "blue");
  pilot->setRangeBounds(ship_at, east, RangeBounds(199, 201));
  pilot->commitRegionModifications({ship_at});
  EXPECT_TRUE(coast.hears("in scope 2", 2));
  EXPECT_EQ(pilot->getRangeBounds(ship_at, east).getLowerBound(), 199u);
  EXPECT_EQ(pilot->getRangeBounds(ship_at, east).getUpperBound(), 201u);
  EXPECT_EQ(pilot->getDimensionHandleSet(ship_at), DimensionHandleSet{east});
  coast->requestAttributeValueUpdateWithRegions(coast.ship(), {{coast.both(), {here}}}, {});
  EXPECT_TRUE(pilot.hears("asked for 2 tag "));
  EXPECT_THROW(pilot->deleteRegion(ship_at), RegionInUseForUpdateOrSubscription);
  EXPECT_THROW(pilot->setRangeBounds(ship_at, east, RangeBounds(5, 5)), InvalidRangeBound);
  EXPECT_THROW(pilot->setRangeBounds(RegionHandle(), east, RangeBounds(5, 6)), InvalidRegion);
  EXPECT_THROW(pilot->createRegion({DimensionHandle()}), InvalidDimensionHandle);
  pilot->unassociateRegionsForUpdates(ship, {{pilot.both(), {ship_at}}});
  pilot->deleteRegion(ship_at);
  coast->unsubscribeObjectClassAttributesWithRegions(coast.ship(), {{coast.both(), {here}}});
  coast->deleteRegion(here);
}

TEST(StandardRegions, InteractionsReachOverlappingSubscriptionsOnly) {
  const Harbour harbour;
  Sailor pilot(harbour, L"pilot"), coast(harbour, L"coast");
  const DimensionHandle east = pilot->getDimensionHandle(L"East");
  const auto region_of = [&](Sailor& sailor, unsigned long low, unsigned long high) {
    const RegionHandle region = sailor->createRegion({east});
    sailor->setRangeBounds(region, east, RangeBounds(low, high));
    sailor->commitRegionModifications({region});
    return region;
  };
  const RegionHandle here = region_of(coast, 100, 200), near = region_of(pilot, 150, 151),
                     far = region_of(pilot, 500, 501);
  pilot->publishInteractionClass(pilot.hail());
  coast->subscribeInteractionClassWithRegions(coast.hail(), {here});
  EXPECT_TRUE(pilot.hears("listened to"));
  const ParameterHandle words = pilot->getParameterHandle(pilot.hail(), L"words");
  pilot->sendInteractionWithRegions(pilot.hail(), {{words, data_of("far")}}, {far}, {});
  EXPECT_FALSE(pilot
                   ->sendInteractionWithRegions(pilot.hail(), {{words, data_of("near")}}, {near},
                                                {}, HLAfloat64Time(1.0))
                   .isValid());
  pilot->sendInteractionWithRegions(pilot.hail(), {{words, data_of("last")}}, {near}, {});
  const std::string hail = to_utf8(coast.hail().toString());
  EXPECT_TRUE(coast.hears("received " + hail + " last tag "));
  EXPECT_FALSE(coast.log.has("received " + hail + " far tag "));
  coast->unsubscribeInteractionClassWithRegions(coast.hail(), {here});
}

}  // namespace
}  // namespace rink::standard::testing
