// The times of impact in straight flight against 113-bit bisection. The long test prints the tables
// of docs/collision.md.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <functional>
#include <string>
#include <vector>

#include "game/physics/collision/dynamic_tests.h"
#include "tests/physics/collision_library/collision_library_cases.h"
#include "tests/physics/collision_library/collision_library_reference.h"

namespace rink::physics::collision {
namespace {

using namespace reference;
using Point = Vector<double>;

/// What a test answered, and what is true.
struct Judged {
  MaybeContact<double> answer;
  std::optional<Quad> truth;
  QuadPoint normal{1, 0};    // true, if there is a contact
  QuadPoint velocity{0, 0};  // of the first shape seen from the second [m/s]
  Quad gap = 0;              // how far from touching the shapes are at the time answered [m]
  double length =
      0.0;  // of flight and shapes [m]: rounding is measured in units of epsilon times this
  double bend = 0.0;         // radius of the surface that is touched [m]; 0 for a face
  bool is_marginal = false;  // whether 5 epsilon of `length` more or less would make a hit a miss
                             // or a miss a hit, or change the face
};

/// Errors over many encounters. Gaps at the time answered are in epsilons of `length`; so are
/// errors of the normal, as the way along the curved surface that they stand for, times the sine of
/// the angle at which the surface is met.
struct Tally {
  std::vector<double> relative;
  double gap = 0.0, normal = 0.0;
  int misses = 0, misjudged = 0;

  void add(const Judged& judged) {
    if (judged.answer.has_value() != judged.truth.has_value()) {
      ++misjudged;
      EXPECT_TRUE(judged.is_marginal) << (judged.answer ? "false hit" : "missed hit");
      return;
    }
    if (!judged.truth) return void(++misses);
    const Quad error = magnitude(judged.answer->time - *judged.truth),
               unit = Quad(0x1p-52) * judged.length,
               closing = magnitude(dot(judged.normal, judged.velocity));
    relative.push_back(static_cast<double>(error / *judged.truth));
    gap = std::max(gap, static_cast<double>(magnitude(judged.gap) / unit));
    const QuadPoint turned = exact(judged.answer->normal) - judged.normal;
    const Quad angle = root(dot(turned, turned)),
               speed = root(dot(judged.velocity, judged.velocity));
    if (judged.bend > 0.0)
      normal =
          std::max(normal, static_cast<double>(angle * judged.bend * closing / (speed * unit)));
    else EXPECT_TRUE(judged.is_marginal || angle < 4 * Quad(0x1p-52)) << "wrong face";
  }
  double median() {
    const auto middle = relative.begin() + static_cast<std::ptrdiff_t>(relative.size() / 2);
    std::ranges::nth_element(relative, middle);
    return *middle;
  }
  double worst() const { return *std::ranges::max_element(relative); }
};

/// Judges `answer` to the question when the shapes of `encounter`, together the obstacle
/// `obstacle`, first touch.
Judged judge(const Encounter& e, const Obstacle& obstacle, const MaybeContact<double>& answer) {
  const Flight flight{exact(e.position_a) - exact(e.position_b),
                      exact(e.velocity_a) - exact(e.velocity_b)};
  Judged judged{answer, first_touch(flight, obstacle), {1, 0}, flight.velocity};
  judged.length =
      e.offset().norm() +
      static_cast<double>(root(dot(obstacle.half_extent, obstacle.half_extent)) + obstacle.radius);
  const Quad slack = 5 * Quad(0x1p-52) * judged.length;
  if (judged.truth.has_value() != answer.has_value())
    judged.is_marginal =
        first_touch(flight, obstacle.grown(judged.truth ? -slack : slack)).has_value() !=
        judged.truth.has_value();
  if (!judged.truth) return judged;
  if (answer) judged.gap = obstacle.gap(flight.at(answer->time));
  judged.normal = normal_at(flight, obstacle, *judged.truth);
  const QuadPoint touch = flight.at(*judged.truth);
  const Quad x = magnitude(touch.x) - obstacle.half_extent.x,
             y = magnitude(touch.y) - obstacle.half_extent.y;
  if (x > 0 && y > 0) judged.bend = static_cast<double>(obstacle.radius);
  if (obstacle.radius == 0) judged.is_marginal = magnitude(x - y) < slack;
  return judged;
}

Quad sum(double a, double b) { return Quad(a) + Quad(b); }

Judged judge_discs(Seeded& seeded, Difficulty difficulty, bool is_still) {
  const double scale = scale_of(difficulty), radius_a = scale * seeded.magnitude(0.01, 1.0),
               radius_b = scale * seeded.magnitude(0.01, 1.0);
  const Encounter e = encounter(seeded, difficulty, {{0.0, 0.0}, radius_a + radius_b}, is_still);
  const Disc<double> a{e.position_a, radius_a}, b{e.position_b, radius_b};
  return judge(e, {{0, 0}, sum(radius_a, radius_b)},
               is_still ? time_disc_meets_disc(a, e.velocity_a, b)
                        : time_disc_meets_disc(a, e.velocity_a, b, e.velocity_b));
}

/// The textbook's quadratic, for comparison: b^2 - |v|^2 c and the difference of near numbers.
MaybeContact<double> textbook(const Point& offset, const Point& velocity, double reach) {
  const double b = offset.dot(velocity), square = velocity.squaredNorm(),
               discriminant = b * b - square * (offset.squaredNorm() - reach * reach);
  if (b >= 0.0 || discriminant < 0.0) return std::nullopt;
  return Contact<double>{(-b - std::sqrt(discriminant)) / square, {1.0, 0.0}};
}

Judged judge_still_discs(Seeded& seeded, Difficulty difficulty) {
  return judge_discs(seeded, difficulty, true);
}
Judged judge_moving_discs(Seeded& seeded, Difficulty difficulty) {
  return judge_discs(seeded, difficulty, false);
}

Point random_extent(Seeded& seeded, Difficulty difficulty) {
  return scale_of(difficulty) * Point(seeded.magnitude(0.01, 1.0), seeded.magnitude(0.01, 1.0));
}

Judged judge_rounded_box(Seeded& seeded, Difficulty difficulty) {
  const double radius = scale_of(difficulty) * seeded.magnitude(0.01, 1.0);
  const Point extent = random_extent(seeded, difficulty);
  const Encounter e = encounter(seeded, difficulty, {extent, radius});
  return judge(e, {exact(extent), radius},
               time_disc_meets_rounded_box(Disc<double>{e.position_a, radius}, e.velocity_a,
                                           Box<double>{e.position_b, extent}, e.velocity_b));
}

Judged judge_sharp_box(Seeded& seeded, Difficulty difficulty) {
  const double radius = scale_of(difficulty) * seeded.magnitude(0.01, 1.0);
  const Point extent = random_extent(seeded, difficulty);
  const Encounter e = encounter(seeded, difficulty, {extent + Point(radius, radius), 0.0});
  return judge(e, {{sum(extent.x(), radius), sum(extent.y(), radius)}, 0},
               time_disc_meets_sharp_box(Disc<double>{e.position_a, radius}, e.velocity_a,
                                         Box<double>{e.position_b, extent}, e.velocity_b));
}

Judged judge_boxes(Seeded& seeded, Difficulty difficulty) {
  const Point a = random_extent(seeded, difficulty), b = random_extent(seeded, difficulty);
  const Encounter e = encounter(seeded, difficulty, {a + b, 0.0});
  return judge(e, {{sum(a.x(), b.x()), sum(a.y(), b.y())}, 0},
               time_box_meets_box(Box<double>{e.position_a, a}, e.velocity_a,
                                  Box<double>{e.position_b, b}, e.velocity_b));
}

/// An oblique edge around position_b; encounters are aimed at the box whose diagonal it is.
Judged judge_edge(Seeded& seeded, Difficulty difficulty, bool is_still) {
  const Point half = random_extent(seeded, difficulty);
  const Encounter e = encounter(seeded, difficulty, {half, 0.0}, is_still);
  const Edge<double> edge{e.position_b + half, e.position_b - half};
  const QuadPoint from = exact(edge.from), along = exact(edge.to) - from;
  const Flight flight{exact(e.position_a), exact(e.velocity_a) - exact(e.velocity_b)};
  Judged judged{is_still
                    ? time_point_meets_edge(e.position_a, e.velocity_a, edge)
                    : time_point_meets_moving_edge(e.position_a, e.velocity_a, edge, e.velocity_b),
                first_touch_of_edge(flight, from, exact(edge.to)),
                {1, 0},
                flight.velocity};
  judged.length = e.offset().norm() + half.norm();
  const Quad length = root(dot(along, along));
  judged.normal = (1 / length) * QuadPoint{along.y, -along.x};
  if (judged.answer) judged.gap = dot(judged.normal, flight.at(judged.answer->time) - from);
  if (judged.truth.has_value() == judged.answer.has_value()) return judged;
  // Passing an end by less than the slack, across the flight.
  const Quad speed = root(dot(flight.velocity, flight.velocity)),
             slack = 5 * Quad(0x1p-52) * judged.length * speed /
                     magnitude(dot(judged.normal, flight.velocity)) / length;
  judged.is_marginal =
      first_touch_of_edge(flight, from, exact(edge.to), judged.truth ? -slack : slack)
              .has_value() != judged.truth.has_value() ||
      magnitude(dot(judged.normal, flight.at(0) - from)) < Quad(0x1p-48) * judged.length;
  return judged;
}

Judged judge_still_edge(Seeded& seeded, Difficulty difficulty) {
  return judge_edge(seeded, difficulty, true);
}
Judged judge_moving_edge(Seeded& seeded, Difficulty difficulty) {
  return judge_edge(seeded, difficulty, false);
}

struct Subject {
  const char* name;
  Judged (*judge)(Seeded&, Difficulty);
};
constexpr Subject subjects[] = {{"point, still edge", judge_still_edge},
                                {"point, moving edge", judge_moving_edge},
                                {"disc, still disc", judge_still_discs},
                                {"disc, moving disc", judge_moving_discs},
                                {"disc, rounded box", judge_rounded_box},
                                {"disc, sharp box", judge_sharp_box},
                                {"box, box", judge_boxes}};

using Row = std::vector<Tally>;

/// How often the median error of the textbook's formula exceeds that of the library, over the same
/// encounters.
double textbook_ratio(Difficulty difficulty, int count) {
  std::vector<double> ours, theirs;
  Seeded seeded{3};
  for (int i = 0; i < count; ++i) {
    const double radius = 0.04;
    const Encounter e = encounter(seeded, difficulty, {{0.0, 0.0}, 2.0 * radius});
    const auto truth = first_touch(
        {exact(e.position_a) - exact(e.position_b), exact(e.velocity_a) - exact(e.velocity_b)},
        {{0, 0}, Quad(radius) + Quad(radius)});
    const auto mine = time_disc_meets_disc<double>({e.position_a, radius}, e.velocity_a,
                                                   {e.position_b, radius}, e.velocity_b);
    const auto other = textbook(e.offset(), e.velocity(), 2.0 * radius);
    if (!truth || !mine || !other) continue;
    ours.push_back(static_cast<double>(magnitude(mine->time - *truth)));
    theirs.push_back(static_cast<double>(magnitude(other->time - *truth)));
  }
  const auto median = [](std::vector<double>& errors) {
    std::ranges::nth_element(errors,
                             errors.begin() + static_cast<std::ptrdiff_t>(errors.size() / 2));
    return errors[errors.size() / 2];
  };
  return median(theirs) / median(ours);
}

/// Two significant digits.
std::string brief(double value) {
  char text[24];
  std::snprintf(text, sizeof text, "%.2g", value);
  return text;
}

void print(const char* title, std::vector<Row>& rows,
           const std::function<std::string(Tally&)>& figure) {
  std::printf("\n| %s |", title);
  for (const char* name : difficulty_names) std::printf(" %s |", name);
  std::printf("\n|---|---|---|---|---|---|---|---|\n");
  for (std::size_t i = 0; i < rows.size(); ++i) {
    std::printf("| %s |", subjects[i].name);
    for (Tally& tally : rows[i]) std::printf(" %s |", figure(tally).c_str());
    std::printf("\n");
  }
}

/// Errors of every test over `count` encounters of every difficulty.
std::vector<Row> tally_all(int count) {
  std::vector<Row> rows;
  for (const Subject& subject : subjects) {
    Row& row = rows.emplace_back(difficulty_count);
    for (int i = 0; i < difficulty_count; ++i) {
      Seeded seeded{static_cast<std::uint64_t>(i)};
      for (int k = 0; k < count; ++k) {
        SCOPED_TRACE(testing::Message()
                     << subject.name << ", " << difficulty_names[i] << ", seed " << seeded.state());
        row[static_cast<std::size_t>(i)].add(subject.judge(seeded, difficulties[i]));
      }
    }
  }
  return rows;
}

void expect_rounding_only(std::vector<Row>& rows) {
  for (std::size_t i = 0; i < rows.size(); ++i)
    for (std::size_t k = 0; k < rows[i].size(); ++k) {
      SCOPED_TRACE(std::string(subjects[i].name) + ", " + difficulty_names[k]);
      EXPECT_LE(rows[i][k].gap, 4.0);
      EXPECT_LE(rows[i][k].normal, 6.0);
      EXPECT_GT(rows[i][k].relative.size(), 10U);
    }
}

TEST(TimesOfImpact, AreWithinRoundingOfTheTruth) {
  auto rows = tally_all(200);
  expect_rounding_only(rows);
}

TEST(TimesOfImpact, OfPucksThatSkimAFaceAreNeverLostAtTheSeamWithTheCorner) {
  Seeded seeded{17};
  Tally tally;
  for (int i = 0; i < 3000; ++i) {
    SCOPED_TRACE("seed " + std::to_string(seeded.state()));
    const double radius = seeded.magnitude(0.01, 1.0);
    Point extent = random_extent(seeded, Difficulty::random);
    Encounter e{{0.0, 0.0}, {1.0, 0.0}, {0.0, 0.0}, {0.0, 0.0}};
    e.position_a = {-(extent.x() + seeded.uniform(1.0, 3.0) * radius),
                    (extent.y() + radius) * (1.0 + seeded.sign() * seeded.magnitude(1e-17, 1e-12))};
    e.velocity_a.y() = seeded.sign() * seeded.magnitude(1e-17, 1e-9);
    if (seeded.next() % 2 == 0)
      for (Point* p : {&e.position_a, &e.velocity_a, &extent}) *p = Point(p->y(), p->x());
    tally.add(judge(e, {exact(extent), radius},
                    time_disc_meets_rounded_box(Disc<double>{e.position_a, radius}, e.velocity_a,
                                                Box<double>{e.position_b, extent}, e.velocity_b)));
  }
  EXPECT_LE(tally.gap, 4.0);
  EXPECT_GT(tally.relative.size(), 500U);
  EXPECT_GT(tally.misses, 500);
}

TEST(TimesOfImpact, AreAsPreciseAsTheirScalar) {
  using Long = long double;
  Seeded seeded{19};
  Quad worst = 0;
  for (int i = 0; i < 300; ++i) {
    const double radius = seeded.magnitude(0.01, 1.0);
    const Point extent = random_extent(seeded, Difficulty::random), still(0.0, 0.0);
    const Encounter e = encounter(seeded, Difficulty::random, {extent, radius});
    const Disc<Long> disc{e.position_a.cast<Long>(), radius};
    const Box<Long> box{e.position_b.cast<Long>(), extent.cast<Long>()};
    const auto answer = time_disc_meets_rounded_box(disc, e.velocity_a.cast<Long>(), box,
                                                    e.velocity_b.cast<Long>());
    const auto truth = first_touch(
        {exact(e.position_a) - exact(e.position_b), exact(e.velocity_a) - exact(e.velocity_b)},
        {exact(extent), radius});
    ASSERT_EQ(answer.has_value(), truth.has_value());
    if (truth) worst = std::max(worst, magnitude(answer->time - *truth) / *truth);
  }
  EXPECT_LT(static_cast<double>(worst), 1e-17);
}

TEST(TimesOfImpact, OfDiscsAreBetterThanTheTextbooksOnDistantAndGrazingFlights) {
  EXPECT_GT(textbook_ratio(Difficulty::distant, 1000), 10.0);
  EXPECT_GT(textbook_ratio(Difficulty::grazing, 1000), 3.0);
}

TEST(TimesOfImpactLong, AreWithinRoundingOfTheTruth) {
  auto rows = tally_all(4000);
  expect_rounding_only(rows);
  print("relative error of the time, median / greatest", rows,
        [](Tally& tally) { return brief(tally.median()) + " / " + brief(tally.worst()); });
  print("greatest gap at that time", rows, [](Tally& tally) { return brief(tally.gap); });
  print("greatest error of the normal", rows, [](Tally& tally) { return brief(tally.normal); });
  print("hits / misjudged", rows, [](Tally& tally) {
    return std::to_string(tally.relative.size()) + " / " + std::to_string(tally.misjudged);
  });
  for (const Difficulty difficulty : difficulties)
    std::printf("textbook's median error over ours, disc and disc, %s: %.2g\n",
                difficulty_names[static_cast<int>(difficulty)], textbook_ratio(difficulty, 4000));
}

}  // namespace
}  // namespace rink::physics::collision
