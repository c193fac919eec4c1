// Interest told by running processes of rink-peer: their players see others' bodies, the game stays
// that of one engine, and what they say of themselves adds up.
#include <nlohmann/json.hpp>
#include <numeric>

#include "game/net/peer/network/seating.h"
#include "game/net/peer/peer_trace.h"
#include "game/players/random_plan.h"
#include "tests/peer_command/peer_processes.h"

namespace rink::game {
namespace {

class Viewing : public PeerCommand {
 protected:
  static nlohmann::json report_of(const std::filesystem::path& file) {
    return nlohmann::json::parse(std::ifstream(file), nullptr, false);
  }

  /// Random keys for all bats of the small scene.
  std::filesystem::path plan(double until) {
    const Scene small = load_scene(scene());
    KeyLog log = key_log_for(small);
    log.events = random_plan(7, static_cast<std::uint32_t>(small.bodies.bats.size()), until);
    write_key_log(folder_ / "plan.keys", log);
    return folder_ / "plan.keys";
  }
};

TEST_F(Viewing, ShowsPlayersWhatOthersHaveAndLeavesTheGameAsItIs) {
  for (const char* scheme : {"none", "grid", "region", "aura"}) {
    const Words view{"--bots", "1", "--players", "chaser", "--view-area", "2"};
    Words first_words{"--scheme", scheme,
                      "--record", (folder_ / "live.keys").string(),
                      "--report", (folder_ / "first.json").string()};
    first_words.insert(first_words.end(), view.begin(), view.end());
    Process& first = found(3, "1", first_words);
    Process& second = join(first, view);
    Process& third = join(first, {"--bots", "2", "--players", "random", "--view", "1"});
    for (const Process* peer : {&first, &second, &third}) {
      ASSERT_TRUE(ends(*peer));
      EXPECT_EQ(peer->ending()->exit_status, 0) << scheme << ": " << peer->stderr_tail();
    }
    const nlohmann::json view_of_first = report_of(folder_ / "first.json")["view"];
    EXPECT_GT(view_of_first["updates_bytes"], 0) << scheme;
    EXPECT_GT(view_of_first["in_view"], 0) << scheme;
    EXPECT_EQ(view_of_first["interest_bytes"] > 0, std::string(scheme) != "none");
    const KeyLog log = read_key_log(folder_ / "live.keys");
    EXPECT_EQ(hash_of(second), printed(*log.hash));
    EXPECT_EQ(hash_of(third), printed(*log.hash));
  }
}

TEST_F(Viewing, GoesOnWhenAPeerIsKilled) {
  const Words view{"--view-area", "3", "--keys", plan(3.0).string()};
  Words first_words{"--scheme",
                    "region",
                    "--seated",
                    "--pace",
                    "realtime",
                    "--report",
                    (folder_ / "first.json").string()};
  first_words.insert(first_words.end(), view.begin(), view.end());
  Process& first = found(3, "3", first_words);
  Process& second = join(first, view);
  Process& third = join(first, view);
  ASSERT_TRUE(are_playing({&first, &second, &third}));
  until([] { return false; }, 1s);
  ASSERT_EQ(kill(second.id(), SIGKILL), 0);
  ASSERT_TRUE(ends(first) && ends(third));
  Game one(load_scene(scene()));
  for (const InputEvent& key : read_key_log(folder_ / "plan.keys").events) one.submit(key);
  one.advance(3.0);
  EXPECT_EQ(hash_of(third), printed(one.hash())) << third.stderr_tail();
  EXPECT_GT(report_of(folder_ / "first.json")["view"]["in_view"], 0);
}

TEST_F(Viewing, LetsNewcomersInWhoSeeAndAreSeen) {
  for (const std::string scheme : {"none", "region"}) {
    const auto file = [&](int k) {
      return (folder_ / ("peer" + std::to_string(k) + ".json")).string();
    };
    const auto words = [&](int k, Words further) {
      const Words all{"--pace",      "realtime", "--bots",   "1",
                      "--view-area", "100",      "--report", file(k)};
      further.insert(further.end(), all.begin(), all.end());
      return further;
    };
    const auto is_in = [&](const Process& peer) {
      return until([&] {
               return peer.stderr_tail().find(" is in from ") != std::string::npos || peer.ending();
             }) &&
             !peer.ending();
    };
    const std::string record = (folder_ / (scheme + ".keys")).string();
    Process& first = found(1, "5", words(0, {"--scheme", scheme, "--record", record}));
    ASSERT_TRUE(are_playing({&first}));
    Process& second = join(first, words(1, {}));
    ASSERT_TRUE(is_in(second)) << second.stderr_tail();
    Process& third = join(second, words(2, {}));
    ASSERT_TRUE(is_in(third)) << third.stderr_tail();
    ASSERT_EQ(kill(second.id(), SIGINT), 0);
    ASSERT_TRUE(ends(second) && ends(first) && ends(third));
    const KeyLog log = read_key_log(std::filesystem::path(record));
    Game one(load_scene(scene()));
    for (const InputEvent& key : log.events) one.submit(key);
    one.advance(5.0);
    EXPECT_TRUE(std::any_of(log.events.begin(), log.events.end(),
                            [](const InputEvent& key) { return key.player > 0; }));
    for (const int k : {0, 2})
      EXPECT_EQ(report_of(file(k))["hash"].dump(), printed(one.hash())) << scheme;
    for (const int k : {0, 1, 2}) {
      const nlohmann::json view = report_of(file(k))["view"];
      EXPECT_GT(view["updates_bytes"], 0)
          << scheme << ": peer " << k << " tells nobody of what it owns";
      EXPECT_EQ(view["interest_bytes"] > 0, scheme == "region");
      EXPECT_GT(view["in_view"], 0) << scheme;
    }
    EXPECT_GT(report_of(file(0))["view"]["told_of"], 0) << scheme;
    EXPECT_GT(report_of(file(2))["view"]["told_of"], 0) << scheme;
  }
}

TEST_F(Viewing, EvidenceAccountsForEveryByteAndAgreesWithTheKernel) {
  const auto file = [&](int k, const char* ending) {
    return (folder_ / ("peer" + std::to_string(k) + ending)).string();
  };
  const auto words = [&](int k, Words first) {
    const Words all{"--keys",   plan(2.0).string(), "--pace", "realtime",   "--view-area",
                    "3",        "--warm-up",        "0.5",    "--evidence", file(k, ".jsonl"),
                    "--report", file(k, ".json")};
    first.insert(first.end(), all.begin(), all.end());
    return first;
  };
  Process& first = found(3, "2",
                         words(0, {"--scheme", "region", "--seated", "--unmirrored", "--balance",
                                   "0", "--window", "0.05"}));
  Process& second = join(first, words(1, {}));
  Process& third = join(first, words(2, {}));
  for (const Process* peer : {&first, &second, &third}) {
    ASSERT_TRUE(ends(*peer));
    ASSERT_EQ(peer->ending()->exit_status, 0) << peer->stderr_tail();
  }
  std::uint64_t sent = 0, received = 0;
  std::vector<bool> is_there(3, false);
  for (int k = 0; k < 3; ++k) {
    const PeerTrace trace = read_peer_trace(file(k, ".jsonl"));
    is_there[trace.peer] = true;
    const auto sum = [](const TrafficBytes& bytes) {
      return std::accumulate(bytes.begin(), bytes.end(), std::uint64_t{0});
    };
    EXPECT_EQ(sum(trace.end.bytes) - sum(trace.begin.bytes),
              trace.end.bytes_sent - trace.begin.bytes_sent);
    EXPECT_NEAR(trace.end.instant_s - trace.begin.instant_s, 1.5, 0.5);
    sent += trace.end.bytes_sent - trace.begin.bytes_sent,
        received += trace.end.bytes_received - trace.begin.bytes_received;
    ASSERT_TRUE(trace.player) << "fewer players than are watched";
    EXPECT_GE(trace.player->samples.size(), 15u);
    const auto known = std::count_if(
        trace.events.begin(), trace.events.end(),
        [](const PeerTrace::Event& event) { return event.kind == PeerTrace::Kind::known; });
    EXPECT_EQ(known, 40);
    for (const PeerTrace::Event& event : trace.events) EXPECT_GE(event.instant_s, event.due_s);
    const nlohmann::json transport = report_of(file(k, ".json"))["transport"];
    EXPECT_NEAR(transport["bytes_sent"].get<double>(), transport["kernel_bytes_sent"].get<double>(),
                400.0);
    EXPECT_NEAR(transport["bytes_received"].get<double>(),
                transport["kernel_bytes_received"].get<double>(),
                16.0);  // the kernel counts a connection's end
  }
  EXPECT_THAT(is_there, testing::Each(true));
  // What is on its way when one of them looks is another's a little later.
  EXPECT_NEAR(static_cast<double>(sent), static_cast<double>(received),
              0.1 * static_cast<double>(sent));
}

TEST_F(Viewing, RefusesWhatCannotBe) {
  const auto complaint = [&](Words words) {
    const Process& peer = found(2, "1", std::move(words));
    EXPECT_TRUE(ends(peer));
    EXPECT_EQ(peer.ending()->exit_status, static_cast<int>(ExitStatus::bad_input));
    return peer.stderr_tail();
  };
  EXPECT_THAT(complaint({"--scheme", "regoin"}), HasSubstr("regoin"));
  EXPECT_THAT(complaint({"--scheme", "region", "--policy", "snapshot"}), HasSubstr("snapshot"));
  EXPECT_THAT(complaint({"--scheme", "region", "--always", "puck"}),
              HasSubstr("does not name always"));
  EXPECT_THAT(complaint({"--always", "puck"}),
              HasSubstr("--always: there is no scheme that could ask: expected one that does"));
  EXPECT_THAT(complaint({"--seated", "--bots", "1"}), HasSubstr("expected no --bots"));
  EXPECT_THAT(complaint({"--evidence", (folder_ / "e.jsonl").string()}),
              HasSubstr("expected --pace realtime"));
  EXPECT_THAT(complaint({"--seated", "--bat-count", "1"}),
              HasSubstr("2 peers, but the scene has 1 bats"));
}

}  // namespace
}  // namespace rink::game
