// Faulty conditions and scores are refused with their column and with what is allowed.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "im/expression_fault.h"
#include "im/filter.h"

namespace rink::im {
namespace conditions {
namespace {

using testing::HasSubstr;

std::string objection(const std::string& text) { return complaint_about(text, {}).value_or(""); }

TEST(Condition, IsRefusedWithItsColumnAndWhatIsAllowed) {
  const auto at = [](const std::string& text) {
    const auto fault = fault_in(text);
    return fault ? fault->character : 0;
  };
  EXPECT_EQ(objection("when 'distance < 4'"), "");
  EXPECT_THAT(objection("when 'distance < 4 and sped > 2'"),
              HasSubstr("when: character 18 of its text: nothing is called 'sped'; there are age, "
                        "always, angle, closing, distance"));
  EXPECT_EQ(at("when 'distance < 4 and sped > 2'"), 24u);
  EXPECT_THAT(objection("when 'my.distance < 4'"),
              HasSubstr("there are my.age, my.always, my.heading"));
  EXPECT_THAT(objection("when 'distance'"),
              HasSubstr("a condition is true or false, but this is a number: compare it"));
  EXPECT_THAT(objection("when 'team < 3'"),
              HasSubstr("'<' compares what is a number, but this is a team"));
  EXPECT_THAT(objection("when 'team == owner'"), HasSubstr("but this is an owner"));
  EXPECT_THAT(objection("when 'kind == 2'"), HasSubstr("a kind, but this is a number"));
  EXPECT_THAT(objection("when 'kind == team'"), HasSubstr("a kind, but this is a team"));
  EXPECT_THAT(objection("when 'mine'"), HasSubstr("'mine' has a meaning only beside a comparison"));
  EXPECT_THAT(objection("when 'mine == mine'"), HasSubstr("'mine' needs an attribute"));
  EXPECT_THAT(objection("when 'distance < mine'"), HasSubstr("'mine' needs an attribute"));
  EXPECT_THAT(objection("when '1 < x < 2'"),
              HasSubstr("expected an operator, 'and', 'or' or the end at '<'"));
  EXPECT_THAT(objection("when 'x = 2'"), HasSubstr("expected '==', not '='"));
  EXPECT_THAT(objection("when 'x < '"),
              HasSubstr("expected a number, a name, '-', 'not' or '(' where it ends"));
  EXPECT_THAT(objection("when ''"), HasSubstr("character 1 of its text"));
  EXPECT_THAT(objection("when 'x < 1e999'"), HasSubstr("expected a finite number at '1e999'"));
  EXPECT_THAT(objection("when 'x < 1..2'"), HasSubstr("expected a finite number"));
  EXPECT_THAT(objection("when 'sin(x) < 1'"),
              HasSubstr("no function is called 'sin'; there are abs, max"));
  EXPECT_THAT(objection("when 'max(x) < 1'"), HasSubstr("max takes two numbers"));
  EXPECT_THAT(objection("when '(x < 1'"), HasSubstr("expected ')' where it ends"));
  EXPECT_THAT(objection("when 'not x'"), HasSubstr("'not' turns what is true or false"));
  EXPECT_THAT(objection("when 'x < 1 or 3'"),
              HasSubstr("'or' joins what is true or false, but this is a number"));
  EXPECT_THAT(objection("when 'x # 1'"), HasSubstr("at '#'"));
  EXPECT_THAT(objection("when 'x < " + std::string(40, '(') + "1" + std::string(40, ')') + "'"),
              HasSubstr("more than 32 levels of nesting"));
  std::string many = "when '0";
  for (int i = 0; i < 300; ++i) many += "+1";
  EXPECT_THAT(objection(many + " > 0'"), HasSubstr("more than 256 names"));
  EXPECT_THAT(objection("when '" + std::string(1001, 'x') + "'"),
              HasSubstr("longer than 1000 characters"));
  EXPECT_THAT(objection("when distance < 4"),
              HasSubstr("expected 'and', 'or', 'with' or the end at '<'"));
  EXPECT_THAT(objection("when \"x < 1"),
              HasSubstr("expected the quotation mark that ends what begins"));
  EXPECT_THAT(objection("when"),
              HasSubstr("expected a text in quotation marks, or the name of a plugin"));
  EXPECT_THAT(objection("when fov"),
              HasSubstr("no plugin 'fov' is loaded; none is: name its file with --plugin"));
  EXPECT_THAT(objection("region with top(k=3)"), HasSubstr("top needs a score, as in top(k=5) by"));
  EXPECT_THAT(objection("region with top(k=3) by 'x < 1'"),
              HasSubstr("a score is a number, but this is true or false"));
  EXPECT_THAT(objection("region with nearest(k=3) by 'x'"), HasSubstr("nearest takes no score"));
  EXPECT_EQ(objection("region with nearest"), "nearest needs k=NUMBER");
  EXPECT_THAT(objection("region with nearest(k=0)"),
              HasSubstr("k = 0 is not a whole number from 1"));
  EXPECT_THAT(objection("(region with nearest(k=3)) or team with swept(horizon=1)"),
              HasSubstr("swept cannot follow nearest"));
  for (const char* stage : {"nearest(k=3)", "top(k=3) by 'x'", "psense", "von", "donnybrook"})
    EXPECT_THAT(objection(std::string("region with swept(horizon=1) with ") + stage),
                HasSubstr(" cannot follow swept: of an entity in flight it would take where"));
  EXPECT_EQ(objection("region with hysteresis(margin=1) with nearest(k=3) with dwell(matches=2) "
                      "with tiers(at=0.5) with priority"),
            "");
  EXPECT_FALSE(fault_in("when fov")) << "whether it is loaded is no matter of syntax";
  EXPECT_FALSE(fault_in_momentary("when 'x < 1' with nearest(k=3)"));
  EXPECT_TRUE(fault_in_momentary("region with dwell(matches=3) with nearest(k=3)"));
}

TEST(Condition, MakesANameForFilesWithoutWhatShellsAndFoldersMind) {
  EXPECT_EQ(file_name_of("when \"x<1/2\""), "when_%22x%3c1%2f2%22");
  EXPECT_NE(file_name_of("when 'x<1'"), file_name_of("when 'x>1'"));
}

}  // namespace
}  // namespace conditions
}  // namespace rink::im
