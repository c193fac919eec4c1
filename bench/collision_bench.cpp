// Nanoseconds per question to the collision library over random pairs, with the error against the
// 113-bit truth.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <string>
#include <vector>

#include "game/physics/collision/accelerated_tests.h"
#include "game/physics/collision/dynamic_tests.h"
#include "game/physics/collision/static_tests.h"
#include "tests/physics/collision_library/collision_library_cases.h"
#include "tests/physics/collision_library/collision_library_reference.h"

namespace rink::bench::collision_bench {
namespace {

using namespace rink::physics::collision;
using namespace rink::physics::collision::reference;
using Point = Vector<double>;

constexpr double radius = 0.04, post_radius = 0.1;
const Point bat_extent(0.03, 0.1), other_extent(0.04, 0.05);
constexpr std::size_t pair_count =
    1024;  // a power of two, more than a branch predictor learns by heart

std::vector<Encounter> encounters(const Target& target) {
  Seeded seeded{13};
  std::vector<Encounter> all;
  for (std::size_t i = 0; i < pair_count; ++i) {
    // As a broad phase leaves them: about half of the pairs meet.
    Encounter e = encounter(seeded, Difficulty::random, target);
    if (seeded.next() % 2 == 0)
      e.velocity_a = e.velocity_b + e.velocity().norm() * seeded.direction();
    all.push_back(e);
  }
  return all;
}

double number(double answer) { return answer; }
double number(bool answer) { return answer ? 1.0 : 0.0; }
double number(const MaybeContact<double>& answer) { return answer ? answer->time : -1.0; }

Flight flight_of(const Encounter& e) {
  return {exact(e.position_a) - exact(e.position_b), exact(e.velocity_a) - exact(e.velocity_b)};
}

/// The truth as a number, like the answer.
double number_at(const std::optional<Quad>& time) {
  return time ? static_cast<double>(*time) : -1.0;
}

/// Asks `ask` about pairs that are aimed at `target`; `truth` gives the number that is right.
template <class Ask, class Truth>
void add(const std::string& name, const Target& target, const Ask& ask, const Truth& truth) {
  const auto run = [=](benchmark::State& state) {
    const std::vector<Encounter> all = encounters(target);
    std::size_t i = 0;
    for (auto _ : state) benchmark::DoNotOptimize(ask(all[i++ % pair_count]));
    state.SetItemsProcessed(state.iterations());
    double error = 0.0;
    std::uint64_t hash = 0;
    for (const Encounter& e : all) {
      const double answer = number(ask(e)), right = truth(e);
      error = std::max(error, right == 0.0 ? std::abs(answer) : std::abs(answer / right - 1.0));
      const auto bits = std::bit_cast<std::uint64_t>(answer);
      hash =
          (hash ^ bits ^ (bits >> 32)) * 0x100000001b3ULL;  // 1.0 and 0.0 differ in high bits only
    }
    state.counters["error"] = error;
    char text[24];
    std::snprintf(text, sizeof text, "hash %016llx", static_cast<unsigned long long>(hash));
    state.SetLabel(text);
  };
  benchmark::RegisterBenchmark(("physics/collision/" + name).c_str(), run)->UseRealTime();
}

void add_static_tests() {
  const auto overlaps = [](const Obstacle& obstacle) {
    return [=](const Encounter& e) { return number(obstacle.rest_contacts(flight_of(e).offset)); };
  };
  const Point normal(0.6, 0.8);
  add(
      "point_plane_distance", {{0.0, 0.0}, radius},
      [=](const Encounter& e) {
        return point_plane_distance(e.position_a, Plane<double>{e.position_b, normal});
      },
      [=](const Encounter& e) {
        return static_cast<double>(dot(exact(normal), flight_of(e).offset));
      });
  add(
      "is_point_in_circle", {{0.0, 0.0}, radius},
      [](const Encounter& e) {
        return is_point_in_circle(e.position_a, Disc<double>{e.position_b, 3.0 * radius});
      },
      overlaps({{0, 0}, 3.0 * radius}));
  add(
      "do_bounding_circles_overlap", {{0.0, 0.0}, radius},
      [](const Encounter& e) {
        return do_bounding_circles_overlap(Disc<double>{e.position_a, radius},
                                           Disc<double>{e.position_b, 2.0 * radius});
      },
      overlaps({{0, 0}, 3.0 * radius}));
  add(
      "does_disc_overlap_box", {bat_extent, 0.0},
      [](const Encounter& e) {
        return does_disc_overlap_box(Disc<double>{e.position_a, 5.0 * radius},
                                     Box<double>{e.position_b, bat_extent});
      },
      overlaps({exact(bat_extent), 5.0 * radius}));
  add(
      "do_boxes_overlap", {bat_extent, 0.0},
      [](const Encounter& e) {
        return do_boxes_overlap(Box<double>{e.position_a, 2.0 * bat_extent},
                                Box<double>{e.position_b, bat_extent});
      },
      overlaps({3 * exact(bat_extent), 0}));
}

void add_dynamic_tests() {
  const auto meets = [](const Obstacle& obstacle) {
    return [=](const Encounter& e) { return number_at(first_touch(flight_of(e), obstacle)); };
  };
  const auto edge_of = [](const Encounter& e) {
    return Edge<double>{e.position_b + bat_extent, e.position_b - bat_extent};
  };
  const auto meets_edge = [=](const Encounter& e, const Point& edge_velocity) {
    const Edge<double> edge = edge_of(e);
    return number_at(
        first_touch_of_edge({exact(e.position_a), exact(e.velocity_a) - exact(edge_velocity)},
                            exact(edge.from), exact(edge.to)));
  };
  add(
      "time_point_meets_edge", {bat_extent, 0.0},
      [=](const Encounter& e) {
        return time_point_meets_edge(e.position_a, e.velocity_a, edge_of(e));
      },
      [=](const Encounter& e) {
        return meets_edge(e, {0.0, 0.0});
      });
  add(
      "time_point_meets_moving_edge", {bat_extent, 0.0},
      [=](const Encounter& e) {
        return time_point_meets_moving_edge(e.position_a, e.velocity_a, edge_of(e), e.velocity_b);
      },
      [=](const Encounter& e) { return meets_edge(e, e.velocity_b); });
  const Obstacle discs{{0, 0}, Quad(radius) + Quad(post_radius)};
  add(
      "time_disc_meets_still_disc", {{0.0, 0.0}, radius + post_radius},
      [](const Encounter& e) {
        return time_disc_meets_disc(Disc<double>{e.position_a, radius}, e.velocity_a,
                                    Disc<double>{e.position_b, post_radius});
      },
      [=](const Encounter& e) {
        return number_at(
            first_touch({exact(e.position_a) - exact(e.position_b), exact(e.velocity_a)}, discs));
      });
  add(
      "time_disc_meets_moving_disc", {{0.0, 0.0}, radius + post_radius},
      [](const Encounter& e) {
        return time_disc_meets_disc(Disc<double>{e.position_a, radius}, e.velocity_a,
                                    Disc<double>{e.position_b, post_radius}, e.velocity_b);
      },
      meets(discs));
  add(
      "time_disc_meets_rounded_box", {bat_extent, radius},
      [](const Encounter& e) {
        return time_disc_meets_rounded_box(Disc<double>{e.position_a, radius}, e.velocity_a,
                                           Box<double>{e.position_b, bat_extent}, e.velocity_b);
      },
      meets({exact(bat_extent), radius}));
  add(
      "time_disc_meets_sharp_box", {bat_extent, radius},
      [](const Encounter& e) {
        return time_disc_meets_sharp_box(Disc<double>{e.position_a, radius}, e.velocity_a,
                                         Box<double>{e.position_b, bat_extent}, e.velocity_b);
      },
      meets({exact(bat_extent) + exact(Point(radius, radius)), 0}));
  add(
      "time_box_meets_box", {bat_extent + other_extent, 0.0},
      [](const Encounter& e) {
        return time_box_meets_box(Box<double>{e.position_a, other_extent}, e.velocity_a,
                                  Box<double>{e.position_b, bat_extent}, e.velocity_b);
      },
      meets({exact(bat_extent) + exact(other_extent), 0}));
}

/// Without thrust and drag the general case has the truth of the straight one.
void add_driven_tests() {
  const auto motions = [](const Encounter& e) {
    rink::physics::Motion a, b;
    a.position = e.position_a, a.velocity = e.velocity_a, b.position = e.position_b,
    b.velocity = e.velocity_b;
    return std::pair(a, b);
  };
  const auto ask = [=](const Point& extent, double reach) {
    return [=](const Encounter& e) {
      const auto [a, b] = motions(e);
      return meet_rounded_box(a, b, extent, reach, {0.0, 1e3});
    };
  };
  const auto meets = [](const Obstacle& obstacle) {
    return [=](const Encounter& e) { return number_at(first_touch(flight_of(e), obstacle)); };
  };
  add("driven/time_disc_meets_disc", {{0.0, 0.0}, radius + post_radius},
      ask({0.0, 0.0}, radius + post_radius), meets({{0, 0}, radius + post_radius}));
  add("driven/time_disc_meets_rounded_box", {bat_extent, radius}, ask(bat_extent, radius),
      meets({exact(bat_extent), radius}));
}

const bool registered = [] {
  add_static_tests();
  add_dynamic_tests();
  add_driven_tests();
  return true;
}();

}  // namespace
}  // namespace rink::bench::collision_bench
