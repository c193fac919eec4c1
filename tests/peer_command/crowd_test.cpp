// Keys of a crowd of bots on their way through peers: one number says what was pressed and how.
#include "game/net/peer/crowd.h"

#include <gtest/gtest.h>

#include <set>

#include "game/model/scene_file.h"
#include "game/players/player_kinds.h"
#include "tests/places.h"

namespace rink::game {
namespace {

TEST(ACrowd, SaysEachKeyUpAndDownByANumberOfItsOwnAbove0) {
  std::set<std::uint8_t> numbers;
  for (const Key key : all_keys)
    for (const InputKind kind : {InputKind::key_down, InputKind::key_up}) {
      const InputEvent event{1.5, 7, kind, key};
      const std::uint8_t number = input_of(event);
      EXPECT_NE(number, 0) << "that is nothing";
      EXPECT_EQ(event_of(number, 1.5, 7), event);
      numbers.insert(number);
    }
  EXPECT_EQ(numbers.size(), 2 * all_keys.size());
}

/// Whatever a stranger says, it is a key.
TEST(ACrowd, ReadsSomeKeyFromAnyNumber) {
  for (int number = 1; number < 256; ++number) {
    const InputEvent event = event_of(static_cast<std::uint8_t>(number), 0.0, 0);
    EXPECT_LT(static_cast<std::size_t>(event.key), all_keys.size()) << number;
  }
}

TEST(ACrowd, WantsToSeeAsManyPucksAsItsMostCuriousKindDoes) {
  const Scene scene =
      parse_scene(scene_text(test::source_folder() + "/scenes/match.toml"), "match.toml");
  std::uint32_t most = 0;
  for (const std::string& kind : player_kinds())
    if (kind != "random")
      most = std::max(most, make_player(kind, rules_of(scene, 0), {}, 1)->pucks_wanted());
  EXPECT_GT(most, 0u);
  EXPECT_EQ(Crowd::pucks_wanted(scene, player_kinds()), most);
  EXPECT_EQ(Crowd::pucks_wanted(scene, {"random"}), 0u) << "it looks at nothing";
}

}  // namespace
}  // namespace rink::game
