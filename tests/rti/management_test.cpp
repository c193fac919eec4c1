// The management service: what it counts is what happened, and who does not ask pays nothing.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "rti/federation_directory.h"
#include "rti/management/federation_report.h"
#include "rti/wire/management_messages.h"
#include "tests/rti/rig.h"

namespace rink::rti::testing {
namespace {

/// Keeps the last report.
struct Inspector : Recorder {
  std::vector<FederationReport> reports;
  int answers = 0;
  void report_management(const std::vector<FederationReport>& all) override {
    reports = all, ++answers;
  }
  const FederateCounts& of(const std::string& name) const {
    static const FederateCounts nothing;
    for (const FederationReport& report : reports)
      for (const FederateReport& each : report.federates)
        if (each.name == name) return each.counts;
    ADD_FAILURE() << "no federate " << name;
    return nothing;
  }
};

/// What a federate says before it is counted.
std::size_t size_of_join(std::string_view name) {
  Recorder heard;
  Ambassador ambassador(harbour(), heard);
  ambassador.join("rink", name, "tester");
  return ambassador.outgoing().size();
}

class ManagementOver : public ::testing::TestWithParam<Carrier> {};

TEST_P(ManagementOver, CountsWhatEachFederateSentHeardAndOwns) {
  Rig rig(GetParam());
  Station &pilot = rig.join("pilot"), &coast = rig.join("coast");
  Inspector inspector;
  pilot.ambassador.publish_object_class_attributes(vessel, AttributeSet{speed});
  pilot.ambassador.publish_interaction_class(hail);
  coast.ambassador.subscribe_object_class_attributes(vessel, AttributeSet{speed});
  coast.ambassador.subscribe_interaction_class(hail);
  coast.ambassador.create_region();
  const ObjectHandle object = pilot.ambassador.register_object_instance(vessel),
                     other = pilot.ambassador.register_object_instance(vessel);
  rig.settle();
  for (int i = 0; i < 5; ++i) {
    pilot.ambassador.update_attribute_values(object, AttributeSet{speed},
                                             values_of(1.0f * static_cast<float>(i)), {});
    pilot.ambassador.update_attribute_values(other, AttributeSet{speed}, values_of(1.0f), {});
    rig.settle();
  }
  for (int i = 0; i < 3; ++i) pilot.ambassador.send_interaction(hail, bytes_of("ahoy"), {});
  rig.settle();
  const FederationReport report = rig.execution().report();
  inspector.reports = {report};
  EXPECT_EQ(report.federation, "rink");
  EXPECT_EQ(report.model, "Harbour");
  EXPECT_EQ(report.objects, 2u);
  ASSERT_EQ(report.federates.size(), 2u);
  const FederateCounts &sent = inspector.of("pilot"), &heard = inspector.of("coast");
  EXPECT_EQ(sent.updates_sent, 10u);
  EXPECT_EQ(heard.reflections_received, coast.ambassador.counters().updates_reflected);
  EXPECT_EQ(heard.reflections_received, 10u);
  EXPECT_EQ(sent.interactions_sent, 3u);
  EXPECT_EQ(heard.interactions_received, 3u);
  EXPECT_EQ(sent.objects_owned, 2u);
  EXPECT_EQ(heard.objects_in_scope, 2u);
  EXPECT_EQ(heard.regions, 1u);
  EXPECT_EQ(sent.objects_in_scope + sent.regions + heard.objects_owned, 0u);
  EXPECT_EQ(sent.bytes_sent + heard.bytes_sent, rig.execution().counters().bytes_received -
                                                    size_of_join("pilot") - size_of_join("coast"));
  EXPECT_EQ(sent.bytes_received + heard.bytes_received, rig.execution().counters().bytes_sent);
}

INSTANTIATE_TEST_SUITE_P(Carriers, ManagementOver,
                         ::testing::Values(Carrier::in_process, Carrier::tcp),
                         [](const auto& carrier) { return name_of(carrier.param); });

/// Two ends without a transport.
struct Line final : Outlet {
  Ambassador* to = nullptr;
  std::uint64_t bytes = 0;
  void send(ConnectionId, std::span<const Bytes> parts) override {
    for (const Bytes part : parts) EXPECT_TRUE(to->receive(part)), bytes += part.size();
  }
  void drop(ConnectionId, std::string_view) override {}
  std::size_t waiting_bytes(ConnectionId) const override { return 77; }
};

void exchange_once(CentralComponent& core, Ambassador& ambassador, Line& line) {
  core.receive(0, ambassador.outgoing());
  ambassador.clear_outgoing();
  core.match();
  core.flush(line);
}

TEST(Management, AnswersStrangersAndMembersInEitherModelOfCallbacks) {
  for (const CallbackModel model : {CallbackModel::immediate, CallbackModel::evoked}) {
    FederationExecution execution(harbour(), {});
    Inspector inspector;
    Ambassador ambassador(harbour(), inspector, {}, model);
    Line line;
    line.to = &ambassador;
    execution.connect(0);
    ambassador.query_management();
    exchange_once(execution, ambassador, line);
    ambassador.evoke_multiple_callbacks();
    EXPECT_EQ(inspector.reports, std::vector<FederationReport>{execution.report(&line)});
    ambassador.join("rink", "asker", "tester");
    exchange_once(execution, ambassador, line);
    ambassador.query_management();
    exchange_once(execution, ambassador, line);
    ambassador.evoke_multiple_callbacks();
    EXPECT_EQ(inspector.answers, 2);
    EXPECT_EQ(inspector.of("asker").queue_bytes, 77u);
    exchange_once(execution, ambassador, line);
    EXPECT_EQ(inspector.answers, 2) << "an answer for a question";
  }
}

TEST(Management, ADirectoryTellsOfAllItsExecutions) {
  FederationDirectory directory;
  directory.offer(harbour());
  directory.create("north", harbour().hash());
  directory.create("south", harbour().hash());
  Inspector inspector;
  Ambassador ambassador(harbour(), inspector);
  Line line;
  line.to = &ambassador;
  directory.connect(0);
  ambassador.query_management();
  exchange_once(directory, ambassador, line);
  ASSERT_EQ(inspector.reports.size(), 2u);
  EXPECT_EQ(inspector.reports[0].federation, "north");
  EXPECT_EQ(inspector.reports[1].federation, "south");
}

}  // namespace
}  // namespace rink::rti::testing
