// What sharp corners get wrong: the paper's offset edges against rounded corners, over random
// flights of a puck at a bat.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "game/physics/collision/dynamic_tests.h"
#include "tests/physics/collision_library/collision_library_cases.h"
#include "tests/places.h"

namespace rink::physics::collision {
namespace {

using reference::Seeded;
using Point = Vector<double>;

constexpr double pi = 3.141592653589793, radius = 0.04;
const Box<double> match_bat{{0.0, 0.0}, {0.03, 0.1}};  // the bat of scenes/match.toml

/// Flights at 1 m/s from everywhere and past every place alike (isotropic lines). By Cauchy and
/// Crofton such lines hit a convex set as often as its perimeter is long, and enter it evenly along
/// the perimeter, so the shares have closed forms.
struct Flights {
  int sharp_hits = 0, false_hits = 0, missed_hits = 0, corner_hits = 0;
  std::vector<double>
      early;  // at true corner hits: flight [radii] between the sharp answer and the true one
  std::vector<double> turned;  // and the angle between the two normals [degrees]

  explicit Flights(int count) {
    Seeded seeded{5};
    for (int i = 0; i < count; ++i) {
      const Point heading = seeded.direction(), left(-heading.y(), heading.x());
      const Disc<double> puck{0.2 * seeded.uniform(-1.0, 1.0) * left - heading, radius};
      const Point still(0.0, 0.0);
      add(time_disc_meets_sharp_box(puck, heading, match_bat, still),
          time_disc_meets_rounded_box(puck, heading, match_bat, still));
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
    turned.push_back(std::acos(std::clamp(sharp->normal.dot(truth->normal), -1.0, 1.0)) * 180.0 /
                     pi);
  }
};

double quantile(const std::vector<double>& sorted, double part) {
  return sorted[static_cast<std::size_t>(part * static_cast<double>(sorted.size() - 1))];
}

double perimeter_of_box() { return 4.0 * match_bat.half_extent.sum(); }

/// Shares of all hits of the sharp box.
double expected_false() { return (8.0 - 2.0 * pi) * radius / (perimeter_of_box() + 8.0 * radius); }
double expected_corner() { return 2.0 * pi * radius / (perimeter_of_box() + 8.0 * radius); }

double share(int part, const Flights& flights) {
  return static_cast<double>(part) / flights.sharp_hits;
}

/// Within four standard deviations of the closed forms.
void expect_shares(const Flights& flights) {
  const double noise = 4.0 / std::sqrt(static_cast<double>(flights.sharp_hits));
  EXPECT_NEAR(share(flights.false_hits, flights), expected_false(),
              noise * std::sqrt(expected_false()));
  EXPECT_NEAR(share(flights.corner_hits, flights), expected_corner(),
              noise * std::sqrt(expected_corner()));
  EXPECT_EQ(flights.missed_hits, 0) << "the sharp box holds the rounded one";
}

TEST(SharpCorners, HitFalselyInTheShareOfThePerimetersDifference) {
  expect_shares(Flights(200000));
}

TEST(SharpCorners, AreEarlyByUpToARadiusWithUpToARightAngleOfError) {
  const Flights flights(200000);
  EXPECT_GE(flights.early.front(), -1e-13);
  EXPECT_LE(flights.early.back(), 1.0 + 1e-13);
  EXPECT_LE(flights.turned.back(), 90.0);
  EXPECT_GT(flights.early.back(), 0.9);
  EXPECT_GT(flights.turned.back(), 85.0);
}

/// The numbers of the row of the documents' table that begins with `name`.
std::vector<double> documented(const std::string& name) {
  std::ifstream document(rink::test::source_folder() + "/docs/collision.md");
  std::vector<double> numbers;
  for (std::string line; std::getline(document, line);) {
    if (!line.starts_with("|" + name + "|")) continue;
    std::istringstream cells(line.substr(name.size() + 2));
    for (std::string cell; std::getline(cells, cell, '|');) numbers.push_back(std::stod(cell));
  }
  return numbers;
}

/// The documents give two digits; three are printed, for who writes them.
void expect_documented(const std::vector<double>& sorted, const std::string& name) {
  const std::vector<double> parts = documented("quantile"), expected = documented(name);
  ASSERT_FALSE(parts.empty());
  ASSERT_EQ(expected.size(), parts.size());
  std::printf("|%s|", name.c_str());
  for (const double part : parts) std::printf("%.3g|", quantile(sorted, part));
  std::printf("\n");
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const double last_digit = std::pow(10.0, std::floor(std::log10(expected[i])) - 1.0);
    EXPECT_NEAR(quantile(sorted, parts[i]), expected[i], 0.6 * last_digit)
        << name << ", quantile " << parts[i];
  }
}

TEST(SharpCornersLong, ErrByTheDistributionInTheDocs) {
  const Flights flights(10000000);
  std::printf("%d hits of the sharp box, %.4f of them false, %.4f true hits on a corner\n",
              flights.sharp_hits, share(flights.false_hits, flights),
              share(flights.corner_hits, flights));
  expect_shares(flights);
  expect_documented(flights.early, "early by, radii of flight");
  expect_documented(flights.turned, "normal off by, degrees");
}

}  // namespace
}  // namespace rink::physics::collision
