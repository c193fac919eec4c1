// The command rink simulate, run as its users run it.
#include <gmock/gmock.h>
#include <sys/wait.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "game/control/game.h"
#include "game/control/key_log.h"
#include "rink_scenes.h"

namespace rink::game {
namespace {

using ::testing::HasSubstr;

std::string text_of(const std::filesystem::path& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

class SimulateCommand : public ::testing::Test {
 protected:
  SimulateCommand() : folder_(::testing::TempDir() + "/rink-simulate-" + ::testing::UnitTest::GetInstance()->current_test_info()->name()) { std::filesystem::create_directories(folder_); }
  ~SimulateCommand() override { std::filesystem::remove_all(folder_); }

  std::string file(const std::string& name) const { return (folder_ / name).string(); }
  /// The exit status; what the command says on standard error is in `said_`.
  int run(const std::string& arguments) {
    const std::string command = std::string(RINK_BINARY_DIR) + "/bin/rink-simulate " + arguments + " >" + file("out") + " 2>" + file("err");
    const int status = std::system(command.c_str());
    said_ = text_of(file("err"));
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }

  std::filesystem::path folder_;
  std::string said_;
};

TEST_F(SimulateCommand, WritesTheStatesAndTheHashOfTheGameThatItPlays) {
  const Scene scene = small_crowd(5, 9);
  KeyLog log = key_log_for(scene);
  log.events = {{0.1, 0, InputKind::key_down, Key::up}, {0.3, 4, InputKind::key_down, Key::left}};
  write_key_log(std::filesystem::path(file("keys")), log);
  ASSERT_EQ(run("crowd --bats 5 --seed 9 --until 1.5 --keys " + file("keys") + " --states " + file("states.csv") + " --summary " + file("summary.json")), 0) << said_;

  Game game(scene);
  for (const InputEvent& event : log.events) game.submit(event);
  game.advance(1.5);
  std::ostringstream states, hash;
  states.precision(17);
  states << "kind,id,x,y,vx,vy\n";
  for (const Entity& entity : game.entities()) {
    const Vector2 x = game.position(entity.id), v = game.velocity(entity.id);
    states << (entity.kind == physics::BodyKind::puck ? "puck," : entity.kind == physics::BodyKind::bat ? "bat," : "post,");
    states << entity.id.index << ',' << x.x() << ',' << x.y() << ',' << v.x() << ',' << v.y() << '\n';
  }
  hash << std::hex << game.hash();
  EXPECT_EQ(text_of(file("states.csv")), states.str());
  const std::string summary = text_of(file("summary.json"));
  EXPECT_THAT(summary, HasSubstr(hash.str()));
  for (const char* key : {"events", "collisions", "events_by_kind", "kinetic_energy", "momentum_x", "momentum_y", "hash", "wall_s"}) EXPECT_THAT(summary, HasSubstr('"' + std::string(key) + "\":"));
}

TEST_F(SimulateCommand, EndsWithStatus2AndOneLineOnBadInput) {
  std::ofstream(file("bad.toml")) << "[field]\nlength = 4.0\nwidth = -2.0\n";
  EXPECT_EQ(run(file("bad.toml") + " --until 1"), 2);
  EXPECT_EQ(said_, "rink simulate: " + file("bad.toml") + ":3: field.width is -2.0: expected a number above 0\n");
  EXPECT_EQ(run("crowd --until inf"), 2);
  EXPECT_THAT(said_, HasSubstr("neither runs backwards nor for ever"));
  EXPECT_EQ(run("crowd --until -1"), 2);
  EXPECT_EQ(run("crowd"), 2);
  EXPECT_THAT(said_, HasSubstr("--until"));
  EXPECT_EQ(run("no-such-preset --until 1"), 2);
  EXPECT_EQ(run("match --until 1 --keys " + file("missing")), 2);
  EXPECT_EQ(run("match --until 1 --states " + file("no/such/folder.csv")), 2);
}

TEST(SceneDocumentation, ShowsASceneThatLoadsAndPlays) {
  const std::string page = text_of(std::string(RINK_SOURCE_DIR) + "/docs/scenes.md");
  const std::size_t start = page.find("```toml\n") + 8;
  const Scene scene = parse_scene(page.substr(start, page.find("```", start) - start), "docs/scenes.md");
  EXPECT_EQ(scene.name, "duel");
  EXPECT_EQ(scene.keys.size(), 1u);
  Game game(scene);
  game.advance(2.0);
  EXPECT_EQ(game.input_count(0), 1u);
}

}  // namespace
}  // namespace rink::game
