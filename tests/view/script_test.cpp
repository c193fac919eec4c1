// Scripts: what they press and when, and what is said about wrong ones.
#include "game/view/script.h"

#include <gmock/gmock.h>

namespace rink::view {
namespace {

using ::testing::HasSubstr;

TEST(Script, StepsComeInOrderOfTimeAndATapIsTwoOfThem) {
  const auto steps = parse_script(
      "# a comment\n2 picture a b.png\n1 tap enter  # press\n\n1.5 text hi\n3 end\n", "s");
  ASSERT_EQ(steps.size(), 5u);
  EXPECT_TRUE(steps[0].events.at(0).is_down);
  EXPECT_DOUBLE_EQ(steps[1].time, 1.05);
  EXPECT_FALSE(steps[1].events.at(0).is_down);
  EXPECT_EQ(steps[2].events.size(), 2u);
  EXPECT_EQ(steps[3].picture, "a b.png");
  EXPECT_TRUE(steps[4].is_end);
}

TEST(Script, MovesAPointerAndAStick) {
  const auto steps =
      parse_script("0 pointer 0.5 -0.25\n1 stick -1 0.5\n2 gamepad on\n3 gamepad off\n", "s");
  ASSERT_EQ(steps.size(), 4u);
  using Kind = WindowEvent::Kind;
  EXPECT_EQ(steps[0].events.at(0).kind, Kind::pointer);
  EXPECT_EQ(steps[0].events.at(0).y, -0.25);
  EXPECT_EQ(steps[1].events.at(0).kind, Kind::stick);
  EXPECT_EQ(steps[1].events.at(0).x, -1.0);
  EXPECT_TRUE(steps[2].events.at(0).is_down);
  EXPECT_FALSE(steps[3].events.at(0).is_down);
}

TEST(Script, EachStepIsDueOnce) {
  const auto steps = parse_script("0 down a\n0.5 up a\n0.5 down b\n2 end\n", "s");
  std::size_t next = 0;
  EXPECT_EQ(due_steps(steps, next, 0.0).size(), 1u);
  EXPECT_EQ(due_steps(steps, next, 0.4).size(), 0u);
  EXPECT_EQ(due_steps(steps, next, 1.0).size(), 2u);
  EXPECT_EQ(due_steps(steps, next, 9.0).size(), 1u);
  EXPECT_EQ(due_steps(steps, next, 10.0).size(), 0u);
}

TEST(Script, AWrongLineIsNamed) {
  for (const char* text :
       {"0 end\nsoon down a\n", "0 end\n-1 down a\n", "0 end\nnan down a\n", "0 end\n1 hold a\n",
        "0 end\n1 down hyper\n", "0 end\n1 picture\n", "0 end\n1 pointer 0.5\n",
        "0 end\n1 pointer 0.5 nan\n", "0 end\n1 stick 0.5 1.5\n", "0 end\n1 gamepad maybe\n"})
    try {
      parse_script(text, "my.script");
      ADD_FAILURE() << text;
    } catch (const ScriptError& error) {
      EXPECT_THAT(error.what(), HasSubstr("my.script:2: ")) << text;
    }
}

}  // namespace
}  // namespace rink::view
