// The samples of docs/im.md are the code that is compiled.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "im/filter.h"
#include "tests/places.h"

namespace rink::im {
namespace {

std::string text_of(const std::string& path) {
  std::ifstream stream(std::filesystem::path(test::source_folder()) / path);
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

/// The C++ blocks of a document after `heading`.
std::vector<std::string> samples_after(const std::string& heading, const std::string& document) {
  std::vector<std::string> samples;
  const std::string opens = "```cpp\n", closes = "```\n";
  for (std::size_t at = document.find(opens, document.find(heading)); at != std::string::npos;
       at = document.find(opens, at)) {
    at += opens.size();
    samples.push_back(document.substr(at, document.find(closes, at) - at));
  }
  return samples;
}

TEST(Documentation, ShowsTheSampleAsItIsCompiled) {
  const std::vector<std::string> samples = samples_after("## A new scheme", text_of("docs/im.md"));
  ASSERT_EQ(samples.size(), 1u);
  EXPECT_NE(text_of("im/filter.cpp").find(samples[0]), std::string::npos) << samples[0];
}

TEST(Documentation, BeginsWithASampleThatDoesWhatItSays) {
  const Subscriber subscriber = 0;
  const Entity entity = 1;
  std::vector<Change> entered;
  const auto filter = rink::im::make_filter("aura and sight with hysteresis(margin=0.3)",
                                            {.world = {0, 0, 20, 10}});
  filter->set_subscription_region(subscriber, {4, 4, 8, 8});
  filter->set_update_region(entity, {7, 6, 8, 7});
  for (const auto& change : filter->match())
    entered.push_back(change);  // one: entity to subscriber
  EXPECT_EQ(entered, (std::vector{Change{subscriber, entity, Transition::entered}}));
  std::istringstream lines(samples_after("# Interest management", text_of("docs/im.md"))[0]);
  const std::string own = text_of("tests/im/documented_test.cpp");
  for (std::string line; std::getline(lines, line);)
    EXPECT_NE(own.find("  " + line + "\n"), std::string::npos) << line;
}

TEST(Documentation, NamesEverySchemeAndStage) {
  const std::string document = text_of("docs/im.md");
  for (const auto& names : {filter_names(), stage_names()})
    for (const std::string& name : names)
      EXPECT_NE(document.find("`" + name + "`"), std::string::npos) << name;
}

}  // namespace
}  // namespace rink::im
