// From two reports to one line of runs.jsonl, and what makes a run not count.
#include "loadgen/measure/run_record.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "loadgen/measure/judge_run.h"
#include "loadgen/measure/run_fields.h"
#include "tests/loadgen/report/canned_reports.h"

namespace rink::loadgen {
namespace {

using testing::HasSubstr;

const Cell cell{"client-server", "grid", "periodic", 10, 4};

RunRecord judged(const nlohmann::json& server, const nlohmann::json& bots) {
  RunRecord record = record_for(small_experiment(), cell);
  judge(record, server, bots);
  return record;
}

TEST(RunRecord, RatesArePerClientAndSecondAndHeadersAreAdded) {
  const RunRecord record = judged(canned_server_report(cell), canned_bots_report(cell));
  EXPECT_TRUE(record.valid) << record.why_invalid;
  EXPECT_DOUBLE_EQ(record.down_bytes_per_client_per_s.value(), 400'000 / 10.0 / 2.0);
  EXPECT_DOUBLE_EQ(record.up_bytes_per_client_per_s.value(), 4'000 / 10.0 / 2.0);
  EXPECT_DOUBLE_EQ(record.wire_bytes_per_client_per_s.value(),
                   (400'000 + 66 * (1'000 + 40 + 200) + 4'000 + 66 * (100 + 300)) / 10.0 / 2.0)
      << "the kernel's 600 large segments get 200 acknowledgements fewer than 1,000 would";
  EXPECT_DOUBLE_EQ(record.messages_per_s.value(), 2'500.0);
  EXPECT_NEAR(record.update_age_ms.p99.value(), 10.0, 0.01);
  EXPECT_FALSE(record.update_age_ms.p999);
  EXPECT_FALSE(record.key_to_effect_ms.p90);
}

/// Both ways, and read back as it was written.
TEST(RunRecord, HasABytesRateForEachFieldThatTheServerCounted) {
  nlohmann::json server = canned_server_report(cell);
  EXPECT_TRUE(judged(server, canned_bots_report(cell)).fields.empty());
  server["bytes_by_field"] = {{{"direction", "down"},
                               {"channel", "stream"},
                               {"form", "residuals"},
                               {"field", "trajectory.position"},
                               {"bits", 8'004},
                               {"times", 900}},
                              7};
  const RunRecord record = judged(server, canned_bots_report(cell));
  ASSERT_EQ(record.fields.size(), 1u);
  EXPECT_DOUBLE_EQ(record.fields[0].bytes_per_client_per_s, 8'004 / 8.0 / 10.0 / 2.0);
  EXPECT_DOUBLE_EQ(record.fields[0].times_per_client_per_s, 900 / 10.0 / 2.0);
  nlohmann::json line = nlohmann::json::parse(to_json(record).dump());
  std::string complaint;
  const auto read = run_record_from_json(line, complaint);
  ASSERT_TRUE(read) << complaint;
  EXPECT_EQ(to_json(*read), to_json(record));
  line["bytes_by_field"][0][4] = "much";
  EXPECT_FALSE(run_record_from_json(line, complaint));
  EXPECT_THAT(complaint, HasSubstr("bytes_by_field"));
  line.erase("bytes_by_field");
  EXPECT_TRUE(run_record_from_json(line, complaint)) << "a line of before: " << complaint;
}

TEST(RunRecord, WhatIsNeitherStateNorKeyIsControl) {
  nlohmann::json server = canned_server_report(cell);
  const nlohmann::json bots = canned_bots_report(cell);
  EXPECT_FALSE(judged(server, bots).truth.control_bytes_fraction);
  server["state_bytes_sent"] = 300'000, server["key_bytes_received"] = 1'000;
  const RunRecord record = judged(server, bots);
  const double all = 400'000 + 4'000;
  EXPECT_DOUBLE_EQ(*record.truth.control_bytes_fraction, (all - 300'000 - 1'000) / all);
  EXPECT_DOUBLE_EQ(*record.traffic.updates, 300'000 / 10.0 / 2.0);
  EXPECT_DOUBLE_EQ(*record.traffic.keys, 1'000 / 10.0 / 2.0);
  EXPECT_DOUBLE_EQ(*record.traffic.interest, (all - 301'000) / 10.0 / 2.0);
  EXPECT_DOUBLE_EQ(*record.nodes.busiest_bytes_per_s, all / 2.0);
}

TEST(RunRecord, EachRateIsDividedByTheSpanOfWhoCountedIt) {
  nlohmann::json server = canned_server_report(cell), bots = canned_bots_report(cell);
  bots["measured_s"] = 4.0;
  server["physics_events"] = 700;
  bots["bytes_received_by_bot"] = {1, 3};
  const RunRecord record = judged(server, bots);
  EXPECT_DOUBLE_EQ(*record.wire_bytes_per_client_per_s,
                   ((400'000 + 66 * 1'240) / 2.0 + (4'000 + 66 * 400) / 4.0) / 10.0);
  EXPECT_DOUBLE_EQ(*record.acknowledgements_per_s, 240 / 2.0 + 300 / 4.0);
  EXPECT_DOUBLE_EQ(*record.segments_per_s, 1'000 / 2.0 + 100 / 4.0);
  EXPECT_DOUBLE_EQ(*record.writes_per_s, 600 / 2.0);
  EXPECT_DOUBLE_EQ(*record.nodes.busiest_events_per_s, 700 / 2.0);
  EXPECT_DOUBLE_EQ(*record.truth.fairness_jain, 16.0 / 20.0);
  EXPECT_EQ(record.update_age_samples, 2'000u);
}

/// What each process counted is held against its own kernel, in both directions, whichever of the
/// two is the larger.
TEST(RunRecord, EachOfTheFourCountsIsComparedWithTheKernels) {
  const double clients = 10.0;
  for (const bool is_server : {true, false})
    for (const bool is_sent : {true, false})
      for (const double sign : {-1.0, 1.0})
        for (const double part : {0.99, 1.01}) {
          nlohmann::json server = canned_server_report(cell), bots = canned_bots_report(cell);
          nlohmann::json& report = is_server ? server : bots;
          const double kernel = 1'000'000.0, limit = 0.01 * kernel + 128.0 * clients;
          report[is_sent ? "kernel_bytes_sent" : "kernel_bytes_received"] = kernel;
          report[is_sent ? "total_bytes_sent" : "total_bytes_received"] =
              kernel + sign * part * limit;
          const std::string what = std::string(is_sent ? "sent" : "received") + " by the " +
                                   (is_server ? "server" : "bots") + ": ";
          const std::string why = judged(server, bots).why_invalid;
          if (part < 1.0) EXPECT_EQ(why, "") << what;
          else EXPECT_THAT(why, testing::StartsWith(what));
        }
}

TEST(RunRecord, KeysThatWentOutLateCostALatencyOfKeysAndTheRunOnlyWhereTheyAreTheGame) {
  nlohmann::json bots = canned_bots_report(cell);
  bots["schedule_trouble"] = "9 of 70 keys went out more than 10 ms late";
  bots["late_sends_fraction"] = 9.0 / 70.0;
  EXPECT_TRUE(judged(canned_server_report(cell), canned_bots_report(cell)).key_to_effect_ms.p50);
  const RunRecord replayed = judged(canned_server_report(cell), bots);
  EXPECT_TRUE(replayed.valid) << replayed.why_invalid;
  EXPECT_EQ(replayed.keys_trouble, "9 of 70 keys went out more than 10 ms late");
  EXPECT_FALSE(replayed.key_to_effect_ms.p50 || replayed.key_to_effect_ms.max);
  EXPECT_TRUE(replayed.update_age_ms.p99 && replayed.down_bytes_per_client_per_s);
  EXPECT_EQ(to_json(replayed)["keys_trouble"], replayed.keys_trouble);

  Experiment live = small_experiment();
  live.keys = KeySource::live;
  RunRecord record = record_for(live, cell);
  judge(record, canned_server_report(cell), bots);
  EXPECT_EQ(record.why_invalid,
            "the bots could not keep their schedule: 9 of 70 keys went out more than 10 ms late");
  Cell peers = cell;
  peers.mode = peer_mode;
  record = record_for(small_experiment(), peers);
  judge(record, canned_server_report(peers), bots);
  EXPECT_THAT(record.why_invalid, HasSubstr("could not keep their schedule"))
      << "peers wait for each other's keys";
}

TEST(RunRecord, OnlyUnderAVirtualClockIsThereADelay) {
  Experiment experiment = small_experiment();
  experiment.delay_ms = 25.0;
  for (const TransportKind transport :
       {TransportKind::tcp, TransportKind::udp, TransportKind::shared_memory,
        TransportKind::virtual_time}) {
    experiment.transport = transport;
    EXPECT_EQ(to_json(record_for(experiment, cell))["delay_ms"],
              transport == TransportKind::virtual_time ? 25.0 : 0.0);
  }
}

TEST(RunRecord, ALineHasTheDocumentedKeysInOrder) {
  const auto line = to_json(judged(canned_server_report(cell), canned_bots_report(cell)));
  const std::vector<std::string> documented{"mode",
                                            "scheme",
                                            "policy",
                                            "clients",
                                            "entities",
                                            "seed",
                                            "tick_rate_hz",
                                            "ticks",
                                            "ticks_on_time_fraction",
                                            "down_bytes_per_client_per_s",
                                            "up_bytes_per_client_per_s",
                                            "wire_bytes_per_client_per_s",
                                            "messages_per_s",
                                            "update_age_ms",
                                            "key_to_effect_ms",
                                            "physics_us_per_tick",
                                            "filter_us_per_tick",
                                            "send_us_per_tick",
                                            "server_rss_bytes",
                                            "state_hash",
                                            "valid",
                                            "why_invalid"};
  std::vector<std::string> keys;
  for (const auto& [key, value] : line.items()) keys.push_back(key);
  ASSERT_GE(keys.size(), documented.size());
  keys.resize(documented.size());
  EXPECT_EQ(keys, documented);
  EXPECT_EQ(line["update_age_ms"].dump().substr(0, 7), "{\"p50\":");
  EXPECT_TRUE(line["update_age_ms"]["p999"].is_null());
}

TEST(RunRecord, EachWayToFailMakesARunInvalidAndSaysWhy) {
  const auto reason = [](auto&& spoil) {
    nlohmann::json server = canned_server_report(cell), bots = canned_bots_report(cell);
    spoil(server, bots);
    const RunRecord record = judged(server, bots);
    EXPECT_EQ(record.valid, record.why_invalid.empty());
    return record.why_invalid;
  };
  EXPECT_THAT(reason([](auto&, auto& b) {
                b["valid"] = false, b["why_invalid"] = "4 % of the keys were sent late";
              }),
              HasSubstr("4 % of the keys"));
  EXPECT_THAT(reason([](auto& s, auto&) { s["valid"] = false, s["why_invalid"] = "no time"; }),
              HasSubstr("the server: no time"));
  EXPECT_THAT(reason([](auto& s, auto&) { s["kernel_bytes_sent"] = 507'000; }),
              HasSubstr("sent by the server"));
  EXPECT_EQ(reason([](auto& s, auto&) { s["kernel_bytes_sent"] = 504'000; }), "");
  EXPECT_THAT(reason([](auto&, auto& b) { b["total_bytes_received"] = 0; }),
              HasSubstr("received by the bots"));
  EXPECT_THAT(reason([](auto& s, auto&) { s["lost_federates"] = 1; }),
              HasSubstr("1 clients lost by the server"));
  EXPECT_THAT(reason([](auto& s, auto&) { s["dropped_connections"] = 2; }),
              HasSubstr("2 connections dropped"));
  EXPECT_THAT(reason([](auto&, auto& b) { b["federates_lost"] = 3; }),
              HasSubstr("3 clients lost by the bots"));
  EXPECT_THAT(reason([](auto&, auto& b) { b["keys_sent"] = 69; }), HasSubstr("69 of 70"));
  EXPECT_THAT(reason([](auto& s, auto&) { s["clients"] = 9; }),
              HasSubstr("the server's clients is 9 instead of 10"));
  EXPECT_THAT(reason([](auto&, auto& b) { b["clients"] = 11; }),
              HasSubstr("the bots' clients is 11 instead of 10"));
  EXPECT_THAT(reason([](auto& s, auto&) { s["tick_rate_hz"] = 29.0; }),
              HasSubstr("the server's tick_rate_hz is 29 instead of 30"));
  EXPECT_THAT(reason([](auto& s, auto&) { s.erase("physics_us_per_tick"); }),
              HasSubstr("physics_us_per_tick"));
  EXPECT_THAT(reason([](auto& s, auto&) { s["measured_s"] = 0.0; }),
              HasSubstr("nothing was measured"));
  EXPECT_THAT(reason([](auto&, auto& b) {
                b["update_age_ms"] = {1, 2};
              }),
              HasSubstr("a histogram"));
  EXPECT_THAT(reason([](auto& s, auto&) { s = nlohmann::json::array(); }),
              HasSubstr("the report of the server"));
}

TEST(RunRecord, OfARunThatDoesNotCountEveryReasonIsGiven) {
  nlohmann::json server = canned_server_report(cell), bots = canned_bots_report(cell);
  server["valid"] = false, server["why_invalid"] = "no time";
  server["lost_federates"] = 1, server["total_bytes_sent"] = 0;
  bots["keys_sent"] = 69, bots["valid"] = false, bots["why_invalid"] = "tired";
  const RunRecord record = judged(server, bots);
  EXPECT_FALSE(record.valid);
  for (const char* reason :
       {"the server: no time", "the bots: tired", "1 clients lost by the server",
        "sent by the server: 0 B counted", "only 69 of 70 due keys were sent"})
    EXPECT_THAT(record.why_invalid, HasSubstr(reason));
}

/// Among peers the reports add up all their processes, so that there is one count of each kind; 1 %
/// of it and 128 bytes for each peer may be on their way.
TEST(RunRecord, OfPeersTheBytesOfAllTheirConnectionsTogetherAreHeldAgainstTheKernels) {
  Cell peers = cell;
  peers.mode = peer_mode;
  const double kernel = 1'000'000.0, limit = 0.01 * kernel + 128.0 * peers.clients;
  for (const double part : {0.99, 1.01}) {
    nlohmann::json server = canned_server_report(peers);
    server["kernel_bytes_sent"] = kernel, server["total_bytes_sent"] = kernel + part * limit;
    RunRecord record = record_for(small_experiment(), peers);
    judge(record, server, canned_bots_report(peers));
    EXPECT_EQ(record.valid, part < 1.0) << record.why_invalid;
  }
}

}  // namespace
}  // namespace rink::loadgen
