// What the standard's API refuses, and by which exception.
#include <gtest/gtest.h>

#include <stdexcept>

#include "rti/standard/errors.h"
#include "tests/rti/standard/harbour.h"

namespace rink::standard::testing {
namespace {

using namespace rti1516e;

TEST(StandardRefusals, WhoIsNotConnectedOrHasNotJoinedIsToldSoFirst) {
  const AttributeHandleSet none{AttributeHandle()};
  AttributeHandleSet divested;
  const auto expect_all = [&](RTIambassador& rti, const auto& refused) {
    refused([&] { rti.publishObjectClassAttributes(ObjectClassHandle(), none); });
    refused([&] { rti.subscribeObjectClassAttributes(ObjectClassHandle(), none, true, L"slow"); });
    refused([&] { rti.requestAttributeValueUpdate(ObjectInstanceHandle(), none, {}); });
    refused([&] { rti.attributeOwnershipAcquisition(ObjectInstanceHandle(), none, {}); });
    refused(
        [&] { rti.attributeOwnershipDivestitureIfWanted(ObjectInstanceHandle(), none, divested); });
    refused([&] { rti.createRegion({DimensionHandle()}); });
    refused([&] { rti.setAutomaticResignDirective(static_cast<ResignAction>(7)); });
    refused([&] { rti.getFederateName(FederateHandle()); });
    refused([&] { rti.federateSaveBegun(); });
  };
  const std::unique_ptr<RTIambassador> rti(RTIambassadorFactory().createRTIambassador().release());
  expect_all(*rti, [](const auto& service) { EXPECT_THROW(service(), NotConnected); });
  const Harbour harbour;
  Sailor sailor(harbour);
  expect_all(*sailor.operator->(),
             [](const auto& service) { EXPECT_THROW(service(), FederateNotExecutionMember); });
}

TEST(StandardRefusals, AFaultOfTheManagementModelIsNotOneOfTheObjectModel) {
  const Harbour harbour;
  Sailor sailor(harbour);
  const std::vector<std::wstring> modules{to_wide(model_file())};
  EXPECT_THROW(sailor->createFederationExecutionWithMIM(L"port", modules, L"no-such-mim.xml"),
               CouldNotOpenMIM);
  EXPECT_THROW(sailor->createFederationExecutionWithMIM(L"port", modules, L""), CouldNotOpenMIM);
  EXPECT_THROW(sailor->createFederationExecutionWithMIM(
                   L"port", modules, to_wide(test::source_folder()) + L"/CMakeLists.txt"),
               ErrorReadingMIM);
}

TEST(StandardRefusals, TheHandleOfNobodyIsNotNormalized) {
  const Harbour harbour;
  Sailor sailor(harbour, L"sailor");
  const unsigned char nobody[4] = {0, 0, 1, 0};
  const FederateHandle handle = sailor->decodeFederateHandle(VariableLengthData(nobody, 4));
  EXPECT_THROW(sailor->normalizeFederateHandle(handle), InvalidFederateHandle);
  EXPECT_THROW(sailor->normalizeFederateHandle(FederateHandle()), InvalidFederateHandle);
  EXPECT_EQ(std::to_wstring(sailor->normalizeFederateHandle(sailor.self)), sailor.self.toString());
}

TEST(StandardRefusals, AFaultIsTextWhateverIsThrown) {
  EXPECT_EQ(fault_of([] {}), std::nullopt);
  EXPECT_EQ(fault_of([] { throw 42; }), "what is no exception");
  EXPECT_EQ(fault_of([] { throw std::runtime_error("a leak"); }), "a leak");
  EXPECT_EQ(fault_of([] { throw RTIinternalError(L"\u00c9toile"); }), "\u00c9toile");
}

}  // namespace
}  // namespace rink::standard::testing
