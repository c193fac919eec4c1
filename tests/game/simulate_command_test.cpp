// The command rink simulate, run as its users run it.
#include <gmock/gmock.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>

#include "game/control/game.h"
#include "game/control/key_log_file.h"
#include "game/control/simulate_progress.h"
#include "game/model/report_schema.h"
#include "im/basics/hexadecimal.h"
#include "tests/command.h"
#include "tests/game/rink_scenes.h"
#include "tests/places.h"

namespace rink::game {
namespace {

using ::testing::HasSubstr;

class SimulateCommand : public test::CommandTest {
 protected:
  SimulateCommand() : CommandTest("simulate") {}
  int simulate(const std::string& arguments) { return run("simulate " + arguments); }
};

TEST_F(SimulateCommand, WritesTheStatesAndTheHashOfTheGameThatItPlays) {
  const Scene scene = small_crowd(5, 9);
  KeyLog log = key_log_for(scene);
  log.events = {{0.1, 0, InputKind::key_down, Key::up}, {0.3, 4, InputKind::key_down, Key::left}};
  write_key_log(std::filesystem::path(file("keys")), log);
  ASSERT_EQ(simulate("crowd --bats 5 --seed 9 --until 1.5 --keys " + file("keys") + " --states " +
                     file("states.csv") + " --summary " + file("summary.json")),
            0)
      << said_;

  Game game(scene);
  for (const InputEvent& event : log.events) game.submit(event);
  game.advance(1.5);
  std::ostringstream states, hash;
  states.precision(17);
  states << "kind,id,x,y,vx,vy\n";
  for (const Entity& entity : game.entities()) {
    const Vector2 x = game.position(entity.id), v = game.velocity(entity.id);
    states << (entity.kind == physics::BodyKind::puck  ? "puck,"
               : entity.kind == physics::BodyKind::bat ? "bat,"
                                                       : "post,");
    states << entity.id.index << ',' << x.x() << ',' << x.y() << ',' << v.x() << ',' << v.y()
           << '\n';
  }
  hash << std::hex << game.hash();
  EXPECT_EQ(content("states.csv"), states.str());
  const std::string summary = content("summary.json");
  EXPECT_THAT(summary,
              testing::StartsWith("{\n  \"schema\": " + std::to_string(report_schema) + ",\n"))
      << "like all JSON reports";
  EXPECT_THAT(summary, HasSubstr(hash.str()));
  for (const char* key : {"events", "collisions", "events_by_kind", "kinetic_energy", "momentum_x",
                          "momentum_y", "work_of_thrust", "dissipated", "max_overlap", "escapes",
                          "hash", "wall_s", "bodies_touched", "predictions", "evaluations"})
    EXPECT_THAT(summary, HasSubstr('"' + std::string(key) + "\":"));
}

/// The lines of a file without its heading.
std::vector<std::string> rows_of(const std::string& file) {
  std::ifstream stream(file);
  std::vector<std::string> rows;
  for (std::string line; std::getline(stream, line);) rows.push_back(line);
  rows.erase(rows.begin());
  return rows;
}

TEST_F(SimulateCommand, WritesALineForEveryEventThatTheSummaryCounts) {
  for (const std::string engine : {"exact", "paper", "naive"}) {
    ASSERT_EQ(simulate("crowd --bats 5 --seed 9 --players chaser --until 4 --engine " + engine +
                       " --events " + file("events.csv")),
              0)
        << said_;
    const std::vector<std::string> rows = rows_of(file("events.csv"));
    const std::string summary = printed_;
    for (const char* kind : physics::event_kind_names) {
      const auto count = std::count_if(rows.begin(), rows.end(), [&](const std::string& row) {
        return row.find(',' + std::string(kind) + ',') != std::string::npos;
      });
      const std::string heading = '"' + std::string(kind) + "\": ";
      ASSERT_THAT(summary, HasSubstr(heading)) << engine;
      EXPECT_EQ(std::stol(summary.substr(summary.find(heading) + heading.size())), count)
          << engine << ' ' << kind;
    }
    EXPECT_GT(rows.size(), 50u) << engine;
  }
}

TEST_F(SimulateCommand, PlaysTheSameKeysOnEveryEngine) {
  std::ofstream(file("bats.toml"))
      << "[field]\nlength = 9.0\nwidth = 9.0\n[drag]\nbats = 1.0\n[[bat]]\nname = \"b\"\nposition "
         "= [4.0, 4.0]\nhalf_extent = [0.1, 0.1]\n"
         "[[key]]\ntime = 0.1\nbat = \"b\"\nkey = \"up\"\nis_down = true\n[[key]]\ntime = "
         "0.55\nbat = \"b\"\nkey = \"up\"\nis_down = false\n";
  const auto height = [&](const std::string& flags) {
    EXPECT_EQ(simulate(file("bats.toml") + " --until 1 --states " + file("states.csv") + flags), 0)
        << said_;
    std::istringstream row(rows_of(file("states.csv")).front());
    std::string value;
    for (int column = 0; column < 4; ++column) std::getline(row, value, ',');
    return std::stod(value);
  };
  const double exact = height("");
  EXPECT_GT(exact, 5.0);
  EXPECT_NEAR(height(" --engine paper"), exact, 0.1);
  EXPECT_NEAR(height(" --engine naive --integrator verlet --dt 0.01"), exact, 1e-3);
  EXPECT_NEAR(height(" --engine paper --integrator rk4 --dt 0.01"), exact, 1e-9);
}

TEST_F(SimulateCommand, NamesTheAllowedEnginesAndIntegratorsAndRefusesEndlessFrames) {
  EXPECT_EQ(simulate("match --until 1 --engine box2d"), 2);
  EXPECT_THAT(said_, HasSubstr("the engine box2d is unknown: expected one of exact, paper, naive"));
  EXPECT_EQ(simulate("match --until 1 --engine paper --integrator rk5"), 2);
  EXPECT_THAT(
      said_,
      HasSubstr(
          "the integrator rk5 is unknown: expected one of euler, semi_implicit, verlet, rk4"));
  for (const std::string dt : {"0", "-0.01", "nan", "inf"}) {
    EXPECT_EQ(simulate("match --until 1 --engine paper --dt " + dt), 2) << dt;
    EXPECT_THAT(said_, HasSubstr("expected a finite length above 0 s")) << dt;
  }
  EXPECT_EQ(simulate("match --until 1 --engine naive --dt 1e-300"), 2);
  EXPECT_THAT(said_, HasSubstr("frames"));
  EXPECT_EQ(simulate("match --until 1 --dt 0.01"), 2);
  EXPECT_THAT(said_, HasSubstr("--dt is for the engines paper and naive"));
  EXPECT_EQ(simulate("match --until 1 --integrator rk4"), 2);
  EXPECT_THAT(said_, HasSubstr("--integrator is for the engines paper and naive"));
}

TEST(SimulateProgress, SaysNothingOfShortRunsALineNowAndThenOtherwiseAndOverwritesItOnATerminal) {
  std::ostringstream file, terminal;
  SimulateProgress to_file(file, false, 100.0), to_terminal(terminal, true, 100.0);
  for (int tenth = 0; tenth < 140; ++tenth)
    for (SimulateProgress* progress : {&to_file, &to_terminal})
      progress->reached(tenth / 10.0, 1000, tenth / 10.0);
  to_terminal.clear();
  const std::string lines = file.str(), line = terminal.str();
  EXPECT_EQ(std::count(lines.begin(), lines.end(), '\n'), 3);
  EXPECT_THAT(
      lines, HasSubstr("2 of 100 s simulated (2.0 %), 1000 events, 2 s passed, about 98 s left\n"));
  EXPECT_EQ(std::count(line.begin(), line.end(), '\n'), 0);
  EXPECT_EQ(line.substr(line.size() - 4), "\r\033[K");
}

TEST_F(SimulateCommand, EndsWithStatus2AndOneLineOnBadInput) {
  std::ofstream(file("bad.toml")) << "[field]\nlength = 4.0\nwidth = -2.0\n";
  EXPECT_EQ(simulate(file("bad.toml") + " --until 1"), 2);
  EXPECT_EQ(said_, "rink simulate: " + file("bad.toml") +
                       ":3: field.width is -2.0: expected a number from 0.001 to 1e+09\n");
  EXPECT_EQ(simulate("crowd --until inf"), 2);
  EXPECT_THAT(said_, HasSubstr("runs neither backwards nor for ever"));
  EXPECT_EQ(simulate("crowd --until -1"), 2);
  EXPECT_EQ(simulate("crowd --until nan"), 2);
  EXPECT_THAT(said_, HasSubstr("expected a finite time"));
  EXPECT_EQ(simulate("crowd"), 2);
  EXPECT_THAT(said_, HasSubstr("--until"));
  EXPECT_EQ(simulate("crowd --until 1e300"), 2);
  EXPECT_THAT(said_, HasSubstr("at most 1e9 s"));
  for (const char* seed : {"-1", "1.5", "18446744073709551616", "x"}) {
    EXPECT_EQ(simulate(std::string("crowd --until 0 --seed ") + seed), 2) << seed;
    EXPECT_THAT(said_, HasSubstr("is not a whole number from 0 to 18446744073709551615")) << seed;
  }
  EXPECT_EQ(simulate("crowd --until 0 --seed 18446744073709551615"), 0) << said_;
  EXPECT_EQ(simulate("no-such-preset --until 1"), 2);
  EXPECT_EQ(simulate("match --until 1 --keys " + file("missing")), 2);
  EXPECT_EQ(simulate("match --until 1 --states " + file("no/such/folder.csv")), 2);
}

TEST_F(SimulateCommand, StopsAtItsBudgetAndSaysWhoSpentItAndWhy) {
  std::ofstream scene(file("row.toml"));
  scene << "[field]\nlength = 0.9375000000001\nwidth = 0.25\n";
  for (int k = 0; k < 15; ++k)
    scene << "[[puck]]\nposition = [" << 0.03125 * (2 * k + 1)
          << ", 0.125]\nradius = 0.03125\nvelocity = [" << (k == 7 ? 50.0 : 0.0) << ", 0.0]\n";
  scene.close();
  EXPECT_EQ(simulate(file("row.toml") + " --until 1 --budget 20000 --states " + file("states.csv") +
                     " --record " + file("keys")),
            3);
  EXPECT_THAT(said_, testing::StartsWith("rink simulate: stopped by --budget: 20001 events within "
                                         "a simulated second where 20000 may be, at "));
  EXPECT_THAT(said_, HasSubstr("with no room"));
  EXPECT_EQ(std::ranges::count(said_, '\n'), 1);
  EXPECT_THAT(printed_, HasSubstr("\"is_exceeded\": true"));
  EXPECT_THAT(printed_, HasSubstr("\"reason\": \"no_room\""));
  EXPECT_EQ(rows_of(file("states.csv")).size(), 15u);
  EXPECT_FALSE(read_key_log(std::filesystem::path(file("keys"))).hash);
}

TEST_F(SimulateCommand, PlaysTheSameGameWithinItsBudget) {
  const auto hash_of_printed = [this] { return printed_.substr(printed_.find("\"hash\""), 30); };
  ASSERT_EQ(simulate("crowd --bats 5 --players chaser --until 1"), 0);
  const std::string hash = hash_of_printed();
  EXPECT_EQ(printed_.find("budget"), std::string::npos);
  ASSERT_EQ(simulate("crowd --bats 5 --players chaser --until 1 --budget 1000000000000"), 0);
  EXPECT_EQ(hash_of_printed(), hash);
  EXPECT_THAT(printed_, HasSubstr("\"is_exceeded\": false"));
}

TEST_F(SimulateCommand, RefusesABudgetOfNothingOrForEnginesThatStep) {
  for (const char* budget : {"0", "-1", "x", "0.5", "1e3", "2000000000000"}) {
    EXPECT_EQ(simulate(std::string("crowd --until 0 --budget ") + budget), 2) << budget;
    EXPECT_THAT(said_, HasSubstr(std::string("--budget: ") + budget +
                                 " is not a whole number from 1 to 1000000000000"))
        << budget;
  }
  EXPECT_EQ(simulate("crowd --until 0 --engine paper --budget 5"), 2);
  EXPECT_THAT(said_, HasSubstr("--budget is for the exact engine"));
}

/// More pucks than are played in order, in a gas at packing .1.
void write_gas(const std::string& file, const std::string& more = "") {
  std::ofstream(file) << "[field]\nlength = 8.0\nwidth = 8.0\n"
                      << more
                      << "[[population]]\nname = \"gas\"\nkind = \"puck\"\ncount = 21000\n"
                         "radius = 0.01\nmean_speed = 1.0\n";
}

/// What the summary says of the game; not how it was played.
nlohmann::json played(const std::string& summary) {
  nlohmann::json results = nlohmann::json::parse(summary);
  for (const char* key : {"wall_s", "predictions", "evaluations", "stale_events", "crossings"})
    results.erase(key);
  return results;
}

TEST_F(SimulateCommand, PlaysTheSameGameWithAnyNumberOfThreads) {
  write_gas(file("gas.toml"));
  const std::string arguments =
      file("gas.toml") + " --until 0.02 --events " + file("events.csv") + " --threads ";
  ASSERT_EQ(simulate(arguments + "1"), 0) << said_;
  const nlohmann::json alone = played(printed_);
  const std::string events = content("events.csv");
  EXPECT_GT(alone.at("collisions"), 1000);
  for (const char* threads : {"2", "3"}) {
    ASSERT_EQ(simulate(arguments + threads), 0) << said_;
    EXPECT_EQ(played(printed_), alone) << threads;
    EXPECT_TRUE(content("events.csv") == events) << threads;
  }
}

TEST_F(SimulateCommand, RefusesNoThreadsAndMoreThanBodiesOrThanAnyMachineRuns) {
  for (const char* threads : {"0", "-1", "x", "1.5", "257"}) {
    EXPECT_EQ(simulate(std::string("crowd --until 0 --threads ") + threads), 2) << threads;
    EXPECT_THAT(said_, HasSubstr("--threads")) << threads;
    EXPECT_THAT(said_, HasSubstr("1 to 256")) << threads;
  }
  EXPECT_EQ(simulate("match --until 0 --threads 5"), 0) << said_;
  EXPECT_EQ(simulate("match --until 0 --threads 6"), 2);
  EXPECT_EQ(said_,
            "rink simulate: --threads: 6 threads for 5 bodies: expected at most as many threads as "
            "bodies\n");
  EXPECT_EQ(simulate("crowd --until 0 --engine paper --threads 2"), 2);
  EXPECT_THAT(said_, HasSubstr("--threads is for the exact engine"));
}

TEST_F(SimulateCommand, WritesTheResultsOfTheInstantAtWhichItIsInterrupted) {
  const std::string command =
      "timeout --foreground --preserve-status -s INT 0.5 " + test::binary_folder() +
      "/bin/rink-simulate crowd --bats 5 --players chaser --until 1e6 --states " +
      file("states.csv") + " --events " + file("events.csv") + " --record " + file("keys") + " >" +
      file("printed") + " 2>" + file("said");
  EXPECT_EQ(WEXITSTATUS(std::system(command.c_str())), 130);
  EXPECT_THAT(content("said"), testing::StartsWith("rink simulate: interrupted: the results are "
                                                   "those of "));
  EXPECT_THAT(content("events.csv"), testing::EndsWith("\n"));
  const KeyLog log = read_key_log(std::filesystem::path(file("keys")));
  ASSERT_TRUE(log.until && log.hash);
  EXPECT_GT(*log.until, 0.0);
  EXPECT_LT(*log.until, 1e6);
  EXPECT_THAT(content("printed"), HasSubstr(hexadecimal(*log.hash)));
  EXPECT_GT(rows_of(file("states.csv")).size(), 5u);
}

TEST_F(SimulateCommand, SaysWhyAFileCannotBeWritten) {
  for (const std::string flag : {"--states", "--events", "--summary", "--record"}) {
    EXPECT_EQ(simulate("crowd --bats 5 --until 1 " + flag + " /nowhere/at/all"), 2) << flag;
    EXPECT_EQ(said_,
              "rink simulate: /nowhere/at/all: cannot be written: No such file or directory\n");
    EXPECT_EQ(simulate("crowd --bats 5 --until 1 " + flag + " /dev/full"), 2) << flag;
    EXPECT_EQ(said_,
              "rink simulate: /dev/full: cannot be written to its end: No space left on device\n")
        << flag;
  }
}

TEST(SceneDocumentation, ShowsASceneThatLoadsAndPlays) {
  const std::string page = test::text_of(test::source_folder() + "/docs/scenes.md");
  const std::size_t start = page.find("```toml\n") + 8;
  const Scene scene =
      parse_scene(page.substr(start, page.find("```", start) - start), "docs/scenes.md");
  EXPECT_EQ(scene.name, "duel");
  EXPECT_EQ(scene.keys.size(), 1u);
  Game game(scene);
  game.advance(2.0);
  EXPECT_EQ(game.input_count(0), 1u);
}

}  // namespace
}  // namespace rink::game
