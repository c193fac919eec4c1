// The command rink play, run as its users run it, without a display.
#include <gmock/gmock.h>
#include <sys/wait.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "game/view/render/image_file.h"
#include "game/view/render/offscreen.h"

namespace rink::view {
namespace {

using ::testing::HasSubstr;

bool can_draw() {
  try {
    const OffscreenContext context;
    return true;
  } catch (const GraphicsError&) {
    return false;
  }
}

class PlayCommand : public ::testing::Test {
 protected:
  PlayCommand() : folder_(::testing::TempDir() + "/rink-view-" + ::testing::UnitTest::GetInstance()->current_test_info()->name()) { std::filesystem::create_directories(folder_); }
  ~PlayCommand() override { std::filesystem::remove_all(folder_); }
  void SetUp() override {
    if (!can_draw()) GTEST_SKIP() << "no EGL with Mesa's surfaceless platform here";
  }

  std::string file(const std::string& name) const { return (folder_ / name).string(); }
  /// The exit status; what was said on standard error is in `said_`.
  int play(const std::string& arguments, const std::string& script = {}) {
    std::ofstream(file("script")) << script;
    const std::string command = "cd " + folder_.string() + " && env -u DISPLAY -u WAYLAND_DISPLAY XDG_CONFIG_HOME=" + folder_.string() + " " + RINK_BINARY_DIR + "/bin/rink-play " + arguments +
                                (script.empty() ? "" : " --offscreen --size 640x360 --script script") + " 2>err";
    const int status = std::system(command.c_str());
    std::ostringstream words;
    words << std::ifstream(file("err")).rdbuf();
    said_ = words.str();
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }

  std::filesystem::path folder_;
  std::string said_;
};

TEST_F(PlayCommand, TakesTheSamePicturesForTheSameScript) {
  const std::string script = "0.5 tap c\n3.2 down w\n4 picture a.png\n4.5 up w\n5 end\n";
  ASSERT_EQ(play("--bot expert", script), 0) << said_;
  const Image first = read_png(file("a.png"));
  ASSERT_EQ(play("--bot expert", script), 0) << said_;
  EXPECT_EQ(first.pixels, read_png(file("a.png")).pixels);
  EXPECT_EQ(first.width, 640);
}

TEST_F(PlayCommand, PlaysAgainstEachBotFromTheMenuToThePauseAndBack) {
  for (const std::string downs : {"", "0.6 tap down\n", "0.6 tap down\n0.7 tap down\n"})
    EXPECT_EQ(play("", "0.2 tap down\n0.4 tap enter\n" + downs + "0.8 tap enter\n5 tap escape\n5.2 tap down\n5.3 tap down\n5.5 tap enter\n6 picture a.png\n"), 0) << said_;
}

TEST_F(PlayCommand, SaysWhatIsWrongWithTheSettings) {
  std::filesystem::create_directories(file("rink"));
  std::ofstream(file("rink/play.toml")) << "[keys.left]\nup = \"hyper\"\n";
  ASSERT_EQ(play("", "0.2 picture trouble.png\n"), 0) << said_;
  EXPECT_THAT(said_, HasSubstr("play.toml:2: there is no key 'hyper'"));
}

TEST_F(PlayCommand, SavesAKeyThatWasBoundAnew) {
  // Settings are the sixth entry; the first button is the left player's left key.
  ASSERT_EQ(play("", "0.2 tap down\n0.3 tap down\n0.4 tap down\n0.5 tap down\n0.6 tap down\n0.7 tap enter\n0.9 tap space\n1.1 tap j\n1.3 picture bound.png\n1.4 end\n"), 0) << said_;
  std::ostringstream words;
  words << std::ifstream(file("rink/play.toml")).rdbuf();
  EXPECT_THAT(words.str(), HasSubstr("[keys.left]\nleft = \"j\"\n"));
}

TEST_F(PlayCommand, NeedsADisplayUnlessItDrawsOffscreen) {
  EXPECT_EQ(play("--two"), 18);
  EXPECT_THAT(said_, HasSubstr("xvfb"));
  EXPECT_EQ(play("--offscreen"), 2);
  EXPECT_EQ(play("--offscreen --screenshot a.png --size 9x9"), 2);
  EXPECT_EQ(play("--two --bot club"), 2);
}

}  // namespace
}  // namespace rink::view
