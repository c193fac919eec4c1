// Plugins: what is refused when it is loaded, and that a sound one decides as the scheme of which
// it is the copy, asked from the same expressions.
#include "game/net/plugins.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <random>
#include <string>

#include "im/filter.h"
#include "tests/places.h"

namespace rink::game {
namespace {

using testing::HasSubstr;

std::string file_of(const std::string& name) {
  return (std::filesystem::path(test::binary_folder()) / "test-plugins" / (name + ".so")).string();
}

std::string refusal_of(const std::string& file) {
  try {
    load_plugin(file);
  } catch (const PluginError& error) {
    return error.what();
  }
  return "";
}

/// In one test, since what is loaded stays for the process.
TEST(Plugins, AreRefusedWithTheFileAndTheReason) {
  EXPECT_THAT(refusal_of(file_of("older")),
              HasSubstr("older.so: it is of version 0 of im/pairs/rink_plugin.h, expected 1"));
  EXPECT_THAT(refusal_of(file_of("smaller")),
              HasSubstr("its rink_party has 8 bytes, expected 112"));
  EXPECT_THAT(refusal_of(file_of("nameless")),
              HasSubstr("its name is 'Not A Name', expected small letters"));
  EXPECT_THAT(refusal_of(file_of("kindless")), HasSubstr("its kind is 7, expected RINK_PREDICATE"));
  EXPECT_THAT(refusal_of(file_of("none")), HasSubstr("it has no function evaluate"));
  EXPECT_THAT(refusal_of(file_of("throws")), HasSubstr("it throws: of course"));
  EXPECT_THAT(refusal_of(file_of("crashes")), HasSubstr("it crashes: Segmentation fault"));
  EXPECT_THAT(refusal_of(file_of("ends")), HasSubstr("it ends the process that asks it"));
  EXPECT_THAT(refusal_of(file_of("rubbish")), HasSubstr("nan, expected a finite number"));
  EXPECT_THAT(refusal_of(file_of("unfit")), HasSubstr("2.000000, expected 0 or 1"));
  EXPECT_THAT(refusal_of(file_of("beyond")), HasSubstr("it writes beyond the last pair"));
  EXPECT_THAT(refusal_of(file_of("impure")), HasSubstr("its answer differs when asked again"));
  EXPECT_THAT(refusal_of("/nowhere.so"), HasSubstr("/nowhere.so: there is no such file"));
  EXPECT_THAT(refusal_of(test::source_folder() + "/README.md"), HasSubstr("README.md"));
  EXPECT_TRUE(loaded_plugins().empty()) << "none of these is loaded";

  EXPECT_EQ(refusal_of(file_of("near_by_steps")), "");
  EXPECT_EQ(refusal_of(file_of("score")), "");
  EXPECT_THAT(refusal_of(file_of("score")), HasSubstr("'rightmost' is loaded already"));
  ASSERT_EQ(loaded_plugins().size(), 2u);
  ASSERT_EQ(plugin_files().size(), 2u);
  const im::FilterSettings settings{.world = {0.0, 0.0, 10.0, 10.0}, .plugins = loaded_plugins()};
  EXPECT_EQ(im::complaint_about("when near_by_steps with top(k=2) by rightmost", settings),
            std::nullopt);
  EXPECT_THAT(im::complaint_about("when rightmost", settings).value_or(""),
              HasSubstr("the plugin 'rightmost' is a score, which belongs after by"));
  EXPECT_THAT(im::complaint_about("region with top(k=2) by near_by_steps", settings).value_or(""),
              HasSubstr("is a predicate, which belongs after when"));
  EXPECT_THAT(im::complaint_about("when far_by_steps", settings).value_or(""),
              HasSubstr("no plugin 'far_by_steps' is loaded; there are near_by_steps, rightmost"));
  EXPECT_FALSE(im::make_filter("when near_by_steps", {}));

  // The template is a copy of `diamond`, and `rightmost` of a score in words.
  for (const auto& [plugin, own] :
       {std::pair("when near_by_steps", "diamond"),
        std::pair("not when near_by_steps or team", "not diamond or team"),
        std::pair("when near_by_steps with hysteresis(margin=0.5)",
                  "diamond with hysteresis(margin=0.5)"),
        std::pair("region with top(k=3) by rightmost", "region with top(k=3) by 'x'")}) {
    SCOPED_TRACE(plugin);
    const auto one = im::make_filter(plugin, settings), other = im::make_filter(own, settings);
    ASSERT_TRUE(one && other);
    std::mt19937_64 random(1);
    const auto between = [&random](double low, double high) {
      return std::uniform_real_distribution<double>(low, high)(random);
    };
    std::size_t changes = 0;
    for (int match = 0; match < 60; ++match) {
      for (std::uint32_t id = 0; id < 40; ++id) {
        if (between(0.0, 1.0) < 0.5) continue;
        const double x = between(0.0, 10.0), y = between(0.0, 10.0);
        for (im::Filter* filter : {one.get(), other.get()}) {
          filter->set_update_region(id, {x, y, x + 0.5, y + 0.25});
          if (id < 8) filter->set_subscription_region(id, {y, x, y + 4.0, x + 3.0});
        }
      }
      const auto found = one->match(), expected = other->match();
      ASSERT_TRUE(std::ranges::equal(found, expected)) << "match " << match;
      changes += found.size();
    }
    EXPECT_GT(changes, 500u);
  }
}

/// A trial that waits as long as it is allowed to.
TEST(PluginsLong, ThatHangAreRefusedAfterTenSeconds) {
  EXPECT_THAT(refusal_of(file_of("hangs")), HasSubstr("it did not answer within 10 s"));
}

}  // namespace
}  // namespace rink::game
