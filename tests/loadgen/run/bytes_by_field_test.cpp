// Where the bytes go: every bit of the payload is some field's, in every form that carries states.
#include <gtest/gtest.h>

#include <cstdint>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

#include "tests/loadgen/run/virtual_experiment.h"

namespace rink::loadgen {
namespace {

/// Bits by direction, and the forms and fields that have any.
struct Summed {
  std::map<std::string, std::int64_t> bits;
  std::set<std::string> forms, fields;
};

class BytesByFieldTest : public VirtualRunTest {
 protected:
  BytesByFieldTest() {
    experiment_.schemes = {"region"};
    experiment_.view_fractions = {0.1};
    experiment_.clients = {12};
    experiment_.duration_s = 4.0;
    experiment_.counts_fields = true;
  }
  Summed summed(const Cell& cell) {
    record_ = run(cell);
    Summed sum;
    const nlohmann::json rows = report(cell, "server")["bytes_by_field"];
    for (const nlohmann::json& row : rows) {
      sum.bits[row["direction"]] += row["bits"].get<std::int64_t>();
      sum.forms.insert(row["form"]);
      sum.fields.insert(row["form"].get<std::string>() + "/" + row["field"].get<std::string>());
    }
    return sum;
  }
  RunRecord record_;
  void expect_payload(const Cell& cell, const Summed& sum) const {
    const nlohmann::json server = report(cell, "server");
    ASSERT_TRUE(sum.bits.contains("down") && sum.bits.contains("up")) << cell.policy;
    EXPECT_EQ(sum.bits.at("down"), 8 * server["bytes_sent"].get<std::int64_t>()) << cell.policy;
    EXPECT_EQ(sum.bits.at("up"), 8 * server["bytes_received"].get<std::int64_t>()) << cell.policy;
    EXPECT_FALSE(sum.forms.contains("unread")) << cell.policy;
    double bytes_per_s = 0.0;
    for (const FieldFigures& each : record_.fields) bytes_per_s += each.bytes_per_client_per_s;
    EXPECT_NEAR(bytes_per_s,
                *record_.down_bytes_per_client_per_s + *record_.up_bytes_per_client_per_s, 1e-6);
  }
};

TEST_F(BytesByFieldTest, SumToThePayloadBitForBitUnderEachPolicy) {
  experiment_.policies = {"periodic", "snapshot", "dead-reckoning", "on-event", "exact"};
  const std::map<std::string, std::vector<std::string>> expected{
      {"periodic", {"updates/position", "updates/handle", "stamp_step/kind"}},
      {"snapshot", {"deltas/snapshot.x", "deltas/snapshot.velocityY", "deltas/baseline"}},
      {"dead-reckoning", {"residuals/trajectory.position", "entries/shape.mass"}},
      {"on-event",
       {"residuals/trajectory.law", "residuals/trajectory.late", "residuals/input.count",
        "entries/trajectory.velocity", "residuals/companion"}},
      {"exact",
       {"host_message/content.keys.time", "host_message/content.entries.number",
        "host_message/content.state.position", "host_message/content.hash"}}};
  for (const Cell& cell : cells_of(experiment_)) {
    const Summed sum = summed(cell);
    expect_payload(cell, sum);
    if (HasFatalFailure()) return;
    EXPECT_GT(sum.bits.at("down"), 8 * 1000) << cell.policy;
    for (const std::string& field : expected.at(cell.policy))
      EXPECT_TRUE(sum.fields.contains(field)) << cell.policy << ": " << field;
    for (const char* up : {"modify_regions/regions", "frame/head"})
      EXPECT_TRUE(sum.fields.contains(up)) << cell.policy << ": " << up;
  }
}

TEST_F(BytesByFieldTest, CountDatagramsApartUnderLoss) {
  experiment_.policies = {"periodic"};
  experiment_.network_is_modelled = experiment_.network_carries_datagrams = true;
  experiment_.network.to_listener.loss = experiment_.network.from_listener.loss =
      rti::PacketLoss::independent(0.02);
  const Cell cell = first_cell();
  const Summed sum = summed(cell);
  expect_payload(cell, sum);
  EXPECT_TRUE(sum.fields.contains("datagram/number"));
  EXPECT_TRUE(sum.fields.contains("acknowledge_datagrams/before"));
  double by_datagram = 0.0;
  for (const FieldFigures& each : record_.fields)
    if (each.channel == "datagram" && each.field == "position")
      by_datagram += each.bytes_per_client_per_s;
  EXPECT_GT(by_datagram, 0.5 * *record_.down_bytes_per_client_per_s) << "positions are best-effort";
}

TEST_F(BytesByFieldTest, AreAbsentUnlessAskedFor) {
  experiment_.counts_fields = false;
  const Cell cell = first_cell();
  run(cell);
  EXPECT_FALSE(report(cell, "server").contains("bytes_by_field"));
}

}  // namespace
}  // namespace rink::loadgen
