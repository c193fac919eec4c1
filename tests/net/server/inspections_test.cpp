// Questions about interest management, which are answered with the next tick.
#include "game/net/server/players/inspections.h"

#include <gtest/gtest.h>

namespace rink::game {
namespace {

TEST(Inspections, KeepTheNewestQuestionOfEachFederateUntilItIsTaken) {
  Inspections inspections;
  inspections.ask({4}, {10});
  inspections.ask({2}, {11});
  inspections.ask({4}, {12});
  const auto questions = inspections.take();
  ASSERT_EQ(questions.size(), 2u);
  EXPECT_EQ(questions[0].federate.value, 4u);
  EXPECT_EQ(questions[0].object.value, 12u);
  EXPECT_EQ(questions[1].object.value, 11u);
  EXPECT_TRUE(inspections.take().empty());
}

}  // namespace
}  // namespace rink::game
