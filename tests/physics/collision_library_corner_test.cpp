// What sharp corners get wrong: the paper's offset edges against rounded corners, over random flights of a puck at a bat.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

#include "game/physics/collision/dynamic_tests.h"
#include "tests/physics/collision_library_cases.h"

namespace rink::physics::collision {
namespace {

using reference::Seeded;
using Point = Vector<double>;

constexpr double pi = 3.141592653589793, radius = 0.04;
const Box<double> match_bat{{0.0, 0.0}, {0.03, 0.1}};  // the bat of scenes/match.toml

/// Flights at 1 m/s from everywhere and past every place alike (isotropic lines). By Cauchy and Crofton such lines hit a convex set as often as its perimeter is long, and
/// enter it evenly along the perimeter, so the shares have closed forms.
struct Flights {
  int sharp_hits = 0, false_hits = 0, missed_hits = 0, corner_hits = 0;
  std::vector<double> early;  // at true corner hits: flight [radii] between the sharp answer and the true one
  std::vector<double> turned;  // and the angle between the two normals [degrees]

  explicit Flights(int count) {
    Seeded seeded{5};
    for (int i = 0; i < count; ++i) {
      const Point heading = seeded.direction(), left(-heading.y(), heading.x());
      const Disc<double> puck{0.2 * seeded.uniform(-1.0, 1.0) * left - heading, radius};
      const Point still(0.0, 0.0);
      add(time_disc_meets_sharp_box(puck, heading, match_bat, still), time_disc_meets_rounded_box(puck, heading, match_bat, still));
    }
    std::ranges::sort(early);
    std::ranges::sort(turned);
  }

  void add(const MaybeContact<double>& sharp, const MaybeContact<double>& truth) {
    if (sharp) ++sharp_hits;
    if (sharp && !truth) ++false_hits;
    if (!sharp && truth) ++missed_hits;
    if (!sharp || !truth || truth->normal.x() == 0.0 || truth->normal.y() == 0.0) return;
    ++corner_hits;
    early.push_back((truth->time - sharp->time) / radius);
    turned.push_back(std::acos(std::clamp(sharp->normal.dot(truth->normal), -1.0, 1.0)) * 180.0 / pi);
  }
};

double quantile(const std::vector<double>& sorted, double part) { return sorted[static_cast<std::size_t>(part * static_cast<double>(sorted.size() - 1))]; }

double perimeter_of_box() { return 4.0 * match_bat.half_extent.sum(); }

/// Shares of all hits of the sharp box.
double expected_false() { return (8.0 - 2.0 * pi) * radius / (perimeter_of_box() + 8.0 * radius); }
double expected_corner() { return 2.0 * pi * radius / (perimeter_of_box() + 8.0 * radius); }

double share(int part, const Flights& flights) { return static_cast<double>(part) / flights.sharp_hits; }

TEST(SharpCorners, HitFalselyInTheShareOfThePerimetersDifference) {
  const Flights flights(200000);
  const double noise = 4.0 / std::sqrt(static_cast<double>(flights.sharp_hits));
  EXPECT_NEAR(share(flights.false_hits, flights), expected_false(), noise * std::sqrt(expected_false()));
  EXPECT_NEAR(share(flights.corner_hits, flights), expected_corner(), noise * std::sqrt(expected_corner()));
  EXPECT_EQ(flights.missed_hits, 0) << "the sharp box holds the rounded one";
}

TEST(SharpCorners, AreEarlyByUpToARadiusWithUpToARightAngleOfError) {
  const Flights flights(200000);
  EXPECT_GE(flights.early.front(), -1e-13);
  EXPECT_LE(flights.early.back(), 1.0 + 1e-13);
  EXPECT_LE(flights.turned.back(), 90.0);
  EXPECT_GT(flights.early.back(), 0.9);
  EXPECT_GT(flights.turned.back(), 85.0);
}

TEST(SharpCornersLong, ErrByTheDistributionInTheDocs) {
  const Flights flights(10000000);
  std::printf("flights that hit the sharp box: %d\n", flights.sharp_hits);
  std::printf("false hits: %.4f of them (closed form %.4f), missed: %d\n", share(flights.false_hits, flights), expected_false(), flights.missed_hits);
  std::printf("true hits on a corner: %.4f of them (closed form %.4f); of these\n", share(flights.corner_hits, flights), expected_corner());
  std::printf("| quantile | 0.05 | 0.25 | 0.5 | 0.75 | 0.95 | 0.99 | 1 |\n|---|---|---|---|---|---|---|---|\n");
  const auto print = [](const char* name, const std::vector<double>& sorted) {
    std::printf("| %s |", name);
    for (const double part : {0.05, 0.25, 0.5, 0.75, 0.95, 0.99, 1.0}) std::printf(" %.3g |", quantile(sorted, part));
    std::printf("\n");
  };
  print("early by [radii]", flights.early);
  print("normal off by [degrees]", flights.turned);
}

}  // namespace
}  // namespace rink::physics::collision
