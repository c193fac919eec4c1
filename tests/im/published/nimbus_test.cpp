// The scheme `nimbus` by the closed forms of two discs; tests/im/recount.h has its definition, by
// which the suites of all schemes judge it.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "tests/im/cases.h"
#include "tests/im/layouts.h"

namespace rink::im {
namespace {

/// A focus of radius 4 around (0, 0), and whether a point so far to the right matters.
class Focus {
 public:
  explicit Focus(const std::string& scheme, double radius = 4.0)
      : filter_(make_filter(scheme, hundred)) {
    filter_->set_subscription_region(0, around(0.0, 0.0, radius));
  }
  bool is_aware_of(const Region& region) {
    filter_->set_update_region(0, region);
    for (const Change& change : filter_->match()) is_in_ = change.transition == Transition::entered;
    return is_in_;
  }
  bool is_aware_at(double x) { return is_aware_of(point(x, 0.0)); }

 private:
  std::unique_ptr<Filter> filter_;
  bool is_in_ = false;
};

void expect_rim(Focus focus, double reach, double error) {
  EXPECT_TRUE(focus.is_aware_at(reach - error)) << reach;
  EXPECT_FALSE(focus.is_aware_at(reach + error)) << reach;
  EXPECT_TRUE(focus.is_aware_at(error - reach)) << "and back again: " << reach;
}

TEST(Nimbus, NeedsBothDiscsToTheLastBit) {
  const double ulp = 0x1p-50;
  for (const auto& [radius, reach] : {std::pair(2.5, 2.5), std::pair(8.0, 4.0)}) {
    Focus focus("nimbus(radius=" + std::to_string(radius) + ")");
    EXPECT_TRUE(focus.is_aware_at(reach)) << "rims belong to their discs";
    EXPECT_FALSE(focus.is_aware_at(reach + ulp));
    EXPECT_TRUE(focus.is_aware_of(point(0.6 * 2.5, 0.8 * 2.0)));
    EXPECT_FALSE(focus.is_aware_of(point(3.5, 3.5))) << "within the square alone";
  }
}

/// Of (1 - d/4)(1 - d/n) = a.
TEST(Nimbus, EndsWhereTheProductFallsToTheAwareness) {
  const auto scheme = [](double radius, double awareness) {
    return "nimbus(radius=" + std::to_string(radius) + " awareness=" + std::to_string(awareness) +
           ")";
  };
  for (const double radius : {0.5, 2.0, 4.0, 9.0, 1000.0})
    for (const double awareness : {0.0625, 0.25, 0.5, 0.75, 0.9375}) {
      const double sum = 4.0 + radius;
      expect_rim(Focus(scheme(radius, awareness)),
                 (sum - std::sqrt(sum * sum - 16.0 * radius * (1.0 - awareness))) / 2.0,
                 1e-12 * sum);
    }
  for (const double awareness : {0.0625, 0.25, 0.5625})
    expect_rim(Focus("nimbus(awareness=" + std::to_string(awareness) + ")"),
               4.0 * (1.0 - std::sqrt(awareness)), 1e-14);
  Focus all("nimbus(awareness=1)");
  EXPECT_TRUE(all.is_aware_at(0.0));
  EXPECT_FALSE(all.is_aware_at(1e-9));
}

TEST(Nimbus, BelongsToTheOneWhoIsSeen) {
  // Two with nimbi of 3 m, 5 m apart: neither notices, however wide the focus; 2 m apart only the
  // one that looks so far.
  Focus wide("nimbus(radius=3)", 10.0), narrow("nimbus(radius=3)", 1.0);
  EXPECT_FALSE(wide.is_aware_at(5.0));
  EXPECT_TRUE(wide.is_aware_at(2.0));
  EXPECT_FALSE(narrow.is_aware_at(2.0));
}

TEST(Nimbus, ComposesWithAnyOtherFocus) {
  Focus both("aura and nimbus(radius=1)");
  EXPECT_TRUE(both.is_aware_of(around(1.0, 0.0, 0.5)));
  EXPECT_FALSE(both.is_aware_of(around(1.25, 0.0, 0.5))) << "its rim is in, its middle is not";
}

TEST(Nimbus, IsRefusedWithTheFaultNamed) {
  const auto objection = [](const std::string& text) {
    return complaint_about(text, {}).value_or("");
  };
  EXPECT_EQ(objection("nimbus"), "");
  EXPECT_EQ(objection("nimbus(radius=0)"),
            "nimbus: radius = 0 is not a number from 0.001 to 1000000000");
  EXPECT_EQ(objection("nimbus(awareness=1.5)"),
            "nimbus: awareness = 1.5 is not a number from 0 to 1");
  EXPECT_EQ(objection("nimbus(level=1)"),
            "nimbus has no parameter level; it has awareness, radius");
  EXPECT_EQ(complaint_about("nimbus", {.nimbus_radius = -1.0}).value_or(""),
            "the radius of nimbi is not a finite number from 0");
  EXPECT_EQ(complaint_about("nimbus", {.awareness = std::nan("")}).value_or(""),
            "the awareness at which an entity matters is not a number from 0 to 1");
}

}  // namespace
}  // namespace rink::im
