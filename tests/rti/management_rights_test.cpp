// The management object model is the RTI's to speak of: no federate, stranger or model of their own
// takes it over.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/rti/bare.h"
#include "tests/rti/errors.h"
#include "tests/rti/rig.h"
#include "tests/rti/warden.h"

namespace rink::rti::testing {
namespace {

TEST(ManagementObjectModel, IsTheRtisToSpeakOf) {
  Rig rig(Carrier::in_process);
  Warden warden(rig);
  EXPECT_EQ(error_thrown_by([&] {
              warden.ambassador().publish_object_class_attributes(federate_class, AttributeSet(1));
            }),
            HlaError::unauthorized);
  EXPECT_EQ(error_thrown_by([&] {
              warden.ambassador().publish_interaction_class(
                  manager_interaction("HLAfederate.HLAreport.HLAreportObjectClassPublication"));
            }),
            HlaError::unauthorized);
  EXPECT_EQ(error_thrown_by([&] { warden.ambassador().register_object_instance(federate_class); }),
            HlaError::object_class_not_published);
  EXPECT_EQ(error_thrown_by([&] {
              warden.ambassador().attribute_ownership_acquisition(warden.object_of("warden"),
                                                                  AttributeSet(1));
            }),
            HlaError::object_class_not_published);
  warden.ambassador().query_attribute_ownership(warden.object_of("warden"), AttributeHandle{0});
  rig.settle();
  EXPECT_TRUE(warden.heard().lost.empty());
}

TEST(ManagementObjectModel, StrangersWhoForgeItAreDroppedAndNobodyElseNotices) {
  const auto drop_of = [](auto message) {
    Bare bare;
    bare.execution.connect(1);
    bare.execution.receive(1, frame_of(join_of("stranger")));
    bare.tick();
    bare.execution.receive(1,
                           frame_of(PublishInteractionClassMessage{
                               static_cast<std::uint16_t>(
                                   manager_interaction("HLAfederate.HLAadjust.HLAsetTiming").value),
                               1}));
    bare.execution.receive(1, frame_of(message));
    bare.tick();
    EXPECT_TRUE(bare.witness.is_joined());
    const auto& drops = bare.execution.counters().drops;
    for (std::size_t i = 0; i < drops.size(); ++i)
      if (drops[i] != 0) return std::string(to_string(static_cast<Violation>(i)));
    return std::string("nothing");
  };
  const auto set_timing = [](Bytes parameters) {
    return InteractionMessage{
        static_cast<std::uint16_t>(manager_interaction("HLAfederate.HLAadjust.HLAsetTiming").value),
        FederateHandle::none,
        {},
        parameters};
  };
  const std::vector<std::byte> good = timing({1}, 5), nobody = timing({99}, 5),
                               backwards = timing({1}, 5), cut = values_of(1);
  EXPECT_EQ(drop_of(PublishObjectClassMessage{static_cast<std::uint16_t>(federate_class.value), 1}),
            "not owned");
  EXPECT_EQ(drop_of(PublishInteractionClassMessage{
                static_cast<std::uint16_t>(manager_interaction("HLAfederate.HLAreport").value), 1}),
            "not owned");
  EXPECT_EQ(drop_of(set_timing(good)), "nothing");
  EXPECT_EQ(drop_of(set_timing(nobody)), "malformed");
  EXPECT_EQ(drop_of(set_timing(cut)), "malformed");
}

TEST(ManagementObjectModel, NoFederatesModelRedefinesIt) {
  const auto complaint = [](const std::string& xml) {
    try {
      Fom::parse(xml, "own.xml");
    } catch (const FileError& error) {
      return std::string(error.what());
    }
    return std::string("accepted");
  };
  EXPECT_EQ(complaint("<objectModel><objects><objectClass><name>HLAobjectRoot</"
                      "name>\n<objectClass><name>HLAmanager</name></objectClass></objectClass></"
                      "objects></objectModel>"),
            "own.xml:2: <objectClass> 'HLAmanager': names that begin with HLA are the standard's "
            "(IEEE 1516.2-2010, 4.2)");
  EXPECT_EQ(
      complaint(
          "<objectModel><objects/><interactions><interactionClass><name>HLAinteractionRoot</"
          "name>\n<interactionClass><name>HLAmanager</name></interactionClass></interactionClass>"
          "</interactions></objectModel>"),
      "own.xml:2: <interactionClass> 'HLAmanager': names that begin with HLA are the standard's "
      "(IEEE 1516.2-2010, 4.3)");
}

TEST(ManagementObjectModel, StandsBehindAModelsOwnClassesAndIsNoPartOfItsHash) {
  EXPECT_FALSE(harbour().is_management(ferry));
  EXPECT_TRUE(harbour().is_management(federate_class));
  const Fom bare = Fom::parse(
      "<objectModel><objects><objectClass><name>Root</name></objectClass></objects></objectModel>",
      "bare.xml");
  EXPECT_EQ(bare.object_class("Root"), ObjectClassHandle{0});
  EXPECT_TRUE(bare.object_class("HLAobjectRoot.HLAmanager.HLAfederate"));
  EXPECT_TRUE(
      bare.interaction_class("HLAinteractionRoot.HLAmanager.HLAfederate.HLAadjust.HLAsetTiming"));
}

}  // namespace
}  // namespace rink::rti::testing
