// Federation management through the standard's API: clause 4.
#include <gtest/gtest.h>

#include "tests/rti/standard/harbour.h"

namespace rink::standard::testing {
namespace {

using namespace rti1516e;

TEST(StandardFederation, AFederateCreatesJoinsLeavesAndDestroysAnExecution) {
  const Harbour harbour;
  Sailor sailor(harbour);
  sailor->createFederationExecution(L"port", to_wide(model_file()));
  EXPECT_THROW(sailor->createFederationExecution(L"port", to_wide(model_file())),
               FederationExecutionAlreadyExists);
  for (int voyage = 0; voyage < 2; ++voyage) {
    EXPECT_TRUE(sailor->joinFederationExecution(L"Ishmael", L"sailor", L"port").isValid());
    EXPECT_THROW(sailor->joinFederationExecution(L"Ishmael", L"sailor", L"port"),
                 FederateAlreadyExecutionMember);
    EXPECT_THROW(sailor->destroyFederationExecution(L"port"), FederatesCurrentlyJoined);
    EXPECT_THROW(sailor->disconnect(), FederateIsExecutionMember);
    sailor->resignFederationExecution(NO_ACTION);
    EXPECT_THROW(sailor->resignFederationExecution(NO_ACTION), FederateNotExecutionMember);
  }
  sailor->destroyFederationExecution(L"port");
  EXPECT_THROW(sailor->destroyFederationExecution(L"port"), FederationExecutionDoesNotExist);
  EXPECT_THROW(sailor->joinFederationExecution(L"Ishmael", L"sailor", L"port"),
               FederationExecutionDoesNotExist);
  sailor->disconnect();
  sailor->disconnect();
  EXPECT_THROW(sailor->listFederationExecutions(), NotConnected);
}

TEST(StandardFederation, WhoFindsNoRtiIsNotConnected) {
  std::wstring address;
  {
    const Harbour closed;
    address = closed.address();
  }
  Log log;
  const std::unique_ptr<RTIambassador> rti(RTIambassadorFactory().createRTIambassador().release());
  EXPECT_THROW(rti->connect(log, HLA_EVOKED, address), ConnectionFailed);
  EXPECT_THROW(rti->connect(log, HLA_EVOKED, L"colour=red"), InvalidLocalSettingsDesignator);
  EXPECT_THROW(rti->resignFederationExecution(NO_ACTION), NotConnected);
  EXPECT_EQ(log.all(), "");
  const Harbour harbour;
  rti->connect(log, HLA_IMMEDIATE, harbour.address());
  EXPECT_THROW(rti->connect(log, HLA_IMMEDIATE, harbour.address()), AlreadyConnected);
}

TEST(StandardFederation, NamesOfFederatesAreUniqueAndLookedUp) {
  const Harbour harbour;
  Sailor first(harbour, L"Ishmael"), second(harbour, L"Queequeg");
  Sailor third(harbour);
  third->createFederationExecution(L"other", to_wide(model_file()));
  EXPECT_THROW(third->joinFederationExecution(L"Ishmael", L"sailor", L"port"),
               FederateNameAlreadyInUse);
  EXPECT_TRUE(third->joinFederationExecution(L"sailor", L"port").isValid());
  EXPECT_EQ(second->getFederateHandle(L"Ishmael"), first.self);
  EXPECT_EQ(second->getFederateName(first.self), L"Ishmael");
  EXPECT_EQ(std::to_wstring(second->normalizeFederateHandle(second.self)), second.self.toString());
  EXPECT_THROW(second->getFederateHandle(L"Ahab"), NameNotFound);
  EXPECT_THROW(second->getFederateName(FederateHandle()), InvalidFederateHandle);
  third->listFederationExecutions();
  EXPECT_TRUE(third.hears("executions"));
  EXPECT_TRUE(third.log.has("execution port") && third.log.has("execution other"));
}

TEST(StandardFederation, ModelsThatAreNotThereOrNotOfferedAreRefused) {
  const Harbour harbour;
  Sailor sailor(harbour);
  EXPECT_THROW(sailor->createFederationExecution(L"port", L"no-such-model.xml"), CouldNotOpenFDD);
  EXPECT_THROW(sailor->createFederationExecution(L"port", std::vector<std::wstring>()),
               CouldNotOpenFDD);
  EXPECT_THROW(sailor->joinFederationExecution(L"sailor", L"port"), CouldNotOpenFDD);
  EXPECT_THROW(sailor->createFederationExecution(L"port", to_wide(model_file()), L"HLAdays"),
               CouldNotCreateLogicalTimeFactory);
  EXPECT_THROW(
      sailor->createFederationExecutionWithMIM(L"port", {to_wide(model_file())}, L"HLAstandardMIM"),
      DesignatorIsHLAstandardMIM);
  const std::wstring other = to_wide(test::source_folder()) + L"/tests/house/harbour/harbour.xml";
  EXPECT_THROW(sailor->createFederationExecution(L"port", other), CouldNotOpenFDD);
  Sailor owner(harbour, L"owner");
  EXPECT_THROW(sailor->joinFederationExecution(L"x", L"sailor", L"port"), InconsistentFDD);
  sailor->createFederationExecution(L"second", std::vector<std::wstring>{to_wide(model_file())});
}

TEST(StandardFederation, SynchronizationPointsAreAnnouncedAndReached) {
  const Harbour harbour;
  Sailor first(harbour, L"first"), second(harbour, L"second");
  first->registerFederationSynchronizationPoint(L"sail", data_of("tide"));
  EXPECT_TRUE(first.hears("registered sail"));
  EXPECT_TRUE(second.hears("announced sail tide"));
  second->registerFederationSynchronizationPoint(L"sail", {});
  EXPECT_TRUE(second.hears("failed sail 0"));
  EXPECT_THROW(first->synchronizationPointAchieved(L"land"), SynchronizationPointLabelNotAnnounced);
  EXPECT_TRUE(first.hears("announced sail tide"));
  first->synchronizationPointAchieved(L"sail");
  second->synchronizationPointAchieved(L"sail", false);
  EXPECT_TRUE(first.hears("synchronized sail 1"));
  EXPECT_TRUE(second.hears("synchronized sail 1"));
  second->registerFederationSynchronizationPoint(L"own", {}, {second.self});
  EXPECT_TRUE(second.hears("announced own "));
  second->synchronizationPointAchieved(L"own");
  EXPECT_TRUE(second.hears("synchronized own 0"));
  EXPECT_FALSE(first.log.has("announced own "));
}

TEST(StandardFederation, AFederateWhoseRtiEndsIsToldSoOnce) {
  for (const CallbackModel model : {HLA_EVOKED, HLA_IMMEDIATE}) {
    Harbour harbour;
    Sailor sailor(harbour, L"sailor", model);
    harbour.close();
    EXPECT_TRUE(sailor.until([&] { return sailor.log.all().starts_with("lost "); }))
        << sailor.log.all();
    EXPECT_THROW(sailor->publishInteractionClass(InteractionClassHandle()), NotConnected);
    sailor->disconnect();
  }
}

TEST(StandardCallbacks, NothingIsCalledBackWhileCallbacksAreDisabled) {
  for (const CallbackModel model : {HLA_EVOKED, HLA_IMMEDIATE}) {
    const Harbour harbour;
    Sailor sailor(harbour, L"sailor", model);
    sailor->disableCallbacks();
    sailor->registerFederationSynchronizationPoint(L"sail", {});
    sailor->evokeMultipleCallbacks(0.1, 0.1);
    EXPECT_EQ(sailor.log.all(), "");
    sailor->enableCallbacks();
    EXPECT_TRUE(sailor.hears("registered sail"));
  }
}

TEST(StandardCallbacks, ServicesMayBeCalledWithinCallbacksButNotThoseThatTakeCallbacks) {
  for (const CallbackModel model : {HLA_EVOKED, HLA_IMMEDIATE}) {
    const Harbour harbour;
    Sailor sailor(harbour, L"sailor", model);
    std::atomic<int> refused = 0;
    sailor.log.on_callback = [&] {
      try {
        HLAfloat64Time galt;
        sailor->queryGALT(galt);  // waits for the RTI
        sailor->evokeCallback(0.0);
      } catch (const CallNotAllowedFromWithinCallback&) {
        ++refused;
      }
      EXPECT_THROW(sailor->resignFederationExecution(NO_ACTION), CallNotAllowedFromWithinCallback);
      EXPECT_THROW(sailor->disconnect(), CallNotAllowedFromWithinCallback);
    };
    sailor->registerFederationSynchronizationPoint(L"sail", {});
    EXPECT_TRUE(sailor.until([&] { return refused >= 2; }));
    sailor->resignFederationExecution(NO_ACTION);
  }
}

TEST(StandardCallbacks, WhatACallbackThrowsReachesWhoEvokedIt) {
  const Harbour harbour;
  Sailor sailor(harbour, L"sailor");
  sailor.log.on_callback = [] { throw FederateInternalError(L"overboard"); };
  sailor->registerFederationSynchronizationPoint(L"sail", {});
  EXPECT_THROW(for (int i = 0; i < 50; ++i) sailor->evokeCallback(0.1), RTIinternalError);
  sailor.log.on_callback = [] {};
  EXPECT_TRUE(sailor.hears("announced sail "));
}

TEST(StandardCallbacks, EvokingOneSaysWhetherMoreWait) {
  const Harbour harbour;
  Sailor sailor(harbour, L"sailor");
  EXPECT_FALSE(sailor->evokeCallback(0.0));
  sailor->registerFederationSynchronizationPoint(L"sail", {});
  HLAfloat64Time galt;
  for (int answer = 0; answer < 2; ++answer) sailor->queryGALT(galt);  // comes behind the callbacks
  EXPECT_TRUE(sailor->evokeCallback(1.0));
  EXPECT_FALSE(sailor->evokeCallback(1.0));
  EXPECT_TRUE(sailor.log.has("registered sail") && sailor.log.has("announced sail "));
}

}  // namespace
}  // namespace rink::standard::testing
