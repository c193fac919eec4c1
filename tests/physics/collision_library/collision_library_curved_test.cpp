// The times of impact under thrust and drag against the exact paths in 113-bit arithmetic, searched
// by fine steps.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <string>

#include "game/physics/collision/accelerated_tests.h"
#include "game/physics/collision/dynamic_tests.h"
#include "tests/physics/collision_library/collision_library_cases.h"
#include "tests/physics/collision_library/collision_library_reference.h"

namespace rink::physics::collision {
namespace {

using namespace reference;
using Point = Vector<double>;
using Curved = CurvedFlight<Motion>;

/// A body of a rink: thrust along the axes, drag on most.
Motion driven(Seeded& seeded, const Point& position, double scale) {
  Motion m;
  m.time = seeded.uniform(0.0, 0.1);
  m.position = position;
  m.velocity = Point(seeded.uniform(-3.0, 3.0), seeded.uniform(-3.0, 3.0)) * scale;
  m.acceleration = Point(seeded.uniform(-6.0, 6.0), seeded.uniform(-6.0, 6.0)) * scale;
  m.drag = Point::Constant(seeded.next() % 4 == 0 ? 0.0 : seeded.magnitude(1e-3, 5.0));
  return m;
}

/// How far apart in time two looks at a flight may lie without missing more than a graze.
constexpr int look_count = 500;
constexpr double start = 0.1, until = 1.6;

struct Errors {
  double gap = 0.0;  // at the time answered, in epsilons of the lengths involved
  int hits = 0, misses = 0;
};

/// Judges an answer: what touches at its time touches to rounding, and no look before it sees a
/// contact.
template <class Touches>
void judge(Errors& errors, const MaybeContact<double>& answer, Quad gap, double length,
           const Touches& touches) {
  const double end = answer ? answer->time : until;
  for (int i = 0; i <= look_count; ++i) {
    const double time =
        start + (end - start) * (static_cast<double>(i) / look_count) * (1.0 - 1e-12);
    if (touches(time)) return void(ADD_FAILURE() << "touches before " << time << " already");
  }
  if (!answer) return void(++errors.misses);
  ++errors.hits;
  errors.gap = std::max(errors.gap, static_cast<double>(magnitude(gap)) / (0x1p-52 * length));
}

/// The lengths whose rounding a path has to bear.
double length_of(const Motion& m, double time) {
  const double t = time - m.time;
  return m.velocity.norm() * t + 0.5 * m.acceleration.norm() * t * t;
}

struct Pair {
  Motion a, b;
  double scale;

  Pair(Seeded& seeded, Difficulty difficulty, double distance) : scale(scale_of(difficulty)) {
    const Point base = difficulty == Difficulty::far ? Point(1e6, -1e6) : Point(0.0, 0.0);
    b = driven(seeded, base, scale);
    const Point away = seeded.direction();
    a = driven(seeded, base + distance * seeded.uniform(1.0, 3.0) * away, scale);
    a.velocity =
        b.velocity + 0.5 * (a.velocity - b.velocity) - scale * seeded.uniform(0.0, 3.0) * away;
  }
  double length(double time, double reach) const {
    return (a.position - b.position).norm() + reach + length_of(a, time) + length_of(b, time);
  }
};

enum class Shapes { discs, disc_and_box, boxes };

void judge_shapes(Errors& errors, Seeded& seeded, Difficulty difficulty, Shapes shapes) {
  const double scale = scale_of(difficulty), ra = scale * seeded.uniform(0.03, 0.1),
               rb = scale * seeded.uniform(0.03, 0.1);
  const Point ea(ra, 2.0 * ra), eb(rb, 1.5 * rb);
  const double reach = shapes == Shapes::boxes   ? (ea + eb).norm()
                       : shapes == Shapes::discs ? ra + rb
                                                 : eb.norm() + ra;
  const Pair pair(seeded, difficulty, 1.01 * reach);
  const Obstacle obstacle = shapes == Shapes::discs          ? Obstacle{{0, 0}, Quad(ra) + Quad(rb)}
                            : shapes == Shapes::disc_and_box ? Obstacle{exact(eb), ra}
                                                             : Obstacle{exact(ea) + exact(eb), 0};
  const Curved flight{pair.a, pair.b};
  if (obstacle.rest_contacts(flight.at(start))) return;
  const auto answer = shapes == Shapes::discs
                          ? time_disc_meets_disc(pair.a, ra, pair.b, rb, {start, until})
                      : shapes == Shapes::disc_and_box
                          ? time_disc_meets_rounded_box(pair.a, ra, pair.b, eb, {start, until})
                          : time_box_meets_box(pair.a, ea, pair.b, eb, {start, until});
  const double time = answer ? answer->time : until;
  judge(errors, answer, obstacle.gap(flight.at(time)), pair.length(time, reach),
        [&](double t) { return obstacle.rest_contacts(flight.near(t)); });
}

void judge_driven_edge(Errors& errors, Seeded& seeded, Difficulty difficulty) {
  Point half = scale_of(difficulty) * Point(seeded.uniform(-0.2, 0.2), seeded.uniform(0.02, 0.2));
  const Pair pair(seeded, difficulty, 1.01 * half.norm());
  const Curved flight{pair.a, pair.b};
  if (seeded.next() % 4 != 0 && cross<double>(pair.a.position - pair.b.position, half) > 0.0)
    half = -half;  // mostly from outside
  const QuadPoint from = exact(half), along = -2 * from, out{along.y, -along.x};
  const Quad length = root(dot(along, along));
  const auto depth = [&](Quad time) { return dot(out, flight.at(time) - from) / length; };
  const auto answer =
      time_point_meets_moving_edge(pair.a, pair.b, Edge<double>{half, -half}, {start, until});
  const double time = answer ? answer->time : until;
  // Between two looks on either side of the line, the place where it was crossed.
  QuadPoint before = flight.at(start);
  const auto crosses = [&](double t) {
    const QuadPoint now = flight.near(t), last = before;
    const Quad was = dot(out, last - from), is = dot(out, now - from);
    before = now;
    if (!(was > 0 && is <= 0)) return false;
    const Quad part = dot(along, now + (is / (was - is)) * (now - last) - from) / dot(along, along);
    return part > 0.001 && part < 0.999;
  };
  judge(errors, answer, depth(time), pair.length(time, 2.0 * half.norm()), crosses);
}

template <class Judge>
void judge_many(const char* name, int count, bool is_table, const Judge& judge_one) {
  for (const Difficulty difficulty :
       {Difficulty::random, Difficulty::tiny, Difficulty::huge, Difficulty::far}) {
    Errors errors;
    Seeded seeded{7};
    for (int i = 0; i < count; ++i) {
      SCOPED_TRACE(testing::Message()
                   << name << ", " << difficulty_names[static_cast<int>(difficulty)] << ", seed "
                   << seeded.state());
      judge_one(errors, seeded, difficulty);
    }
    EXPECT_GT(errors.hits, count / 20);
    EXPECT_GT(errors.misses, count / 20);
    EXPECT_LE(errors.gap, 8.0) << name;
    if (is_table)
      std::printf("| %s, %s | %d | %d | %.2g |\n", name,
                  difficulty_names[static_cast<int>(difficulty)], errors.hits, errors.misses,
                  errors.gap);
  }
}

void judge_everything(int count, bool is_table) {
  judge_many("disc, disc", count, is_table,
             [](Errors& e, Seeded& s, Difficulty d) { judge_shapes(e, s, d, Shapes::discs); });
  judge_many("disc, rounded box", count, is_table, [](Errors& e, Seeded& s, Difficulty d) {
    judge_shapes(e, s, d, Shapes::disc_and_box);
  });
  judge_many("box, box", count, is_table,
             [](Errors& e, Seeded& s, Difficulty d) { judge_shapes(e, s, d, Shapes::boxes); });
  judge_many("point, edge", count, is_table, judge_driven_edge);
}

TEST(DrivenTimesOfImpact, AreWithinRoundingOfTheExactPaths) { judge_everything(200, false); }

TEST(DrivenTimesOfImpactLong, AreWithinRoundingOfTheExactPaths) {
  std::printf("| shapes | hits | misses | greatest gap |\n|---|---|---|---|\n");
  judge_everything(4000, true);
}

}  // namespace
}  // namespace rink::physics::collision
