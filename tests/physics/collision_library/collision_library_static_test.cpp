// The static tests on the verge of touching, against 113-bit arithmetic, and what slips between
// edges that share a corner.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>

#include "game/physics/collision/dynamic_tests.h"
#include "game/physics/collision/static_tests.h"
#include "tests/physics/collision_library/collision_library_cases.h"
#include "tests/physics/collision_library/collision_library_reference.h"

namespace rink::physics::collision {
namespace {

using namespace reference;
using Point = Vector<double>;

/// The widest gap or overlap at which an answer was wrong, in epsilons of the lengths involved,
/// over `count` pairs within 1e-10 to 1e-17 of touching.
template <class Ask>
double widest_misjudged(Difficulty difficulty, int count, const Ask& ask) {
  Seeded seeded{9};
  double widest = 0.0;
  for (int i = 0; i < count; ++i) {
    Target target{
        scale_of(difficulty) * Point(seeded.magnitude(0.01, 1.0), seeded.magnitude(0.01, 1.0)),
        scale_of(difficulty) * seeded.magnitude(0.01, 1.0)};
    const auto [overlaps, obstacle, offset] = ask(seeded, target, [&](const Target& shape) {
      const Point out = seeded.direction(),
                  base = difficulty == Difficulty::far ? Point(1e6, -1e6) : Point(0.0, 0.0);
      Encounter e;
      e.position_b = base + shape.size() * seeded.direction();
      e.position_a = e.position_b + shape.rim(out) +
                     seeded.sign() * seeded.magnitude(1e-17, 1e-10) * shape.size() * out;
      return e;
    });
    const Quad gap = obstacle.gap(offset);
    if (overlaps == (gap <= 0)) continue;
    const Quad length = root(dot(offset, offset)) +
                        root(dot(obstacle.half_extent, obstacle.half_extent)) + obstacle.radius;
    widest = std::max(widest, static_cast<double>(magnitude(gap) / (Quad(0x1p-52) * length)));
  }
  return widest;
}

struct Asked {
  bool overlaps;
  Obstacle obstacle;
  QuadPoint offset;
};

QuadPoint offset_of(const Encounter& e) { return exact(e.position_a) - exact(e.position_b); }

double point_in_circle(Difficulty difficulty, int count) {
  return widest_misjudged(difficulty, count, [](Seeded&, const Target& t, const auto& place) {
    const Encounter e = place({{0.0, 0.0}, t.radius});
    return Asked{is_point_in_circle(e.position_a, Disc<double>{e.position_b, t.radius}),
                 {{0, 0}, t.radius},
                 offset_of(e)};
  });
}

double bounding_circles(Difficulty difficulty, int count) {
  return widest_misjudged(difficulty, count, [](Seeded&, const Target& t, const auto& place) {
    const double other = t.half_extent.x();
    const Encounter e = place({{0.0, 0.0}, t.radius + other});
    return Asked{do_bounding_circles_overlap(Disc<double>{e.position_a, other},
                                             Disc<double>{e.position_b, t.radius}),
                 {{0, 0}, Quad(t.radius) + Quad(other)},
                 offset_of(e)};
  });
}

double disc_and_box(Difficulty difficulty, int count) {
  return widest_misjudged(difficulty, count, [](Seeded&, const Target& t, const auto& place) {
    const Encounter e = place(t);
    return Asked{does_disc_overlap_box(Disc<double>{e.position_a, t.radius},
                                       Box<double>{e.position_b, t.half_extent}),
                 {exact(t.half_extent), t.radius},
                 offset_of(e)};
  });
}

double boxes(Difficulty difficulty, int count) {
  return widest_misjudged(
      difficulty, count, [](Seeded& seeded, const Target& t, const auto& place) {
        const Point other = t.radius * Point(seeded.uniform(0.5, 2.0), seeded.uniform(0.5, 2.0));
        const Encounter e = place({t.half_extent + other, 0.0});
        return Asked{do_boxes_overlap(Box<double>{e.position_a, other},
                                      Box<double>{e.position_b, t.half_extent}),
                     {exact(t.half_extent) + exact(other), 0},
                     offset_of(e)};
      });
}

/// The greatest error of a distance, in epsilons of the way from the plane's point.
double plane_distance(Difficulty difficulty, int count) {
  Seeded seeded{9};
  double worst = 0.0;
  for (int i = 0; i < count; ++i) {
    const Encounter e = encounter(seeded, difficulty, {{0.0, 0.0}, scale_of(difficulty)});
    const Plane<double> plane{e.position_b, seeded.direction()};
    const QuadPoint way = offset_of(e);
    const Quad truth = dot(exact(plane.normal), way),
               error = magnitude(point_plane_distance(e.position_a, plane) - truth);
    worst = std::max(worst, static_cast<double>(error / (Quad(0x1p-52) * root(dot(way, way)))));
  }
  return worst;
}

struct StaticTest {
  const char* name;
  double (*worst)(Difficulty, int);
};
constexpr StaticTest static_tests[] = {{"point, plane", plane_distance},
                                       {"point, circle", point_in_circle},
                                       {"bounding circles", bounding_circles},
                                       {"disc, box", disc_and_box},
                                       {"box, box", boxes}};

void judge(int count, bool is_table) {
  if (is_table)
    std::printf("| static test | random | tiny | huge | far |\n|---|---|---|---|---|\n");
  for (const StaticTest& subject : static_tests) {
    if (is_table) std::printf("| %s |", subject.name);
    for (const Difficulty difficulty :
         {Difficulty::random, Difficulty::tiny, Difficulty::huge, Difficulty::far}) {
      const double worst = subject.worst(difficulty, count);
      EXPECT_LE(worst, 2.0) << subject.name << ", "
                            << difficulty_names[static_cast<int>(difficulty)];
      if (is_table) std::printf(" %.2g |", worst);
    }
    if (is_table) std::printf("\n");
  }
}

TEST(StaticTests, ErrByNoMoreThanTheRoundingOfTheirInputs) { judge(2000, false); }

TEST(StaticTestsLong, ErrByNoMoreThanTheRoundingOfTheirInputs) { judge(20000, true); }

TEST(EdgesThatShareACorner, LetNothingSlipBetweenThem) {
  Seeded seeded{21};
  int slips = 0;
  for (int i = 0; i < 100000; ++i) {
    const Point corner = seeded.direction(), left(-corner.y(), corner.x()),
                before =
                    corner - seeded.uniform(0.2, 2.0) * left - seeded.uniform(0.0, 1.0) * corner,
                after =
                    corner + seeded.uniform(0.2, 2.0) * left - seeded.uniform(0.0, 1.0) * corner;
    // Flights that face both edges and pass within rounding of the corner.
    const Point point = corner + seeded.uniform(1.0, 3.0) * corner,
                velocity = (corner - point) * seeded.uniform(0.1, 10.0);
    const bool hits = time_point_meets_edge(point, velocity, Edge<double>{before, corner}) ||
                      time_point_meets_edge(point, velocity, Edge<double>{corner, after});
    slips += hits ? 0 : 1;
  }
  EXPECT_EQ(slips, 0);
}

}  // namespace
}  // namespace rink::physics::collision
