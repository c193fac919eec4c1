// The command rink duel, option by option, against hosts that it plays with over TCP.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <chrono>
#include <fstream>
#include <memory>
#include <optional>
#include <set>

#include "game/control/key_log_file.h"
#include "game/process/process.h"
#include "tests/places.h"
#include "tests/temporary_folder.h"

namespace rink::game {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using namespace std::chrono_literals;

std::string program(const std::string& name) { return test::binary_folder() + "/bin/rink-" + name; }

/// A puck that flies past both bats into the right goal, 0.3 s after the start; one goal wins.
constexpr const char* short_match = R"(name = "short"
[field]
length = 1.2
width = 0.6
goal_width = 0.6
bats_keep_to_half = true
[match]
goals_to_win = 1
face_off_delay = 0.1
face_off_distance = 0.25
[[bat]]
position = [0.2, 0.1]
half_extent = [0.03, 0.05]
team = "left"
[[bat]]
position = [1.0, 0.1]
half_extent = [0.03, 0.05]
team = "right"
[[puck]]
position = [0.6, 0.5]
velocity = [2.0, 0.0]
)";

/// A host and a duel that plays there.
struct ADuel {
  ADuel(const std::vector<std::string>& options, const std::string& scene = "match") {
    if (scene != "match") std::ofstream(folder / "short.toml") << scene;
    host = std::make_unique<Process>(
        program("serve"),
        std::vector<std::string>{scene == "match" ? "match" : (folder / "short.toml").string(),
                                 "--port", "0", "--countdown", "0.2", "--record", records()});
    std::optional<std::string> place;
    for (int i = 0; i < 500 && !place; ++i)
      host->attend(10ms), place = host->line_after("listening on ");
    std::vector<std::string> words{"--connect", place.value_or("")};
    words.insert(words.end(), options.begin(), options.end());
    duel = std::make_unique<Process>(program("duel"), words);
  }

  std::string records() const { return (folder / "records").string(); }
  /// The exit status, once it is there; the host ends its records then.
  int status() {
    for (int i = 0; i < 1000 && !duel->ending(); ++i) duel->attend(10ms);
    if (!duel->ending()) return -1;
    host->stop(5s);
    return duel->ending()->exit_status;
  }
  KeyLog record(int number) const {
    return read_key_log(std::filesystem::path(records()) /
                        ("match-" + std::to_string(number) + ".keys"));
  }
  bool has_record(int number) const {
    return std::filesystem::exists(std::filesystem::path(records()) /
                                   ("match-" + std::to_string(number) + ".keys"));
  }
  /// What follows `name` in what was said of the left one.
  double told(const std::string& name) const {
    const std::string line = duel->line_after("left: ").value_or("");
    const auto at = line.find(name + " ");
    return at == std::string::npos ? -1.0 : std::stod(line.substr(at + name.size() + 1));
  }

  test::TemporaryFolder folder{"duel"};
  std::unique_ptr<Process> host, duel;
};

TEST(DuelCommand, PlaysAsManyMatchesAsItIsAskedFor) {
  for (const int count : {1, 2}) {
    ADuel two({"--matches", std::to_string(count)}, short_match);
    EXPECT_EQ(two.status(), 0) << two.duel->stderr_tail();
    EXPECT_TRUE(two.has_record(count));
    EXPECT_FALSE(two.has_record(count + 1));
    EXPECT_THAT(two.duel->line_after("left: ").value_or(""), HasSubstr("1 to 0"));
    // In each the puck flies 0.6 m at 2 m/s.
    EXPECT_NEAR(two.told("played"), 0.3 * count, 0.2 * count);
  }
}

TEST(DuelCommand, LeavesWhenItsTimeIsOver) {
  ADuel two({"--duration", "1"});
  const auto begin = std::chrono::steady_clock::now();
  EXPECT_EQ(two.status(), 0) << two.duel->stderr_tail();
  EXPECT_GE(std::chrono::steady_clock::now() - begin, 900ms);
  EXPECT_GT(two.told("played"), 0.0);
  EXPECT_LT(two.told("played"), 1.0);
}

/// An answer is seen at the frame after it came.
TEST(DuelCommand, DrawsAsManyFramesAsItIsAskedFor) {
  ADuel slow({"--duration", "1.2", "--frame-rate", "10"}),
      quick({"--duration", "1.2", "--frame-rate", "200"});
  EXPECT_EQ(slow.status(), 0) << slow.duel->stderr_tail();
  EXPECT_EQ(quick.status(), 0) << quick.duel->stderr_tail();
  EXPECT_GE(slow.told("ping"), 90.0);
  EXPECT_LT(quick.told("ping"), 60.0);
}

/// The first keys of each player.
std::vector<Key> first_keys(const KeyLog& log) {
  std::vector<Key> keys;
  for (const std::uint32_t player : {0u, 1u})
    for (const InputEvent& event : log.events)
      if (event.player == player && event.kind == InputKind::key_down) {
        keys.push_back(event.key);
        break;
      }
  return keys;
}

TEST(DuelCommand, PlaysByItsSeed) {
  std::vector<std::unique_ptr<ADuel>> duels;
  for (const char* seed : {"3", "3", "4", "5", "6", "7"})
    duels.push_back(std::make_unique<ADuel>(
        std::vector<std::string>{"--players", "waypoint", "--duration", "1", "--seed", seed}));
  std::vector<std::vector<Key>> keys;
  for (const auto& each : duels) {
    ASSERT_EQ(each->status(), 0) << each->duel->stderr_tail();
    keys.push_back(first_keys(each->record(1)));
    ASSERT_EQ(keys.back().size(), 2u);
  }
  EXPECT_EQ(keys[0], keys[1]);
  EXPECT_GT(std::set<std::vector<Key>>(keys.begin(), keys.end()).size(), 1u)
      << "other seeds go elsewhere";
}

int status_of(const std::vector<std::string>& words, std::string& said) {
  Process duel(program("duel"), words, {});
  for (int i = 0; i < 1000 && !duel.ending(); ++i) duel.attend(10ms);
  said = duel.stderr_tail();
  return duel.ending() ? duel.ending()->exit_status : -1;
}

TEST(DuelCommand, NamesTheFlagThatIsWrongAndWhatIsAllowed) {
  const std::vector<std::array<std::string, 3>> cases{
      {"--matches", "0", "from 1 to 1000"},
      {"--matches", "1001", "from 1 to 1000"},
      {"--duration", "-1", "is not a number from 0"},
      {"--duration", "nan", "is not a number from 0"},
      {"--frame-rate", "9", "from 10 to 1000"},
      {"--frame-rate", "1e9", "from 10 to 1000"},
      {"--players", "nobody", "waypoint"},
      {"--seed", "x", "--seed"},
      {"--connect", "nowhere", "ADDRESS:PORT"}};
  for (const auto& [flag, value, expected] : cases) {
    std::string said;
    EXPECT_EQ(status_of({flag, value}, said), 2) << flag << ' ' << value;
    EXPECT_THAT(said, AllOf(HasSubstr(flag), HasSubstr(expected))) << flag << ' ' << value;
  }
}

TEST(DuelCommand, SaysThatNobodyListens) {
  std::string said;
  EXPECT_NE(status_of({"--connect", "127.0.0.1:1"}, said), 0);
  EXPECT_THAT(said, HasSubstr("127.0.0.1:1"));
}

}  // namespace
}  // namespace rink::game
