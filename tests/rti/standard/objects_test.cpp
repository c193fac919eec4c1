// Declarations, objects, interactions, ownership and look-ups through the standard's API: clauses 5
// to 7 and 10.
#include <gtest/gtest.h>

#include "tests/rti/standard/harbour.h"

namespace rink::standard::testing {
namespace {

using namespace rti1516e;

/// Two federates in either callback model.
class StandardObjects : public ::testing::TestWithParam<CallbackModel> {
 protected:
  Harbour harbour;
  Sailor pilot{harbour, L"pilot", GetParam()}, coast{harbour, L"coast", GetParam()};

  ObjectInstanceHandle launch() {
    pilot->publishObjectClassAttributes(pilot.ship(), pilot.both());
    return pilot->registerObjectInstance(pilot.ship());
  }
};
INSTANTIATE_TEST_SUITE_P(Models, StandardObjects, ::testing::Values(HLA_EVOKED, HLA_IMMEDIATE),
                         [](const auto& info) {
                           return info.param == HLA_EVOKED ? "Evoked" : "Immediate";
                         });

TEST_P(StandardObjects, AnObjectIsDiscoveredReflectedAndRemoved) {
  coast->subscribeObjectClassAttributes(coast.ship(), coast.both());
  const ObjectInstanceHandle ship = launch();
  EXPECT_TRUE(coast.hears("discovered " + to_utf8(pilot->getObjectInstanceName(ship))));
  EXPECT_TRUE(coast.hears("in scope 2"));
  EXPECT_EQ(coast.log.found(), ship);
  EXPECT_EQ(coast->getKnownObjectClassHandle(ship), coast.ship());
  pilot.update(ship, "12345678", "red", "hi");
  EXPECT_TRUE(coast.hears("reflected 12345678 red tag hi"));
  pilot.update(ship, "87654321", "blue", "thirteen byte");
  EXPECT_TRUE(coast.hears("reflected 87654321 blue tag thirteen byte"));
  EXPECT_THROW(pilot.update(ship, "1", "blue"), RTIinternalError);
  EXPECT_THROW(coast.update(ship, "87654321", "blue"), AttributeNotOwned);
  EXPECT_THROW(pilot.update(ObjectInstanceHandle(), "87654321", "blue"), ObjectInstanceNotKnown);
  EXPECT_THROW(coast->deleteObjectInstance(ship, {}), DeletePrivilegeNotHeld);
  pilot->deleteObjectInstance(ship, data_of("bye"));
  EXPECT_TRUE(coast.hears("removed"));
  EXPECT_THROW(coast->getObjectInstanceName(ship), ObjectInstanceNotKnown);
}

TEST_P(StandardObjects, AnObjectIsKnownByTheNearestSubscribedClassAndItsAttributes) {
  coast->subscribeObjectClassAttributes(coast.vessel(), {coast.x()});
  const ObjectInstanceHandle ship = launch();
  ASSERT_TRUE(coast.hears("in scope 1"));
  EXPECT_EQ(coast.log.found_class(), coast.vessel());
  EXPECT_EQ(coast->getKnownObjectClassHandle(ship), coast.vessel());
  pilot.update(ship, "12345678", "red");
  EXPECT_TRUE(coast.hears("reflected 12345678 tag "));
}

TEST_P(StandardObjects, DeclarationsAddUpAndAreTakenBackByParts) {
  coast->subscribeObjectClassAttributes(coast.ship(), {coast.x()});
  coast->subscribeObjectClassAttributes(coast.ship(), {coast.flag()}, false);
  const ObjectInstanceHandle ship = launch();
  ASSERT_TRUE(coast.hears("in scope 2"));
  pilot.update(ship, "11111111", "red");
  EXPECT_TRUE(coast.hears("reflected 11111111 red tag "));
  coast->unsubscribeObjectClassAttributes(coast.ship(), {coast.x()});
  // A point that both reach says that the RTI has taken the declaration.
  coast->registerFederationSynchronizationPoint(L"taken", {});
  EXPECT_TRUE(pilot.hears("announced taken "));
  pilot.update(ship, "22222222", "blue");
  EXPECT_TRUE(coast.hears("reflected blue tag "));
  pilot->unpublishObjectClassAttributes(pilot.ship(), {pilot.x()});
  EXPECT_THROW(pilot.update(ship, "33333333", "green"), AttributeNotOwned);
  coast->unsubscribeObjectClass(coast.ship());
  pilot->unpublishObjectClass(pilot.ship());
  EXPECT_THROW(pilot->registerObjectInstance(pilot.ship()), ObjectClassNotPublished);
  EXPECT_THROW(pilot->publishObjectClassAttributes(ObjectClassHandle(), {}), ObjectClassNotDefined);
  EXPECT_THROW(coast->subscribeObjectClassAttributes(coast.vessel(), {coast.flag()}),
               AttributeNotDefined);
  EXPECT_THROW(coast->subscribeObjectClassAttributes(coast.ship(), {coast.x()}, true, L"slow"),
               InvalidUpdateRateDesignator);
}

TEST_P(StandardObjects, ANameIsReservedBeforeAnObjectHasIt) {
  pilot->publishObjectClassAttributes(pilot.ship(), pilot.both());
  EXPECT_THROW(pilot->registerObjectInstance(pilot.ship(), L"Pequod"),
               ObjectInstanceNameNotReserved);
  pilot->reserveObjectInstanceName(L"Pequod");
  EXPECT_TRUE(pilot.hears("reserved Pequod"));
  coast->reserveObjectInstanceName(L"Pequod");
  EXPECT_TRUE(coast.hears("not reserved Pequod"));
  const ObjectInstanceHandle ship = pilot->registerObjectInstance(pilot.ship(), L"Pequod");
  EXPECT_EQ(pilot->getObjectInstanceName(ship), L"Pequod");
  EXPECT_EQ(pilot->getObjectInstanceHandle(L"Pequod"), ship);
  EXPECT_THROW(pilot->registerObjectInstance(pilot.ship(), L"Pequod"), ObjectInstanceNameInUse);
  EXPECT_THROW(pilot->getObjectInstanceHandle(L"Rachel"), ObjectInstanceNotKnown);
  EXPECT_THROW(pilot->reserveObjectInstanceName(L"HLAx"), IllegalName);
  EXPECT_THROW(pilot->reserveMultipleObjectInstanceName({}), NameSetWasEmpty);
  EXPECT_THROW(pilot->releaseObjectInstanceName(L"Rachel"), ObjectInstanceNameNotReserved);
  pilot->reserveMultipleObjectInstanceName({L"Rachel", L"\u00c9toile"});
  EXPECT_TRUE(pilot.hears("reserved 2"));
  pilot->releaseMultipleObjectInstanceName({L"Rachel"});
  EXPECT_THROW(pilot->registerObjectInstance(pilot.ship(), L"Rachel"),
               ObjectInstanceNameNotReserved);
  coast->subscribeObjectClassAttributes(coast.ship(), coast.both());
  pilot->registerObjectInstance(pilot.ship(), L"\u00c9toile");
  EXPECT_TRUE(coast.hears("discovered \u00c9toile"));
}

TEST_P(StandardObjects, OwnersAreAskedForValues) {
  coast->subscribeObjectClassAttributes(coast.ship(), coast.both());
  const ObjectInstanceHandle ship = launch();
  ASSERT_TRUE(coast.hears("in scope 2"));
  coast->requestAttributeValueUpdate(ship, {coast.x()}, data_of("a longer tag than others"));
  EXPECT_TRUE(pilot.hears("asked for 1 tag a longer tag than others"));
  coast->requestAttributeValueUpdate(coast.ship(), coast.both(), {});
  EXPECT_TRUE(pilot.hears("asked for 2 tag "));
  coast->queryAttributeTransportationType(ship, coast.x());
  EXPECT_TRUE(coast.hears("transportation 1"));
  coast->localDeleteObjectInstance(ship);
  EXPECT_THROW(pilot->localDeleteObjectInstance(ship), FederateOwnsAttributes);
}

TEST_P(StandardObjects, InteractionsAreReceivedAsTheSubscribedClass) {
  const std::string hail = to_utf8(coast.hail().toString()),
                    signal = to_utf8(coast.signal().toString());
  const ParameterHandle from = pilot->getParameterHandle(pilot.hail(), L"from"),
                        words = pilot->getParameterHandle(pilot.hail(), L"words");
  EXPECT_THROW(pilot->sendInteraction(pilot.hail(), {}, {}), InteractionClassNotPublished);
  pilot->publishInteractionClass(pilot.hail());
  coast->subscribeInteractionClass(coast.signal());
  EXPECT_TRUE(pilot.hears("listened to"));
  const std::string tag(500, 't');
  pilot->sendInteraction(pilot.hail(), {{from, data_of("abcd")}, {words, data_of("ahoy")}},
                         data_of(tag));
  EXPECT_TRUE(coast.hears("received " + signal + " abcd tag " + tag));
  coast->subscribeInteractionClass(coast.hail());
  coast->registerFederationSynchronizationPoint(L"taken", {});
  EXPECT_TRUE(pilot.hears("announced taken "));
  pilot->sendInteraction(pilot.hail(), {{words, data_of("ahoy")}}, {});
  EXPECT_TRUE(coast.hears("received " + hail + " ahoy tag "));
  EXPECT_THROW(pilot->sendInteraction(pilot.hail(), {{ParameterHandle(), data_of("x")}}, {}),
               InteractionParameterNotDefined);
  EXPECT_THROW(pilot->sendInteraction(InteractionClassHandle(), {}, {}),
               InteractionClassNotDefined);
}

TEST_P(StandardObjects, AttributesChangeHandsByOfferAndConfirmation) {
  coast->subscribeObjectClassAttributes(coast.ship(), coast.both());
  coast->publishObjectClassAttributes(coast.ship(), coast.both());
  const ObjectInstanceHandle ship = launch();
  ASSERT_TRUE(coast.hears("in scope 2"));
  EXPECT_TRUE(pilot->isAttributeOwnedByFederate(ship, pilot.x()));
  EXPECT_FALSE(coast->isAttributeOwnedByFederate(ship, coast.x()));
  pilot->negotiatedAttributeOwnershipDivestiture(ship, {pilot.x()}, data_of("take it"));
  EXPECT_TRUE(coast.hears("offered 1 tag take it"));
  coast->attributeOwnershipAcquisition(ship, {coast.x()}, data_of("please"));
  EXPECT_TRUE(pilot.hears("may confirm 1"));
  pilot->confirmDivestiture(ship, {pilot.x()}, data_of("yours"));
  EXPECT_TRUE(coast.hears("acquired 1 tag yours"));
  EXPECT_TRUE(coast->isAttributeOwnedByFederate(ship, coast.x()));
  pilot->queryAttributeOwnership(ship, pilot.x());
  EXPECT_TRUE(pilot.hears("owner " + to_utf8(coast.self.toString())));
  EXPECT_THROW(pilot->unconditionalAttributeOwnershipDivestiture(ship, {pilot.x()}),
               AttributeNotOwned);
  coast->unconditionalAttributeOwnershipDivestiture(ship, {coast.x()});
  EXPECT_TRUE(pilot.hears("offered 1 tag "));
  pilot->attributeOwnershipAcquisitionIfAvailable(ship, {pilot.x()});
  EXPECT_TRUE(pilot.hears("acquired 1 tag "));
}

TEST_P(StandardObjects, ADivestitureIfWantedGivesWhatAnotherAsksFor) {
  coast->subscribeObjectClassAttributes(coast.ship(), coast.both());
  coast->publishObjectClassAttributes(coast.ship(), coast.both());
  const ObjectInstanceHandle ship = launch();
  ASSERT_TRUE(coast.hears("in scope 2"));
  coast->attributeOwnershipAcquisition(ship, {coast.flag()}, data_of("mine"));
  EXPECT_TRUE(pilot.hears("asked to release 1 tag mine"));
  AttributeHandleSet divested;
  pilot->attributeOwnershipDivestitureIfWanted(ship, pilot.both(), divested);
  EXPECT_EQ(divested, AttributeHandleSet{pilot.flag()});
  EXPECT_TRUE(pilot->isAttributeOwnedByFederate(ship, pilot.x()));
  EXPECT_TRUE(coast.hears("acquired 1 tag "));
  coast->attributeOwnershipAcquisitionIfAvailable(ship, {coast.x()});
  EXPECT_TRUE(coast.hears("unavailable 1"));
}

TEST_P(StandardObjects, LeavingDeletesOrGivesUpWhatIsOwned) {
  coast->subscribeObjectClassAttributes(coast.ship(), coast.both());
  launch();
  ASSERT_TRUE(coast.hears("in scope 2"));
  EXPECT_THROW(pilot->resignFederationExecution(NO_ACTION), FederateOwnsAttributes);
  EXPECT_THROW(pilot->resignFederationExecution(static_cast<ResignAction>(7)), InvalidResignAction);
  EXPECT_EQ(pilot->getAutomaticResignDirective(), CANCEL_THEN_DELETE_THEN_DIVEST);
  pilot->setAutomaticResignDirective(DELETE_OBJECTS);
  EXPECT_EQ(pilot->getAutomaticResignDirective(), DELETE_OBJECTS);
  pilot->resignFederationExecution(DELETE_OBJECTS);
  EXPECT_TRUE(coast.hears("removed"));
}

/// A federate's name, as the management object model has it.
TEST_P(StandardObjects, ManagementValuesAreInTheStandardsForm) {
  const ObjectClassHandle federate = coast->getObjectClassHandle(L"HLAmanager.HLAfederate");
  const AttributeHandle name = coast->getAttributeHandle(federate, L"HLAfederateName");
  coast->subscribeObjectClassAttributes(federate, {name});
  const VariableLengthData expected = HLAunicodeString(std::wstring(L"pilot")).encode();
  EXPECT_TRUE(coast.hears("reflected " + text_of(expected) + " tag "));
}

TEST_P(StandardObjects, NamesAndHandlesAreLookedUp) {
  EXPECT_EQ(pilot->getObjectClassName(pilot.ship()), L"HLAobjectRoot.Vessel.Ship");
  EXPECT_EQ(pilot->getAttributeName(pilot.ship(), pilot.flag()), L"flag");
  EXPECT_EQ(pilot->getInteractionClassName(pilot.hail()), L"HLAinteractionRoot.Signal.Hail");
  const ParameterHandle words = pilot->getParameterHandle(pilot.hail(), L"words");
  EXPECT_EQ(pilot->getParameterName(pilot.hail(), words), L"words");
  EXPECT_THROW(pilot->getObjectClassHandle(L"Submarine"), NameNotFound);
  EXPECT_THROW(pilot->getObjectClassName(ObjectClassHandle()), InvalidObjectClassHandle);
  EXPECT_THROW(pilot->getAttributeHandle(pilot.vessel(), L"flag"), NameNotFound);
  EXPECT_THROW(pilot->getAttributeHandle(ObjectClassHandle(), L"x"), InvalidObjectClassHandle);
  EXPECT_THROW(pilot->getParameterName(pilot.signal(), words), InteractionParameterNotDefined);
  EXPECT_THROW(pilot->getInteractionClassName(InteractionClassHandle()),
               InvalidInteractionClassHandle);
  EXPECT_TRUE(pilot->getAttributeHandle(pilot.ship(), L"HLAprivilegeToDeleteObject").isValid());
  EXPECT_EQ(pilot->getOrderType(L"TimeStamp"), TIMESTAMP);
  EXPECT_EQ(pilot->getOrderName(RECEIVE), L"Receive");
  EXPECT_THROW(pilot->getOrderType(L"none"), InvalidOrderName);
  EXPECT_THROW(pilot->getOrderName(static_cast<OrderType>(3)), InvalidOrderType);
  EXPECT_EQ(pilot->getTransportationType(L"HLAbestEffort"), BEST_EFFORT);
  EXPECT_EQ(pilot->getTransportationName(RELIABLE), L"HLAreliable");
  EXPECT_THROW(pilot->getTransportationType(L"mail"), InvalidTransportationName);
  EXPECT_THROW(pilot->getTransportationName(static_cast<TransportationType>(3)),
               InvalidTransportationType);
  const DimensionHandle east = pilot->getDimensionHandle(L"East");
  EXPECT_EQ(pilot->getDimensionName(east), L"East");
  EXPECT_EQ(pilot->getDimensionUpperBound(east), 1000u);
  EXPECT_EQ(pilot->getAvailableDimensionsForClassAttribute(pilot.ship(), pilot.x()),
            DimensionHandleSet{east});
  EXPECT_EQ(pilot->getAvailableDimensionsForInteractionClass(pilot.hail()),
            DimensionHandleSet{east});
  EXPECT_THROW(pilot->getUpdateRateValue(L"slow"), InvalidUpdateRateDesignator);
  EXPECT_EQ(pilot->normalizeServiceGroup(SUPPORT_SERVICES), 6u);
  EXPECT_THROW(pilot->normalizeServiceGroup(static_cast<ServiceGroup>(7)), InvalidServiceGroup);
  EXPECT_EQ(pilot->decodeObjectClassHandle(pilot.ship().encode()), pilot.ship());
  EXPECT_THROW(pilot->decodeParameterHandle(data_of("x")), CouldNotDecode);
}

TEST_P(StandardObjects, SwitchesAreOnOrOff) {
  pilot->disableObjectClassRelevanceAdvisorySwitch();
  EXPECT_THROW(pilot->disableObjectClassRelevanceAdvisorySwitch(),
               ObjectClassRelevanceAdvisorySwitchIsOff);
  pilot->enableObjectClassRelevanceAdvisorySwitch();
  pilot->enableAttributeRelevanceAdvisorySwitch();
  EXPECT_THROW(pilot->enableAttributeRelevanceAdvisorySwitch(),
               AttributeRelevanceAdvisorySwitchIsOn);
  pilot->disableAttributeRelevanceAdvisorySwitch();
  pilot->disableAttributeScopeAdvisorySwitch();
  pilot->enableAttributeScopeAdvisorySwitch();
  pilot->disableInteractionRelevanceAdvisorySwitch();
  EXPECT_THROW(pilot->disableInteractionRelevanceAdvisorySwitch(),
               InteractionRelevanceAdvisorySwitchIsOff);
  pilot->enableInteractionRelevanceAdvisorySwitch();
}

}  // namespace
}  // namespace rink::standard::testing
