// Saving and restoring through the standard's API: 4.16 to 4.31.
#include <gtest/gtest.h>

#include "rti/save/save_directory.h"
#include "tests/rti/standard/harbour.h"
#include "tests/temporary_folder.h"

namespace rink::standard::testing {
namespace {

using namespace rti1516e;

/// Notes what it is told of saves, and answers as a federate does that has no state of its own.
class Saver final : public Log {
 public:
  RTIambassador* rti = nullptr;
  bool is_able = true;

 private:
  void initiateFederateSave(std::wstring const& label) override {
    rti->federateSaveBegun();
    if (is_able) rti->federateSaveComplete();
    else rti->federateSaveNotComplete();
    note("save " + to_utf8(label));
  }
  void federationSaved() override { note("saved"); }
  void federationNotSaved(SaveFailureReason reason) override {
    note("not saved " + std::to_string(reason));
  }
  void federationSaveStatusResponse(FederateHandleSaveStatusPairVector const& statuses) override {
    for (const auto& each : statuses) note("save status " + std::to_string(each.second));
  }
  void requestFederationRestoreSucceeded(std::wstring const& label) override {
    note("confirmed " + to_utf8(label));
  }
  void requestFederationRestoreFailed(std::wstring const& label) override {
    note("refused " + to_utf8(label));
  }
  void federationRestoreBegun() override { note("restore begun"); }
  void initiateFederateRestore(std::wstring const& label, std::wstring const& name,
                               FederateHandle) override {
    if (is_able) rti->federateRestoreComplete();
    else rti->federateRestoreNotComplete();
    note("restore " + to_utf8(label) + " as " + to_utf8(name));
  }
  void federationRestored() override { note("restored"); }
  void federationNotRestored(RestoreFailureReason reason) override {
    note("not restored " + std::to_string(reason));
  }
  void federationRestoreStatusResponse(FederateRestoreStatusVector const& statuses) override {
    for (const auto& each : statuses) note("restore status " + std::to_string(each.status));
  }
};

/// A federate of execution "port" whose callbacks are evoked.
struct Crew {
  Crew(const Harbour& harbour, const std::wstring& name) {
    log.rti = rti.get();
    rti->connect(log, HLA_EVOKED, harbour.address());
    try {
      rti->createFederationExecution(L"port", to_wide(model_file()));
    } catch (const FederationExecutionAlreadyExists&) {
    }
    rti->joinFederationExecution(name, L"sailor", L"port");
  }
  ~Crew() {
    rti->resignFederationExecution(DELETE_OBJECTS_THEN_DIVEST);
    rti->disconnect();
  }
  Crew(const Crew&) = delete;
  Crew& operator=(const Crew&) = delete;
  bool hears(const std::string& line) {
    for (int i = 0; i < 500 && !log.has(line); ++i) rti->evokeMultipleCallbacks(0.01, 0.02);
    return log.has(line);
  }
  Saver log;
  std::unique_ptr<RTIambassador> rti{RTIambassadorFactory().createRTIambassador().release()};
};

class StandardSaves : public ::testing::Test {
 protected:
  const test::TemporaryFolder folder{"standard-saves"};
  const std::shared_ptr<rti::SaveStore> store = std::make_shared<rti::SaveDirectory>(folder.path());
};

TEST_F(StandardSaves, AFederationIsSavedAndBroughtBackByAnotherRti) {
  ObjectInstanceHandle ship;
  {
    const Harbour harbour(store);
    Crew first(harbour, L"first"), second(harbour, L"second");
    const ObjectClassHandle ships = first.rti->getObjectClassHandle(L"Ship");
    const AttributeHandle flag = first.rti->getAttributeHandle(ships, L"flag");
    first.rti->publishObjectClassAttributes(ships, {flag});
    second.rti->subscribeObjectClassAttributes(ships, {flag});
    ship = first.rti->registerObjectInstance(ships);
    for (int i = 0; i < 500 && !second.log.found().isValid(); ++i)
      second.rti->evokeMultipleCallbacks(0.01, 0.02);
    first.rti->queryFederationSaveStatus();
    EXPECT_TRUE(first.hears("save status 0"));
    first.rti->requestFederationSave(L"noon");
    EXPECT_TRUE(first.hears("save noon"));
    EXPECT_TRUE(second.hears("saved"));
    EXPECT_TRUE(first.hears("saved"));
  }
  const Harbour harbour(store);
  Crew second(harbour, L"second"), first(harbour, L"first");
  second.rti->requestFederationRestore(L"midnight");
  EXPECT_TRUE(second.hears("refused midnight"));
  second.rti->requestFederationRestore(L"noon");
  EXPECT_TRUE(second.hears("restore noon as second"));
  EXPECT_TRUE(first.hears("restored"));
  EXPECT_TRUE(second.hears("restored"));
  EXPECT_TRUE(second.log.has("confirmed noon") && second.log.has("restore begun"));
  EXPECT_FALSE(first.log.has("confirmed noon"));
  const std::wstring name = first.rti->getObjectInstanceName(ship);
  EXPECT_EQ(first.rti->getObjectInstanceHandle(name), ship);
  EXPECT_EQ(second.rti->getObjectInstanceHandle(name), ship);
  EXPECT_EQ(second.rti->getKnownObjectClassHandle(ship), second.rti->getObjectClassHandle(L"Ship"));
  second.rti->queryFederationRestoreStatus();
  EXPECT_TRUE(second.hears("restore status 0"));
}

TEST_F(StandardSaves, AFederateThatCannotEndsASaveAndARestore) {
  const Harbour harbour(store);
  Crew first(harbour, L"first"), second(harbour, L"second");
  first.rti->requestFederationSave(L"noon");
  EXPECT_TRUE(second.hears("save noon"));
  EXPECT_TRUE(first.hears("saved"));
  EXPECT_TRUE(second.hears("saved"));
  second.log.is_able = false;
  first.rti->requestFederationSave(L"later");
  EXPECT_TRUE(second.hears("save later"));
  EXPECT_TRUE(first.hears("not saved " + std::to_string(FEDERATE_REPORTED_FAILURE_DURING_SAVE)));
  EXPECT_TRUE(second.hears("not saved " + std::to_string(FEDERATE_REPORTED_FAILURE_DURING_SAVE)));
  first.rti->requestFederationRestore(L"noon");
  EXPECT_TRUE(second.hears("restore noon as second"));
  EXPECT_TRUE(
      first.hears("not restored " + std::to_string(FEDERATE_REPORTED_FAILURE_DURING_RESTORE)));
  EXPECT_TRUE(
      second.hears("not restored " + std::to_string(FEDERATE_REPORTED_FAILURE_DURING_RESTORE)));
}

TEST_F(StandardSaves, ServicesAreRefusedByTheStandardsExceptions) {
  const Harbour harbour(store);
  Crew sailor(harbour, L"sailor"), other(harbour, L"other");
  EXPECT_THROW(sailor.rti->federateSaveBegun(), SaveNotInitiated);
  EXPECT_THROW(sailor.rti->federateSaveComplete(), FederateHasNotBegunSave);
  EXPECT_THROW(sailor.rti->federateSaveNotComplete(), FederateHasNotBegunSave);
  EXPECT_THROW(sailor.rti->abortFederationSave(), SaveNotInProgress);
  EXPECT_THROW(sailor.rti->federateRestoreComplete(), RestoreNotRequested);
  EXPECT_THROW(sailor.rti->federateRestoreNotComplete(), RestoreNotRequested);
  EXPECT_THROW(sailor.rti->abortFederationRestore(), RestoreNotInProgress);
  EXPECT_THROW(sailor.rti->requestFederationSave(L"x", HLAfloat64Time(1.0)),
               FederateUnableToUseTime);
  sailor.rti->requestFederationSave(L"x");
  // The other does not answer, for it does not evoke its callbacks.
  EXPECT_TRUE(sailor.hears("save x"));
  EXPECT_THROW(sailor.rti->requestFederationSave(L"y"), SaveInProgress);
  EXPECT_THROW(sailor.rti->publishInteractionClass(
                   sailor.rti->getInteractionClassHandle(L"HLAinteractionRoot")),
               SaveInProgress);
  sailor.rti->abortFederationSave();
  EXPECT_TRUE(sailor.hears("not saved " + std::to_string(SAVE_ABORTED)));
}

}  // namespace
}  // namespace rink::standard::testing
