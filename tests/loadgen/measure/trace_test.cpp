// Files of evidence as docs/metrics.md describes them, and what bounds them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <tuple>
#include <vector>

#include "game/net/bots_trace.h"
#include "game/net/client/client.h"
#include "game/net/fom_file.h"
#include "game/net/peer/peer_trace.h"
#include "game/net/server_trace.h"
#include "game/net/trace_lines.h"
#include "game/replication/trajectory_codec.h"
#include "loadgen/run/bots/bots_recorder.h"
#include "tests/temporary_folder.h"

namespace rink::loadgen {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

class EvidenceFile : public testing::Test {
 protected:
  std::string file() const { return (folder_ / "evidence.jsonl").string(); }
  std::vector<std::string> lines() const {
    std::istringstream text(test::text_of(file()));
    std::vector<std::string> all;
    for (std::string line; std::getline(text, line);) all.push_back(line);
    return all;
  }
  test::TemporaryFolder folder_{"evidence"};
};

TEST_F(EvidenceFile, OfAServerHasTicksInMicrosecondsKeysObjectsAndRunsOfWhatWasInScope) {
  using game::InputKind;
  using game::Key;
  game::ServerTrace server;
  server.ticks = {{0.5, 1e-6, 2.25e-4, 3.5e-3}};
  server.keys = {{0.25, 3, InputKind::key_down, Key::right},
                 {0.5, 3, InputKind::key_up, Key::right},
                 {0.75, 4, InputKind::enter, Key::right},
                 {1.0, 4, InputKind::leave, Key::right}};
  server.objects = {{100, 0}, {101, 7}};
  server.in_scope = {100, 101, 102, 200, 300, 301};
  server.decisions = {{0.625, 3, 0, 4}, {0.875, 4, 4, 6}, {0.9375, 5, 6, 6}};
  server.state_hash = 0x00ab'cdef'0123'4567;
  game::write_trace(file(), server);
  const std::vector<std::string> text = lines();
  ASSERT_EQ(text.size(), 4u + 3u + 1u);
  const nlohmann::json header = nlohmann::json::parse(text[0]);
  EXPECT_EQ(header["rink-server-evidence"], 2);
  EXPECT_EQ(header["state_hash"], "00abcdef01234567");
  for (const char* fact : {"scene", "bats", "bat_count", "puck_count", "seed", "scheme", "policy",
                           "rate_hz", "from_s", "until_s"})
    EXPECT_TRUE(header.contains(fact)) << fact;
  EXPECT_FALSE(header.contains("begins_from")) << "it began with the scene";
  EXPECT_EQ(nlohmann::json::parse(text[1])["ticks_us"],
            nlohmann::json::parse("[[0.5, 1.0, 225.0, 3500.0]]"));
  const int right = static_cast<int>(Key::right);
  EXPECT_EQ(
      nlohmann::json::parse(text[2])["keys"],
      nlohmann::json(
          {{0.25, 3, 0, right}, {0.5, 3, 1, right}, {0.75, 4, 2, right}, {1.0, 4, 3, right}}));
  EXPECT_EQ(text[3], R"({"objects":[[100,0],[101,7]]})");
  EXPECT_EQ(text[4], R"({"instant_s":0.625,"player":3,"in_scope":[100,3,200,1]})");
  EXPECT_EQ(text[5], R"({"instant_s":0.875,"player":4,"in_scope":[300,2]})");
  EXPECT_EQ(text[6], R"({"instant_s":0.9375,"player":5,"in_scope":[]})");
}

TEST_F(EvidenceFile, OfBotsHasChangesInMicrosecondsAndPlacesInNanometresNoneTwice) {
  game::BotsTrace bots;
  bots.clients = 9, bots.from_s = 0.5, bots.until_s = 2.5;
  bots.bots = {{100, {{-1.0, 100, true}, {1.25, 102, false}}}};
  bots.replicas = {{.object = 7,
                    .bytes = 8,
                    .is_in_scope = true,
                    .matched = {1.25, -2.5},
                    .displayed = {1.5, -2.5}},
                   {.object = 8,
                    .bytes = 0,
                    .is_in_scope = true,
                    .matched = {3.0, 4.0},
                    .displayed = {3.0, 4.0}},
                   {.object = 9,
                    .bytes = 16,
                    .is_in_scope = false,
                    .matched = {5.0, 6.0},
                    .displayed = {7.0, 8.0}}};
  bots.samples = {
      {.bot = 0, .displayed_s = 0.75, .matched_s = 0.625, .window_s = 0.05, .first = 0, .last = 3}};
  write_trace(file(), bots);
  const std::vector<std::string> text = lines();
  ASSERT_EQ(text.size(), 4u);
  EXPECT_EQ(text[1], R"({"bat":100,"changes_us":[[-1000000,100,1],[1250000,102,0]]})");
  EXPECT_EQ(
      text[2],
      R"({"bot":0,"displayed_s":0.75,"matched_s":0.625,"window_s":0.05,"entities_nm":[[7,8,1250000000,-2500000000,1500000000,-2500000000],[8,0,3000000000,4000000000],[9,16]]})");
}

TEST_F(EvidenceFile, OfBotsIsReadAsItWasWritten) {
  game::BotsTrace bots;
  bots.bots = {{100, {}}, {101, {}}};
  bots.replicas = {{.object = 4'294'967'295,
                    .bytes = 8,
                    .is_in_scope = true,
                    .matched = {1.25, -2.5},
                    .displayed = {1e-9, -1e9}},
                   {.object = 9, .bytes = 16},
                   {.object = 8, .is_in_scope = true}};
  bots.samples = {
      {.bot = 1, .displayed_s = 0.1, .matched_s = 2.0, .window_s = 0.05, .first = 0, .last = 2},
      {.bot = 0, .displayed_s = 3.0, .matched_s = -1.0, .window_s = 0.0, .first = 2, .last = 2},
      {.bot = 0, .displayed_s = 4.0, .matched_s = 4.0, .window_s = 0.0, .first = 2, .last = 3}};
  write_trace(file(), bots);
  const game::BotsTrace read = game::read_bots_trace(file());
  ASSERT_EQ(read.samples.size(), bots.samples.size());
  for (std::size_t i = 0; i < read.samples.size(); ++i) {
    const game::BotsTrace::Sample &found = read.samples[i], &said = bots.samples[i];
    EXPECT_EQ(
        std::tie(found.bot, found.displayed_s, found.matched_s, found.window_s, found.first,
                 found.last),
        std::tie(said.bot, said.displayed_s, said.matched_s, said.window_s, said.first, said.last));
  }
  ASSERT_EQ(read.replicas.size(), bots.replicas.size());
  for (std::size_t i = 0; i < read.replicas.size(); ++i) {
    const game::BotsTrace::Replica &found = read.replicas[i], &said = bots.replicas[i];
    EXPECT_EQ(
        std::tie(found.object, found.bytes, found.is_in_scope, found.matched, found.displayed),
        std::tie(said.object, said.bytes, said.is_in_scope, said.matched, said.displayed))
        << i;
  }
}

TEST_F(EvidenceFile, OfBotsGivesBackWhatIsRoundedInMemory) {
  game::BotsTrace bots;
  bots.bots = {{100, {{-1.0 / 3.0, 100, true}, {2.0 / 3.0, 102, false}}}};
  bots.replicas = {{.object = 7,
                    .bytes = 8,
                    .is_in_scope = true,
                    .matched = {1.0 / 3.0, -2.0 / 3.0},
                    .displayed = {1.0 / 3.0 + 1e-12, 1e-10}},
                   {.object = 8,
                    .bytes = 8,
                    .is_in_scope = true,
                    .matched = {10.0 / 3.0, 0.0},
                    .displayed = {10.0 / 3.0, 0.0}}};
  bots.samples = {{.bot = 0,
                   .displayed_s = 1.0 / 3.0,
                   .matched_s = 0.3,
                   .window_s = 0.05,
                   .first = 0,
                   .last = 2}};
  write_trace(file(), bots);
  const game::BotsTrace read = game::read_bots_trace(file()), in_memory = rounded(bots);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(read.bots[0].changes[i].instant_s, in_memory.bots[0].changes[i].instant_s) << i;
    EXPECT_EQ(read.replicas[i].matched, in_memory.replicas[i].matched) << i;
    EXPECT_EQ(read.replicas[i].displayed, in_memory.replicas[i].displayed) << i;
  }
  EXPECT_EQ(read.samples[0].displayed_s, in_memory.samples[0].displayed_s);
}

TEST_F(EvidenceFile, OfBotsWithASampleThatIsNoneIsRefusedWithItsLineAndWhatWasExpected) {
  const std::string head =
      R"({"bot":0,"displayed_s":1,"matched_s":1,"window_s":0.1,"entities_nm":)";
  const auto complaint = [&](const std::string& sample) {
    game::TraceWriter writer(file());
    writer.line({{"rink-bots-evidence", 1},
                 {"clients", 1},
                 {"from_s", 0.0},
                 {"until_s", 2.0},
                 {"is_complete", true},
                 {"bots", 1},
                 {"samples", 1}});
    writer.line_of_text(R"({"bat":100,"changes_us":[]})");
    writer.line_of_text(sample);
    writer.finish();
    try {
      game::read_bots_trace(file());
    } catch (const game::TraceError& error) {
      const std::string found = error.what();
      return found.starts_with(file()) ? found.substr(file().size()) : found;
    }
    return std::string("no complaint");
  };
  EXPECT_EQ(complaint(head + "[[7,8,1]]}"),
            ":3: expected an entity as object, bytes and no, one or two positions");
  EXPECT_EQ(complaint(head + "[[7,8],[]]}"),
            ":3: expected an entity as object, bytes and no, one or two positions");
  EXPECT_EQ(complaint(head + "[[7,8,1,2,3,4,5]]}"),
            ":3: expected an entity as object, bytes and no, one or two positions");
  EXPECT_EQ(complaint(head + "[[7,8]"), ":3: expected JSON");
  EXPECT_EQ(complaint(R"({"bot":1,"displayed_s":1,"matched_s":1,"window_s":0.1,"entities_nm":[]})"),
            ":3: expected a bot below 1");
  EXPECT_EQ(
      complaint(R"({"bot":-1,"displayed_s":1,"matched_s":1,"window_s":0.1,"entities_nm":[]})"),
      ":3: expected a bot below 1");
  EXPECT_EQ(complaint(R"({"bot":0,"displayed_s":1,"matched_s":1,"entities_nm":[]})"),
            ":3: expected a sample with window_s");
  EXPECT_EQ(complaint(R"({"bot":0,"displayed_s":1,"matched_s":1,"window_s":0.1,"entities_nm":5})"),
            ":3: expected a sample with entities_nm");
  for (const std::string& other :
       {head + "[7,8]}", head + "[[7,[8]]]}", head + "[[7,8.5]]}", head + "[[\"7\",8]]}",
        head + "null}", head + "[[-7,8]]}", head + "[[7,4294967296]]}",
        std::string(R"({"bot":0,"displayed_s":[1]})"), std::string(R"({"bot":{}})"),
        std::string("[]"), std::string("[[7,8]]"), std::string("7"), std::string("null")})
    EXPECT_EQ(complaint(other), ":3: expected a sample as docs/metrics.md describes it") << other;
}

/// A peer's player is written as a bot is, whose lines follow the peer's own.
TEST_F(EvidenceFile, OfAPeerEndsWithItsPlayerAndIsRefusedInAnEarlierVersion) {
  game::BotsTrace player;
  player.clients = 2, player.until_s = 3.0;
  player.bots = {{.object = 5, .changes = {{1.25, 7, true}}}};
  player.replicas = {{.object = 7,
                      .bytes = 12,
                      .is_in_scope = true,
                      .matched = {1.5, 2.5},
                      .displayed = {1.75, 2.5}}};
  player.samples = {{.bot = 0, .displayed_s = 2.0, .matched_s = 1.9, .window_s = 0.1, .last = 1}};
  game::PeerTrace peer;
  peer.peer = 1, peer.peer_count = 2, peer.player = player;
  peer.events = {{game::PeerTrace::Kind::key, 0.5, 0.75, 0}};
  game::write_trace(file(), peer);
  const game::PeerTrace read = game::read_peer_trace(file());
  EXPECT_EQ(read.peer, 1u);
  ASSERT_TRUE(read.player);
  ASSERT_EQ(read.player->bots.size(), 1u);
  EXPECT_EQ(read.player->bots.front().object, 5u);
  EXPECT_EQ(read.player->bots.front().changes.front().instant_s, 1.25);
  ASSERT_EQ(read.player->replicas.size(), 1u);
  EXPECT_EQ(read.player->replicas.front().displayed, player.replicas.front().displayed);
  game::BotsTrace both = player;
  append(both, *read.player);
  ASSERT_EQ(both.samples.size(), 2u);
  EXPECT_EQ(both.samples.back().bot, 1u);
  EXPECT_EQ(both.samples.back().first, 1u);
  EXPECT_EQ(both.samples.back().last, 2u);

  game::TraceWriter writer(file());
  writer.line({{"rink-peer-evidence", 1}});
  writer.finish();
  try {
    game::read_peer_trace(file());
    ADD_FAILURE() << "of version 1";
  } catch (const game::TraceError& error) {
    EXPECT_THAT(error.what(), HasSubstr("a peer's evidence of version 2, found version 1"));
  }
}

/// FNV-1a of 64 bits: its offset, then for each byte an exclusive or and its prime.
TEST_F(EvidenceFile, EndsWithTheNumberOfItsLinesAndTheHashOfTheBytesBefore) {
  write_trace(file(), game::BotsTrace{});
  const std::string text = test::text_of(file());
  const std::size_t last = text.rfind('\n', text.size() - 2) + 1;
  std::uint64_t hash = 14'695'981'039'346'656'037u;
  for (const char byte : text.substr(0, last))
    hash = (hash ^ static_cast<unsigned char>(byte)) * 1'099'511'628'211u;
  char expected[64];
  std::snprintf(expected, sizeof expected, "{\"lines\":1,\"fnv1a\":\"%016llx\"}\n",
                static_cast<unsigned long long>(hash));
  EXPECT_EQ(text.substr(last), expected);
}

/// A client that is told by hand of what comes into its scope.
class WatchedClient : public testing::Test {
 protected:
  void discover(std::uint32_t first, std::uint32_t count) {
    for (std::uint32_t object = first; object < first + count; ++object)
      callbacks_.discover_object_instance({object}, model_.entity, "it-" + std::to_string(object)),
          told(object, true);
  }
  void told(std::uint32_t object, bool is_in) {
    is_in ? callbacks_.attributes_in_scope({object}) : callbacks_.attributes_out_of_scope({object});
  }

  const rti::Fom fom_ = game::load_rink_fom(game::fom_file());
  const game::ObjectModel model_{fom_};
  game::Client client_{fom_, model_, {.name = "bat-0"}};
  rti::FederateAmbassador& callbacks_ = client_;
};

TEST_F(WatchedClient, OfWhatChangesOnlySoMuchIsKeptAndThatSomeIsMissingIsSaid) {
  for (const std::size_t record_max : {5u, 6u}) {
    BotsRecorder recorder(
        {.seed = 1, .clients = 1, .from_s = 0.0, .until_s = 2.0, .record_max = record_max},
        {&client_});
    for (std::uint32_t object = 1; object <= 6; ++object) told(object, false);
    recorder.listen(0, 0.5);
    EXPECT_EQ(recorder.trace().bots[0].changes.size(), record_max);
    EXPECT_EQ(recorder.trace().is_complete, record_max == 6);
  }
}

/// In a hundred samples of one replica set there is room for 1,500 entities each, 60 bytes apiece:
/// of 4,000 every third is given.
TEST_F(WatchedClient, OfALargeMirrorEveryNthEntityIsGivenFromADrawnOneOn) {
  BotsRecorder recorder({.seed = 1, .clients = 1, .from_s = 0.0, .until_s = 10.0}, {&client_});
  constexpr std::uint32_t count = 4'000, nth = 3;
  discover(1, count);
  recorder.listen(0, 0.0);
  while (recorder.next_sample_s() < 10.0) recorder.sample(recorder.next_sample_s());
  const game::BotsTrace trace = recorder.trace();
  ASSERT_EQ(trace.samples.size(), 100u);
  EXPECT_LE(trace.replicas.size(), 150'000u);
  std::vector<int> begun(nth + 1, 0);
  for (const game::BotsTrace::Sample& sample : trace.samples) {
    ASSERT_GE(sample.last - sample.first, count / nth);
    for (std::size_t i = sample.first + 1; i < sample.last; ++i)
      ASSERT_EQ(trace.replicas[i].object - trace.replicas[i - 1].object, nth);
    ASSERT_LE(trace.replicas[sample.first].object, nth);
    ++begun[trace.replicas[sample.first].object];
  }
  EXPECT_THAT(begun, ElementsAre(0, testing::Gt(20), testing::Gt(20), testing::Gt(20)))
      << "33 of 100 on average";
}

/// What a file has room for is given whole.
TEST_F(WatchedClient, OfASmallMirrorEveryEntityIsGiven) {
  BotsRecorder recorder({.seed = 1, .clients = 1, .from_s = 0.0, .until_s = 10.0}, {&client_});
  discover(1, 1'500);
  recorder.listen(0, 0.0);
  recorder.sample(recorder.next_sample_s());
  EXPECT_EQ(recorder.trace().replicas.size(), 1'500u);
}

}  // namespace
}  // namespace rink::loadgen
