// The evidence of a tiny rink: read back, refused and spoilt.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>

#include "game/net/bots_trace.h"
#include "game/net/peer/peer_trace.h"
#include "game/net/server_trace.h"
#include "game/net/trace_lines.h"
#include "loadgen/measure/run_record.h"
#include "loadgen/measure/truth/replay.h"
#include "loadgen/measure/truth/truth.h"
#include "tests/loadgen/run/tiny_rink.h"

namespace rink::loadgen {
namespace {

using testing::HasSubstr;

TEST_F(TinyRink, AnotherGameThanTheServersIsRefused) {
  server_.state_hash ^= 1;
  EXPECT_THROW(judged(), DifferentGame);
}

TEST_F(TinyRink, EvidenceReadsBackAsItWasWritten) {
  decide(0.5, {bat, still, far});
  server_.keys = {
      {.time = 0.1 + 0.2, .player = 0, .kind = game::InputKind::key_up, .key = game::Key::down},
      {.time = 0.5, .player = 0, .kind = game::InputKind::push, .push = {-127, 3}}};
  server_.ticks = {{0.1, 1e-6, 2e-6, 3.5e-6}};
  server_.scheme = "grid";
  const std::string file = (folder_ / "server.jsonl").string();
  write_trace(file, server_);
  const game::ServerTrace read = game::read_server_trace(file);
  EXPECT_EQ(read.choice, server_.choice);
  EXPECT_EQ(read.keys, server_.keys);
  EXPECT_EQ(read.in_scope, server_.in_scope);
  EXPECT_EQ(read.scheme, "grid");
  EXPECT_EQ(read.state_hash, server_.state_hash);
  EXPECT_NEAR(read.ticks.at(0).send_s, 3.5e-6, 1e-15);

  bots_.replicas.push_back({.object = 7,
                            .bytes = 8,
                            .is_in_scope = true,
                            .matched = {1.25, -2.5},
                            .displayed = {1.5, -2.5}});
  bots_.samples.push_back(
      {.bot = 0, .displayed_s = 0.7, .matched_s = 0.6, .window_s = 0.05, .first = 0, .last = 1});
  const std::string bots_file = (folder_ / "bots.jsonl").string();
  write_trace(bots_file, bots_);
  const game::BotsTrace bots = game::read_bots_trace(bots_file);
  ASSERT_EQ(bots.replicas.size(), 1u);
  EXPECT_EQ(bots.replicas[0].displayed, Vector2(1.5, -2.5));
  EXPECT_EQ(bots.bots.at(0).changes.size(), 2u);
  EXPECT_EQ(bots.samples.at(0).matched_s, 0.6);
}

TEST_F(TinyRink, EvidenceOfAnotherVersionIsRefusedByBothNumbers) {
  const auto words_of = [&](const char* key, const auto& read) {
    const std::string file = (folder_ / "other.jsonl").string();
    game::TraceWriter writer(file);
    writer.line(nlohmann::ordered_json{{key, 3}});
    writer.finish();
    try {
      read(file);
    } catch (const game::TraceError& error) {
      return std::string(error.what());
    }
    return std::string("(accepted)");
  };
  EXPECT_THAT(
      words_of("rink-server-evidence", game::read_server_trace),
      HasSubstr("other.jsonl:1: expected a server's evidence of version 2, found version 3"));
  EXPECT_THAT(words_of("rink-peer-evidence", game::read_peer_trace),
              HasSubstr("expected a peer's evidence of version 2, found version 3"));
  EXPECT_THAT(words_of("rink-bots-evidence", game::read_bots_trace),
              HasSubstr("expected the bots' evidence of version 1, found version 3"));
  EXPECT_THAT(words_of("rink-bots-evidence", game::read_server_trace),
              HasSubstr("expected a server's evidence of version 2, found something else"));
}

TEST_F(TinyRink, SpoiltEvidenceCostsTheFiguresOfTruthAndNothingElse) {
  const std::string server_file = (folder_ / "server.jsonl").string(),
                    bots_file = (folder_ / "bots.jsonl").string();
  const auto judged_with = [&](auto&& spoil) {
    write_trace(server_file, server_);
    write_trace(bots_file, bots_);
    std::ostringstream text;
    text << std::ifstream(server_file).rdbuf();
    const std::string spoilt = spoil(text.str());
    std::ofstream(server_file) << spoilt;
    RunRecord record;
    record.valid = true;
    record.down_bytes_per_client_per_s = 5.0;
    record.cell.parameters.view_fraction = 0.01;
    const Experiment experiment;
    add_truth(record, experiment, server_file, bots_file);
    EXPECT_EQ(record.down_bytes_per_client_per_s, 5.0);
    return record;
  };
  const RunRecord sound = judged_with([](const std::string& text) { return text; });
  EXPECT_TRUE(sound.valid && sound.truth.error.empty()) << sound.truth.error;
  EXPECT_TRUE(sound.truth.interactions);
  const auto problem = [&](auto&& spoil) {
    const RunRecord record = judged_with(spoil);
    EXPECT_TRUE(record.valid);
    EXPECT_FALSE(record.truth.interactions);
    return record.truth.error;
  };
  EXPECT_THAT(problem([](std::string text) { return text.substr(0, text.size() / 2); }),
              HasSubstr("server.jsonl: truncated or altered"));
  EXPECT_THAT(problem([](std::string text) {
                return text.replace(text.find("\"rate_hz\":10"), 12, "\"rate_hz\":11");
              }),
              HasSubstr("altered"));
  EXPECT_THAT(problem([](std::string) { return std::string(); }), HasSubstr("truncated"));
  EXPECT_THAT(problem([&](std::string text) {
                std::filesystem::remove(bots_file);
                return text;
              }),
              HasSubstr("bots.jsonl: cannot be read"));
  bots_.is_complete = false;
  EXPECT_THAT(problem([](const std::string& text) { return text; }),
              HasSubstr("bots.jsonl: more scopes changed than there was room for"));
  bots_.is_complete = true;
  server_.state_hash ^= 1;
  const RunRecord other = judged_with([](std::string text) { return text; });
  EXPECT_FALSE(other.valid);
  EXPECT_THAT(other.why_invalid, HasSubstr("does not end in the server's state"));
}

}  // namespace
}  // namespace rink::loadgen
