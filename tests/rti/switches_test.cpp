// The switches table of an object model: read, checked, and how a federation begins.
#include <gtest/gtest.h>

#include "tests/rti/bare.h"
#include "tests/rti/rig.h"

namespace rink::rti::testing {
namespace {

std::string with_switches(const std::string& switches, std::string xml = harbour_xml) {
  return xml.insert(xml.find("<objects>"), "<switches>" + switches + "</switches>");
}

const std::string clause = " (IEEE 1516.2-2010, 4.12)";

TEST(Switches, SayHowAFederationBegins) {
  const Fom fom = Fom::parse(
      with_switches(
          R"(<autoProvide isEnabled="true"/><attributeRelevanceAdvisory isEnabled="true"/><attributeScopeAdvisory isEnabled="false"/>
<conveyProducingFederate isEnabled="true"/><serviceReporting isEnabled="false"/><automaticResignAction resignAction="UnconditionallyDivestAttributes"/>)"),
      "s.xml");
  EXPECT_TRUE(fom.switches().auto_provide);
  EXPECT_TRUE(fom.switches().attribute_relevance_advisory);
  EXPECT_FALSE(fom.switches().attribute_scope_advisory);
  EXPECT_TRUE(fom.switches().object_class_relevance_advisory) << "what is left out is as ever";
  EXPECT_EQ(fom.switches().automatic_resign_action,
            ResignAction::unconditionally_divest_attributes);
  EXPECT_NE(fom.hash(), harbour().hash()) << "both ends must begin alike";
  EXPECT_EQ(Fom::parse(with_switches(R"(<autoProvide isEnabled="false"/>)"), "s.xml").hash(),
            harbour().hash())
      << "it says what is so anyway";
}

TEST(Switches, AreRefusedByLineAndElement) {
  const auto complaint = [](const std::string& switches) {
    try {
      Fom::parse(with_switches("\n" + switches), "s.xml");
    } catch (const FileError& error) {
      return std::string(error.what());
    }
    return std::string("accepted");
  };
  const std::string harbour_line =
      std::to_string(1 +
                     std::count(harbour_xml,
                                std::string_view(harbour_xml).data() +
                                    std::string_view(harbour_xml).find("<objects>"),
                                '\n') +
                     1);
  const std::string at = "s.xml:" + harbour_line + ": ";
  EXPECT_EQ(
      complaint(R"(<autoProvide isEnabled="yes"/>)"),
      at + "<autoProvide> of <switches> has isEnabled \"yes\"; allowed are true, false" + clause);
  EXPECT_EQ(complaint(R"(<autopilot isEnabled="true"/>)"),
            at + "<switches> holds <autopilot>, which is no switch of the standard" + clause);
  EXPECT_EQ(complaint(R"(<automaticResignAction resignAction="Explode"/>)"),
            at +
                "<automaticResignAction> of <switches> has resignAction \"Explode\"; allowed are "
                "the standard's, such as CancelThenDeleteThenDivest" +
                clause);
}

/// Published models set all switches: one that asks for what this RTI does not do is warned of.
TEST(Switches, ThatCannotBeHonouredAreWarnedOf) {
  const auto warnings_of = [](const std::string& switches) {
    return Fom::parse(with_switches(switches), "s.xml").warnings();
  };
  EXPECT_EQ(
      warnings_of(R"(<serviceReporting isEnabled="true"/>)"),
      std::vector{"s.xml:4: <serviceReporting> stays off: this RTI does not do that" + clause});
  EXPECT_EQ(warnings_of(R"(<conveyProducingFederate isEnabled="false"/>)"),
            std::vector{"s.xml:4: <conveyProducingFederate> stays on: receivers of an interaction "
                        "always learn its sender" +
                        clause});
  EXPECT_EQ(warnings_of(R"(<nonRegulatedGrant isEnabled="true"/>)"),
            std::vector{"s.xml:4: <nonRegulatedGrant> has no effect" + clause});
  EXPECT_EQ(warnings_of(R"(<serviceReporting isEnabled="false"/>)"), std::vector<std::string>());
  EXPECT_EQ(Fom::parse(with_switches(R"(<serviceReporting isEnabled="true"/>)"), "s.xml").hash(),
            harbour().hash())
      << "what has no effect is no difference";
}

TEST(Switches, OfTwoModulesMustAgree) {
  const std::string on = with_switches(R"(<autoProvide isEnabled="true"/>)"),
                    off = with_switches(R"(<autoProvide isEnabled="false"/>)");
  const std::array same{FomModule{on, "a.xml"}, FomModule{on, "b.xml"}},
      different{FomModule{on, "a.xml"}, FomModule{off, "b.xml"}};
  EXPECT_TRUE(Fom::parse(same).switches().auto_provide);
  try {
    Fom::parse(different);
    ADD_FAILURE() << "accepted";
  } catch (const FileError& error) {
    EXPECT_EQ(error.error(), HlaError::inconsistent_fdd);
  }
}

/// Of a model with the switches, an owner of one vessel and a guest who sees it; then the owner is
/// lost.
TEST(Switches, AreThoseOfEachFederateAtFirst) {
  const Fom fom = Fom::parse(
      with_switches(
          R"(<attributeRelevanceAdvisory isEnabled="true"/><attributeScopeAdvisory isEnabled="false"/>
<automaticResignAction resignAction="UnconditionallyDivestAttributes"/>)"),
      "s.xml");
  struct Heard : Recorder {
    int scopes = 0, turned_on = 0;
    void attributes_in_scope(ObjectHandle) override { ++scopes; }
    void turn_updates_on_for_object_instance(ObjectHandle, AttributeSet) override { ++turned_on; }
  } owner_heard, guest_heard;
  owner_heard.model = guest_heard.model = &fom;
  struct Two final : Outlet {
    Ambassador* ends[2];
    void send(ConnectionId connection, std::span<const Bytes> parts) override {
      for (const Bytes part : parts) EXPECT_TRUE(ends[connection]->receive(part));
    }
    void drop(ConnectionId, std::string_view) override {}
  } outlet;
  FederationExecution execution(fom, {});
  Ambassador owner(fom, owner_heard), guest(fom, guest_heard);
  outlet.ends[0] = &owner, outlet.ends[1] = &guest;
  const auto tick = [&] {
    for (ConnectionId id = 0; id < 2; ++id)
      execution.receive(id, outlet.ends[id]->outgoing()), outlet.ends[id]->clear_outgoing();
    execution.match();
    execution.flush(outlet);
  };
  execution.connect(0), execution.connect(1);
  owner.join("rink", "owner", "tester"), guest.join("rink", "guest", "tester");
  tick();
  owner.publish_object_class_attributes(vessel, AttributeSet{speed});
  guest.subscribe_object_class_attributes(vessel, AttributeSet{speed});
  const ObjectHandle object = owner.register_object_instance(vessel);
  tick(), tick();
  EXPECT_EQ(owner_heard.turned_on, 1);
  EXPECT_EQ(guest_heard.scopes, 0);
  EXPECT_TRUE(guest_heard.objects.contains(object.value));
  execution.disconnect(0, "killed");
  EXPECT_EQ(execution.object_count(), 1u) << "divested, not deleted";
}

}  // namespace
}  // namespace rink::rti::testing
