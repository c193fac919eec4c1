// The command rink-serve from its arguments to its exit status and last words, as a careless user
// would start it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "game/control/key_log_file.h"
#include "game/control/replay.h"
#include "game/net/address.h"
#include "game/net/fom_file.h"
#include "game/net/server/serve_status.h"
#include "game/process/process.h"
#include "game/replication/names.h"
#include "rti/management/federation_report.h"
#include "rti/transport/federate_link.h"
#include "rti/transport/tcp/tcp.h"
#include "tests/net/guest.h"
#include "tests/places.h"
#include "tests/reserved_port.h"
#include "tests/temporary_folder.h"

namespace rink::game {
namespace {

using testing::HasSubstr;
using namespace std::chrono_literals;

TEST(ServeCommand, NumbersThatAreNoneOrTooLargeAreNamedWithWhatIsAllowed) {
  for (const char* flag :
       {"--rate", "--duration", "--warm-up", "--patience", "--cell-size", "--bats", "--clients"}) {
    for (const char* value : {"nan", "inf", "-1", "1e300", "4000000000", "x"}) {
      const Ended ended = serve({"--scene", "match", flag, value});
      EXPECT_EQ(ended.status, 2) << flag << ' ' << value;
      EXPECT_THAT(ended.words, HasSubstr(flag));
      EXPECT_THAT(ended.words, HasSubstr("is not a number from")) << flag << ' ' << value;
    }
  }
}

TEST(ServeCommand, WholeNumbersThatAreNoneOrTooLargeForTheirTypeAreNamedWithWhatIsAllowed) {
  constexpr const char* port = "--port";
  for (const auto& [flag, most] :
       {std::pair(port, "65535"), std::pair("--seed", "18446744073709551615")})
    for (const char* value : {"99999999999999999999", "-1", "1.5", "x", ""}) {
      const Ended ended = run("rink-serve", {"--scene", "match", flag, value});
      EXPECT_EQ(ended.status, 2) << flag << ' ' << value;
      EXPECT_THAT(ended.words, HasSubstr(flag + std::string(": ") + value +
                                         " is not a whole number from 0 to " + most));
    }
}

TEST(ServeCommand, CellsTooSmallToCountAreRefused) {
  for (const char* value : {"1e-308", "0.0009"}) {
    const Ended ended = serve({"--scene", "match", "--cell-size", value});
    EXPECT_EQ(ended.status, 2) << value;
    EXPECT_THAT(ended.words,
                testing::AllOf(HasSubstr("--cell-size"),
                               HasSubstr("is not a number from 0.001 to 1e+06, nor 0")));
  }
}

TEST(ServeCommand, RefusesASizeOfCellsForASchemeWithoutAny) {
  for (const char* scheme : {"none", "region", "aura", "grid(cell_size=2) or region"}) {
    const Ended ended = serve({"--scene", "match", "--scheme", scheme, "--cell-size", "0.5"});
    EXPECT_EQ(ended.status, 2);
    EXPECT_THAT(ended.words, testing::AllOf(HasSubstr(std::string("--cell-size: the scheme ") +
                                                      scheme + " has no cells"),
                                            HasSubstr("grid, hex")));
  }
}

TEST(ServeCommand, RefusesWhatIsAlwaysRelevantToASchemeThatDoesNotAsk) {
  const Ended ended =
      serve({"--scene", "match", "--scheme", "aura or team", "--always", "puck,post"});
  EXPECT_EQ(ended.status, 2);
  EXPECT_THAT(ended.words, HasSubstr("--always: the scheme aura or team does not name always"));
  EXPECT_THAT(serve({"--scheme", "always", "--always", "pucks"}).words,
              HasSubstr("--always: pucks not in {puck,bat,post}"));
}

TEST(ServeCommand, LoadsTheModulesThatAFederationFileListsAndNamesBothPlacesWhereTheyContradict) {
  const test::TemporaryFolder folder("modules");
  std::ofstream(folder / "own.fom.xml")
      << R"(<objectModel><objects><objectClass><name>HLAobjectRoot</name><objectClass><name>Entity</name>
<attribute><name>shape</name><dataType>HLAoctet</dataType></attribute></objectClass></objectClass></objects></objectModel>)";
  std::ofstream(folder / "rink.toml")
      << "federation = \"rink\"\nfom = [\"" + test::source_folder() +
             "/game/net/rink.fom.xml\", \"own.fom.xml\"]\naddress = \"127.0.0.1\"\nport = 7000\n";
  const Ended ended =
      run("rink-serve", {"--scene", "match", "--federation", (folder / "rink.toml").string()});
  EXPECT_NE(ended.status, 0);
  EXPECT_THAT(
      ended.words,
      testing::AllOf(
          HasSubstr("own.fom.xml:2: InconsistentFDD: <attribute> 'shape' of class 'Entity'"),
          HasSubstr("game/net/rink.fom.xml:")));
}

TEST(ServeCommand, RecordsAllThatAReplayNeedsToComeToTheSameHash) {
  const test::TemporaryFolder folder("record");
  const std::filesystem::path file = folder / "serve.keys";
  const Ended ended =
      serve({"--scene", "crowd", "--bat-count", "10", "--puck-count", "30", "--seed", "4",
             "--clients", "0", "--duration", "0.5", "--record", file.string()});
  ASSERT_EQ(ended.status, 0) << ended.words;
  const KeyLog log = read_key_log(file);
  require_complete(log, file.string());
  EXPECT_EQ(log.until, 0.5);
  EXPECT_EQ(replay(log, recorded_scene(log, file.string())), log.hash);
}

TEST(ServeCommand, MorePlayersThanBatsEndAtOnce) {
  const Ended ended = serve({"--scene", "match", "--clients", "3"});
  EXPECT_EQ(ended.status, 2);
  EXPECT_THAT(ended.words, HasSubstr("--clients: 3 players, but scene 'match' has 2 bats"));
}

TEST(ServeCommand, ResultsThatCannotBeWrittenAreNamedBeforeTheRun) {
  for (const char* flag : {"--report", "--record"}) {
    const Ended ended = serve({"--scene", "match", "--duration", "3600", flag, "/nowhere/at/all"});
    EXPECT_EQ(ended.status, 2);
    EXPECT_THAT(ended.words, HasSubstr(std::string(flag) + ": cannot write '/nowhere/at/all'"));
  }
}

TEST(ServeCommand, InterruptedWhileItWaitsForTurnsItEndsInOrder) {
  const test::TemporaryFolder folder("report");
  const std::filesystem::path report = folder / "serve.json";
  Process server(
      test::binary_folder() + "/bin/rink-serve",
      {"--scene", "match", "--pace", "synchronous", "--port", "0", "--report", report.string()},
      {});
  const auto limit =
      std::chrono::steady_clock::now() + 6s;  // longer than the RTI lets a federate be silent
  while (!server.ending() && std::chrono::steady_clock::now() < limit) server.attend(20ms);
  server.stop(5s);
  EXPECT_EQ(server.ending()->exit_status, 130) << server.stderr_tail();
  EXPECT_EQ(nlohmann::json::parse(std::ifstream(report)).at("why_invalid"), "interrupted");
}

/// Waits until so many players of the server there have each ended twenty turns.
bool takes_turns(const std::string& place, std::uint32_t players) {
  const auto [address, port] = address_and_port("place", place);
  const auto now_s = [] {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch())
        .count();
  };
  for (const double limit = now_s() + 15.0; now_s() < limit; std::this_thread::sleep_for(20ms)) {
    const StatusAnswer answer = ask_status({.address = address, .port = port}, now_s);
    if (!answer.reports || answer.reports->empty()) continue;
    const auto playing = std::ranges::count_if(
        answer.reports->front().federates, [](const rti::FederateReport& federate) {
          return federate.name != "server" && federate.counts.interactions_sent >= 20;
        });
    if (static_cast<std::uint32_t>(playing) == players) return true;
  }
  return false;
}

TEST(ServeCommand, UnderTimeManagementTheSameKeysGiveTheSameStateAndAKilledPlayerHoldsNobodyBack) {
  std::vector<std::string> hashes;
  for (const bool is_managed : {false, true, true}) {
    const bool loses_one = hashes.size() == 2;
    const test::TemporaryFolder folder("report");
    const std::filesystem::path report = folder / "serve.json";
    std::vector<std::string> flags{
        "--scene",   "crowd",  "--bat-count", "6",      "--clients", "6",        "--puck-count",
        "30",        "--pace", "synchronous", "--port", "0",         "--report", report.string(),
        "--duration"};
    flags.push_back(loses_one ? "200" : "2");
    if (is_managed) flags.push_back("--time-management");
    Process server(test::binary_folder() + "/bin/rink-serve", flags, {});
    const std::optional<std::string> place = place_of(server);
    ASSERT_TRUE(place) << server.stderr_tail();
    const std::vector<std::string> bots{"--connect", *place, "--count",    "3",
                                        "--seed",    "5",    "--duration", flags[15]};
    Process first(test::binary_folder() + "/bin/rink-bots", bots, {});
    std::vector<std::string> others = bots;
    others.insert(others.end(), {"--first", "3"});
    Process second(test::binary_folder() + "/bin/rink-bots", others, {});
    const auto limit = std::chrono::steady_clock::now() + 20s;
    for (bool is_killed = false; !server.ending() && std::chrono::steady_clock::now() < limit;
         is_killed = true) {
      if (loses_one && !is_killed) {
        ASSERT_TRUE(takes_turns(*place, 6)) << server.stderr_tail();
        second.stop(0s);
      }
      for (Process* each : {&server, &first, &second}) each->attend(10ms);
    }
    ASSERT_TRUE(server.ending()) << server.stderr_tail();
    const nlohmann::json told = nlohmann::json::parse(std::ifstream(report));
    EXPECT_EQ(told.at("time_managed"), is_managed);
    EXPECT_EQ(told.at("ticks"), loses_one ? 6000 : 60);
    EXPECT_EQ(told.at("lost_federates"), loses_one ? 3 : 0);
    hashes.push_back(told.at("state_hash"));
  }
  EXPECT_EQ(hashes[0], hashes[1]);
}

/// Its processes' threads, from the kernel.
std::ptrdiff_t thread_count(const Process& process) {
  return std::distance(
      std::filesystem::directory_iterator("/proc/" + std::to_string(process.id()) + "/task"), {});
}

TEST(ServeCommand, ASecondCoreIsAnotherThreadThatChangesNoDecision) {
  std::vector<nlohmann::json> reports;
  std::vector<std::ptrdiff_t> threads;
  for (const bool has_second_core : {false, true}) {
    const test::TemporaryFolder folder("second-core");
    const std::filesystem::path report = folder / "serve.json";
    std::vector<std::string> flags{
        "--scene",      "crowd", "--bat-count", "4",      "--clients", "4",
        "--puck-count", "4000",  "--scheme",    "region", "--pace",    "synchronous",
        "--port",       "0",     "--duration",  "0.5",    "--report",  report.string()};
    if (has_second_core) flags.push_back("--second-core");
    Process server(test::binary_folder() + "/bin/rink-serve", flags, {});
    const std::optional<std::string> place = place_of(server);
    ASSERT_TRUE(place) << server.stderr_tail();
    threads.push_back(thread_count(server));
    EXPECT_EQ(
        run("rink-bots", {"--connect", *place, "--count", "4", "--seed", "5", "--duration", "0.5"})
            .status,
        0);
    for (int i = 0; i < 1000 && !server.ending(); ++i) server.attend(10ms);
    ASSERT_TRUE(server.ending());
    EXPECT_EQ(server.ending()->exit_status, 0) << server.stderr_tail();
    reports.push_back(nlohmann::json::parse(std::ifstream(report)));
  }
  EXPECT_EQ(threads[1], threads[0] + 1);
  for (const char* key : {"state_hash", "ticks", "scope_entries", "scope_exits",
                          "filter_regions_moved", "filter_pairs_tested", "messages_sent"})
    EXPECT_EQ(reports[0].at(key), reports[1].at(key)) << key;
  // What a client was sent before the start, by when it joined, spares it static values and bytes
  // of stamps after it.
  const auto bytes = [&](std::size_t run) {
    return reports[run].at("state_bytes_sent").get<double>();
  };
  EXPECT_NEAR(bytes(0), bytes(1), 0.005 * bytes(0));
  EXPECT_GT(reports[0].at("scope_exits"), 0);
}

TEST(ServeCommand, PlaysTheSameGameWithAnotherThread) {
  const test::TemporaryFolder folder("threads");
  const std::filesystem::path scene = folder / "gas.toml", report = folder / "serve.json";
  std::ofstream(scene) << "[field]\nlength = 8.0\nwidth = 8.0\n[[population]]\nname = \"gas\"\n"
                          "kind = \"puck\"\ncount = 21000\nradius = 0.01\nmean_speed = 1.0\n";
  std::vector<nlohmann::json> hashes;
  for (const char* threads : {"1", "2"}) {
    const Ended server = serve({"--scene", scene.string(), "--clients", "0", "--duration", "0.1",
                                "--threads", threads, "--report", report.string()});
    ASSERT_EQ(server.status, 0) << server.words;
    hashes.push_back(nlohmann::json::parse(std::ifstream(report)).at("state_hash"));
  }
  EXPECT_EQ(hashes[0], hashes[1]);
}

TEST(ServeCommand, RefusesMoreThreadsThanBodies) {
  for (const auto& [threads, objection] :
       {std::pair("0", "1 to 256"), std::pair("257", "1 to 256"),
        std::pair("6", "--threads: 6 threads for 5 bodies: expected at most as many threads as")}) {
    const Ended server =
        run("rink-serve", {"--scene", "match", "--port", "0", "--threads", threads});
    EXPECT_NE(server.status, 0);
    EXPECT_THAT(server.words, HasSubstr(objection));
  }
}

TEST(ServeCommand, WaitsForExactlyTheNodesThatAFederationFileListsAndRefusesOthers) {
  const test::TemporaryFolder folder("listed");
  const std::string file = (folder / "listed.toml").string();
  const test::ReservedPort port;
  std::ofstream(file) << "federation = \"listed\"\nfom = \"" + test::source_folder() +
                             "/game/net/rink.fom.xml\"\n[[node]]\nname = \"server\"\naddress = "
                             "\"127.0.0.1\"\nport = " +
                             port.text() +
                             "\n[[node]]\nname = \"Ada\"\n[[node]]\nname = \"Grace\"\n";
  const std::vector<std::string> flags{
      "--scene", "match", "--federation", file, "--duration", "0.3", "--rate", "60", "--patience"};
  const auto serve_for = [&](const std::string& patience_s) {
    std::vector<std::string> all = flags;
    all.push_back(patience_s);
    return std::make_unique<Process>(test::binary_folder() + "/bin/rink-serve", all);
  };
  const auto first = serve_for("20");
  while (!first->line_after("listening on ") && !first->ending()) first->attend(10ms);
  const Ended stranger = run("rink-bots", {"--connect", "127.0.0.1:" + port.text(), "--federation",
                                           "listed", "--duration", "0.2"});
  EXPECT_EQ(stranger.status, 14);
  EXPECT_THAT(
      stranger.words,
      HasSubstr(
          "members are listed by name in its federation file, and this federate is none of them"));
  const Ended listed =
      run("rink-bots", {"--federation-file", file, "--count", "2", "--duration", "0.2"});
  EXPECT_EQ(listed.status, 0) << listed.words;
  for (int i = 0; i < 500 && !first->ending(); ++i) first->attend(10ms);
  ASSERT_TRUE(first->ending());
  EXPECT_EQ(first->ending()->exit_status, 0) << first->stderr_tail();

  const auto second = serve_for("1");
  while (!second->line_after("listening on ") && !second->ending()) second->attend(10ms);
  run("rink-bots", {"--federation-file", file, "--duration", "0.2", "--patience", "2"});
  for (int i = 0; i < 500 && !second->ending(); ++i) second->attend(10ms);
  ASSERT_TRUE(second->ending());
  EXPECT_EQ(second->ending()->exit_status, 17);
  EXPECT_THAT(second->stderr_tail(), HasSubstr("1 of 2 players came within 1 s; missing: Grace"));
  EXPECT_THAT(run("rink-bots", {"--federation-file", file, "--count", "3"}).words,
              HasSubstr("lists 2"));
}

TEST(ServeCommand, APlayerWhoNeverGetsReadyCostsTheServerNothingButThePatience) {
  Process server(test::binary_folder() + "/bin/rink-serve",
                 {"--scene", "match", "--clients", "1", "--patience", "7", "--port", "0"}, {});
  const std::optional<std::string> place = place_of(server);
  ASSERT_TRUE(place) << server.stderr_tail();
  struct : rti::FederateAmbassador {
  } deaf;  // joins and lives, but takes no seat and reaches no barrier
  const rti::Fom fom = load_rink_fom(fom_file());
  rti::Ambassador ambassador(fom, deaf);
  rti::TcpTransport tcp;
  const auto [address, port] = address_and_port("--connect", *place);
  rti::FederateLink link(ambassador, tcp, tcp.connect(address, port));
  rti::FederateLinks links;
  links.add(link);
  ambassador.join("rink", "bat-0", player_federate_type);
  const auto start = std::chrono::steady_clock::now();
  while (!server.ending() && std::chrono::steady_clock::now() - start < 12s) {
    links.flush(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
    tcp.poll(20ms, links);
    server.attend(1ms);
  }
  ASSERT_TRUE(server.ending());
  EXPECT_EQ(server.ending()->exit_status, 17) << "players did not come";
  EXPECT_THAT(server.stderr_tail(),
              HasSubstr("1 players came, but not all were ready to start within 7 s"));
}

}  // namespace
}  // namespace rink::game
