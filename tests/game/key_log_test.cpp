// A key log reads back bit for bit, and what is wrong with it is said by line.
#include "game/control/key_log_file.h"

#include <gmock/gmock.h>

#include <bit>
#include <sstream>

#include "game/model/random_stream.h"
#include "tests/game/rink_scenes.h"

namespace rink::game {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

KeyLog read_text(const std::string& text) {
  std::istringstream stream(text);
  return read_key_log(stream, "bad.log");
}

std::string log_refusal(const std::string& text) {
  return refusal_of([&] { read_text(text); });
}

TEST(KeyLog, ReadsBackBitForBit) {
  constexpr std::uint64_t seed = 20;
  SCOPED_TRACE(seed);
  RandomStream random(seed);
  KeyLog log{.scene = "a crowd with spaces",
             .seed = ~0ull,
             .bats = 7,
             .fingerprint = 0x00ff00ff00ff00ffu,
             .until = 0.1,
             .hash = 77,
             .scene_text = "a = 1\n\n  # b | c\n",
             .is_sealed = true,
             .events = {}};
  double time = 0.0;
  for (int i = 0; i < 2000; ++i) {
    time += random.uniform() * (i % 7 == 0 ? 1e-12 : 1.0);
    const auto kind = static_cast<InputKind>(random.below(4));
    const bool has_key = kind == InputKind::key_down || kind == InputKind::key_up;
    log.events.push_back(
        {time, random.below(7), kind, has_key ? static_cast<Key>(random.below(4)) : Key::left});
  }
  std::stringstream stream;
  write_key_log(stream, log);
  EXPECT_EQ(read_key_log(stream, "round trip"), log);
}

TEST(KeyLog, IsTextThatPeopleCanWrite) {
  const KeyLog log = read_text(
      "rink-keys 1\nscene match\nseed 3\n# the left player starts\n0.5 0 down up\n\n1e0 1 leave\n");
  EXPECT_EQ(log.scene, "match");
  EXPECT_EQ(log.seed, 3u);
  EXPECT_FALSE(log.bats || log.fingerprint);
  EXPECT_EQ(log.events, (std::vector<InputEvent>{{0.5, 0, InputKind::key_down, Key::up},
                                                 {1.0, 1, InputKind::leave}}));
}

TEST(KeyLog, SaysWhichLineIsWrongAndWhatWasExpected) {
  EXPECT_THAT(log_refusal(""), AllOf(HasSubstr("bad.log:1"), HasSubstr("rink-keys 1")));
  EXPECT_THAT(log_refusal("rink-keys 5\n"),
              AllOf(HasSubstr("bad.log:1"), HasSubstr("rink-keys 1")));
  EXPECT_THAT(log_refusal("rink-keys 1\nseed x\n"),
              AllOf(HasSubstr("bad.log:2"), HasSubstr("whole number")));
  EXPECT_THAT(log_refusal("rink-keys 1\nspeed 4\n"), AllOf(HasSubstr("bad.log:2")));
  EXPECT_THAT(log_refusal("rink-keys 1\nnan 0 down up\n"),
              AllOf(HasSubstr("bad.log:2"), HasSubstr("from 0 to 1e9 s")));
  EXPECT_THAT(log_refusal("rink-keys 1\n-1 0 down up\n"),
              AllOf(HasSubstr("bad.log:2"), HasSubstr("from 0 to 1e9 s")));
  EXPECT_THAT(log_refusal("rink-keys 1\n1 -1 down up\n"),
              AllOf(HasSubstr("bad.log:2"), HasSubstr("player")));
  EXPECT_THAT(log_refusal("rink-keys 1\n1 0 hold up\n"),
              AllOf(HasSubstr("bad.log:2"), HasSubstr("down, up, enter or leave")));
  EXPECT_THAT(log_refusal("rink-keys 1\n1 0 down\n"),
              AllOf(HasSubstr("bad.log:2"), HasSubstr("one key")));
  EXPECT_THAT(log_refusal("rink-keys 1\n1 0 down north\n"),
              AllOf(HasSubstr("bad.log:2"), HasSubstr("left, right, up or down")));
  EXPECT_THAT(log_refusal("rink-keys 1\n1 0 leave now\n"),
              AllOf(HasSubstr("bad.log:2"), HasSubstr("nothing after leave")));
  EXPECT_THAT(log_refusal("rink-keys 1\n2 0 down up\n1 0 up up\n"),
              AllOf(HasSubstr("bad.log:3"), HasSubstr("not before")));
  EXPECT_THROW(read_key_log(std::filesystem::path("no/such.log")), SceneError);
}

TEST(KeyLog, ThatWasAlteredOrCutIsRefusedByLine) {
  KeyLog log;
  log.scene = "match";
  log.until = 2.0;
  log.hash = 5;
  log.scene_text = "a = 1\n";
  log.events = {{0.5, 0, InputKind::key_down, Key::up}, {0.75, 0, InputKind::key_up, Key::up}};
  std::ostringstream stream;
  write_key_log(stream, log);
  const std::string text = stream.str();
  EXPECT_TRUE(read_text(text).is_sealed);
  const std::size_t key = text.find("0.75"), end = text.find("end 2"), scene = text.find("a = 1");
  std::string altered = text;
  altered[key + 2] = '8';
  EXPECT_THAT(log_refusal(altered), AllOf(HasSubstr("bad.log:9"), HasSubstr("altered")));
  altered = text;
  altered[scene] = 'b';
  EXPECT_THAT(log_refusal(altered), AllOf(HasSubstr("bad.log:9"), HasSubstr("altered")));
  EXPECT_THAT(log_refusal(text.substr(0, key) + text.substr(end)),
              AllOf(HasSubstr("bad.log:8"), HasSubstr("missing")));
  EXPECT_THAT(log_refusal(text.substr(0, key + 6)), AllOf(HasSubstr("bad.log:8")));
  EXPECT_THAT(log_refusal(text + "3 0 down up\n"),
              AllOf(HasSubstr("bad.log:10"), HasSubstr("nothing after")));
  EXPECT_FALSE(read_text(text.substr(0, end))
                   .is_sealed);  // whole lines lack: for whoever needs the end to notice
}

TEST(KeyLog, FitsItsOwnSceneOnly) {
  const Scene scene = small_crowd(4, 1);
  KeyLog log = key_log_for(scene);
  EXPECT_NO_THROW(require_fit(log, scene, "keys.log"));
  EXPECT_THROW(require_fit(log, with_seed(scene, 2), "keys.log"), SceneError);
  log.events.push_back({1.0, 4, InputKind::key_down, Key::up});
  EXPECT_THROW(require_fit(log, scene, "keys.log"), SceneError);
}

}  // namespace
}  // namespace rink::game
