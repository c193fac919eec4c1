// Times what stands on top of the engine, views, compositions and stages, each beside `region` on
// the same crowd in the same run, judged pair by pair at each of some ticks.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <memory>
#include <string>
#include <vector>

#include "bench/clock.h"
#include "bench/im_crowd.h"
#include "im/stages/priority_order.h"

namespace rink::bench::im_composed_bench {
namespace {

using namespace rink;
using bench::Crowd, bench::Table, bench::replay;

constexpr double rate_hz = 60.0, half_angle_deg = 60.0, horizon = 0.2, margin = 0.3;
constexpr std::array tier_ends{0.3, 0.6};
constexpr std::uint32_t dwell_matches = 10, item_bytes = 20, budget = 500;

/// The crowd with what brute force has to remember of it.
struct Scene {
  Scene(std::uint32_t subscribers, std::uint32_t objects)
      : crowd(subscribers, objects, rate_hz),
        flights(objects),
        reach(objects),
        holds_until(objects, -1.0),
        since(std::size_t{subscribers} * objects) {
    for (const double x : {0.2, 0.8})
      for (const double y : {0.3, 0.7}) posts.push_back({x * crowd.side, y * crowd.side, 1.0});
    for (std::size_t e = 0; e < objects; ++e) take_off(e);
    look();
  }

  double now() const { return static_cast<double>(crowd.tick) / rate_hz; }
  void step(double share) {
    crowd.step(share);
    for (std::size_t e = 0; e < flights.size(); ++e)
      if (crowd.objects[e].dx * rate_hz != flights[e].velocity_x ||
          crowd.objects[e].dy * rate_hz != flights[e].velocity_y)
        take_off(e);
    look();
  }

  Crowd crowd;
  std::vector<im::Disc> posts;
  std::vector<im::Flight> flights;
  std::vector<im::Region> updates, subscriptions,
      reach;  ///< where they are, and the hull of where an object comes to before its region is
              ///< made anew
  std::vector<double> holds_until;
  std::vector<std::uint32_t> since;  ///< the match at which a pair entered
  std::uint32_t matches = 0;

 private:
  void take_off(std::size_t e) {
    const Crowd::Mover& object = crowd.objects[e];
    flights[e] = {object.x, object.y, object.dx * rate_hz, object.dy * rate_hz, now()};
    holds_until[e] = -1.0;
  }
  void look() {
    ++matches;
    updates.clear(), subscriptions.clear();
    for (std::size_t e = 0; e < flights.size(); ++e) {
      updates.push_back(crowd.update(e));
      if (holds_until[e] >= now() + 0.5 * horizon) continue;
      const im::Flight& flight = flights[e];
      const double from = now() - flight.time, to = from + horizon;
      const auto [low_x, high_x] =
          std::minmax({flight.x + flight.velocity_x * from, flight.x + flight.velocity_x * to});
      const auto [low_y, high_y] =
          std::minmax({flight.y + flight.velocity_y * from, flight.y + flight.velocity_y * to});
      reach[e] = {low_x - 0.04, low_y - 0.04, high_x + 0.04, high_y + 0.04};
      holds_until[e] = now() + horizon;
    }
    for (std::size_t s = 0; s < crowd.subscribers.size(); ++s)
      subscriptions.push_back(crowd.subscription(s));
  }
};

bool overlaps(const im::Region& s, const im::Region& u, double grown = 0.0) {
  return s.low_x - grown <= u.high_x && u.low_x <= s.high_x + grown &&
         s.low_y - grown <= u.high_y && u.low_y <= s.high_y + grown;
}

struct Point {
  double x, y;
};
Point eye_of(const im::Region& s) {
  return {0.5 * (s.low_x + s.high_x), 0.5 * (s.low_y + s.high_y)};
}

bool is_in_disc(const im::Region& s, const im::Region& u, double fraction = 1.0) {
  const Point eye = eye_of(s);
  return std::hypot(std::clamp(eye.x, u.low_x, u.high_x) - eye.x,
                    std::clamp(eye.y, u.low_y, u.high_y) - eye.y) <=
         fraction * 0.5 * (s.high_x - s.low_x);
}

/// A stretch from `eye` by (x, y) has a point in `box`: what each axis leaves of it.
bool meets(const Point& eye, double x, double y, const im::Region& box) {
  const double to_x[] = {(box.low_x - eye.x) / x, (box.high_x - eye.x) / x},
               to_y[] = {(box.low_y - eye.y) / y, (box.high_y - eye.y) / y};
  return std::max({0.0, std::min(to_x[0], to_x[1]), std::min(to_y[0], to_y[1])}) <=
         std::min({1.0, std::max(to_x[0], to_x[1]), std::max(to_y[0], to_y[1])});
}

bool is_in_cone(const Scene& scene, std::size_t s, std::size_t e) {
  const im::Region &mine = scene.subscriptions[s], &box = scene.updates[e];
  if (!is_in_disc(mine, box)) return false;
  const Point eye = eye_of(mine);
  const double half_angle = half_angle_deg * 3.14159265358979323846 / 180.0,
               radius = 0.5 * (mine.high_x - mine.low_x);
  const double ahead = std::atan2(scene.crowd.subscribers[s].dy, scene.crowd.subscribers[s].dx);
  const double x = std::clamp(eye.x, box.low_x, box.high_x) - eye.x,
               y = std::clamp(eye.y, box.low_y, box.high_y) - eye.y;
  if ((x == 0.0 && y == 0.0) ||
      std::abs(std::remainder(std::atan2(y, x) - ahead, 6.283185307179586)) <= half_angle)
    return true;
  return meets(eye, radius * std::cos(ahead + half_angle), radius * std::sin(ahead + half_angle),
               box) ||
         meets(eye, radius * std::cos(ahead - half_angle), radius * std::sin(ahead - half_angle),
               box);
}

bool is_in_sight(const Scene& scene, std::size_t s, std::size_t e) {
  const im::Region& box = scene.updates[e];
  if (!overlaps(scene.subscriptions[s], box)) return false;
  const Point eye = eye_of(scene.subscriptions[s]);
  return std::none_of(scene.posts.begin(), scene.posts.end(), [&](const im::Disc& post) {
    const double x = post.x - eye.x, y = post.y - eye.y;
    if (std::hypot(x, y) < post.radius) return false;
    const auto is_hidden = [&](double corner_x, double corner_y) {
      const double way_x = corner_x - eye.x, way_y = corner_y - eye.y,
                   along = std::clamp((x * way_x + y * way_y) / (way_x * way_x + way_y * way_y),
                                      0.0, 1.0);
      return std::hypot(along * way_x - x, along * way_y - y) < post.radius;
    };
    return is_hidden(box.low_x, box.low_y) && is_hidden(box.low_x, box.high_y) &&
           is_hidden(box.high_x, box.low_y) && is_hidden(box.high_x, box.high_y);
  });
}

/// True if the pair is relevant now; `was`: at the last match.
using Rule = bool (*)(Scene&, std::size_t s, std::size_t e, bool was);

bool is_in_aura(Scene& scene, std::size_t s, std::size_t e, bool) {
  return is_in_disc(scene.subscriptions[s], scene.updates[e]);
}
bool is_in_corner(Scene& scene, std::size_t s, std::size_t e, bool) {
  return overlaps(scene.subscriptions[s], scene.updates[e]) &&
         !is_in_disc(scene.subscriptions[s], scene.updates[e]);
}
bool is_in_diamond(Scene& scene, std::size_t s, std::size_t e, bool) {
  const im::Region &mine = scene.subscriptions[s], &its = scene.updates[e];
  const Point eye = eye_of(mine);
  return std::abs(std::clamp(eye.x, its.low_x, its.high_x) - eye.x) +
             std::abs(std::clamp(eye.y, its.low_y, its.high_y) - eye.y) <=
         0.5 * (mine.high_x - mine.low_x);
}
bool steadied(Scene& scene, std::size_t s, std::size_t e, bool was) {
  return overlaps(scene.subscriptions[s], scene.updates[e], was ? margin : 0.0);
}
bool dwells(Scene& scene, std::size_t s, std::size_t e, bool was) {
  std::uint32_t& since = scene.since[s * scene.updates.size() + e];
  const bool is_in = overlaps(scene.subscriptions[s], scene.updates[e]);
  if (is_in && !was) since = scene.matches;
  return is_in || (was && scene.matches - since < dwell_matches);
}

struct Case {
  const char* expression;
  Rule rule;
  bool has_tiers = false;
};
const Case cases[] = {
    {"aura", is_in_aura},
    {"diamond", is_in_diamond},
    {"cone",
     [](Scene& scene, std::size_t s, std::size_t e, bool) { return is_in_cone(scene, s, e); }},
    {"sight",
     [](Scene& scene, std::size_t s, std::size_t e, bool) { return is_in_sight(scene, s, e); }},
    {"aura and sight",
     [](Scene& scene, std::size_t s, std::size_t e, bool) {
       return is_in_disc(scene.subscriptions[s], scene.updates[e]) && is_in_sight(scene, s, e);
     }},
    {"sight or cone", [](Scene& scene, std::size_t s, std::size_t e,
                         bool) { return is_in_sight(scene, s, e) || is_in_cone(scene, s, e); }},
    {"region and not aura", is_in_corner},
    {"not region", [](Scene& scene, std::size_t s, std::size_t e,
                      bool) { return !overlaps(scene.subscriptions[s], scene.updates[e]); }},
    {"region with hysteresis(margin=0.3)", steadied},
    {"region with dwell(matches=10)", dwells},
    {"region with swept(horizon=0.2)",
     [](Scene& scene, std::size_t s, std::size_t e, bool) {
       return overlaps(scene.subscriptions[s], scene.reach[e]);
     }},
    {"aura with tiers(at=0.3 at=0.6)", is_in_aura, true},
    {"aura with priority(budget=500)", is_in_aura},
    {"aura with tiers(at=0.3 at=0.6) with priority(budget=500)", is_in_aura, true},
};

/// A filter that is told of the scene as a server tells it, its changes replayed.
class Told {
 public:
  Told(const std::string& expression, const Scene& scene)
      : filter_(
            im::make_filter(expression, {.world = {0.0, 0.0, scene.crowd.side, scene.crowd.side},
                                         .half_angle_deg = half_angle_deg,
                                         .posts = scene.posts})),
        flies_(filter_->traits().uses_flights),
        looks_(filter_->traits().uses_headings),
        table_(scene.since.size()) {
    scene.crowd.tell(*filter_);
    pass(scene);
  }

  /// One tick: all that moved is handed in, the match, and what is sent filled into the budget.
  /// Returns its processor time [s].
  double pass(const Scene& scene) {
    const double start = seconds_of();
    if (flies_) {
      filter_->set_time(scene.now());
      for (std::uint32_t e = 0; e < scene.flights.size(); ++e)
        filter_->set_flight(e, scene.flights[e]);
      for (std::uint32_t s = 0; s < scene.subscriptions.size(); ++s)
        filter_->set_subscription_region(s, scene.crowd.subscription(s));
    } else {
      scene.crowd.tell(*filter_);
    }
    if (looks_)
      for (std::uint32_t s = 0; s < scene.subscriptions.size(); ++s)
        filter_->set_heading(s, {scene.crowd.subscribers[s].dx, scene.crowd.subscribers[s].dy});
    const auto changes = filter_->match();
    if (im::PriorityOrder* const order = filter_->priority())
      for (std::uint32_t s = 0; s < scene.subscriptions.size(); ++s)
        benchmark::DoNotOptimize(
            order->fill(s, budget, [](const auto&) { return std::size_t{item_bytes}; }).data());
    const double taken = seconds_of() - start;
    wrong_ += replay(changes, scene.updates.size(), table_);
    return taken;
  }

  /// Pairs at another level than the rule says, and changes that were no news, since the last call.
  std::size_t mismatches(Scene& scene, const Case& judged, Table& expected) {
    std::size_t wrong = wrong_;
    wrong_ = 0;
    for (std::size_t s = 0; s < scene.subscriptions.size(); ++s)
      for (std::size_t e = 0; e < scene.updates.size(); ++e) {
        std::uint8_t& level = expected[s * scene.updates.size() + e];
        level = judged.rule(scene, s, e, level != 0);
        if (level != 0 && judged.has_tiers)
          for (const double end : tier_ends)
            level = static_cast<std::uint8_t>(
                level + (is_in_disc(scene.subscriptions[s], scene.updates[e], end) ? 0 : 1));
        wrong += level != table_[s * scene.updates.size() + e] ? 1u : 0u;
      }
    return wrong;
  }
  const im::FilterCounters& counters() const { return filter_->counters(); }
  std::size_t standing() const {
    return table_.size() - static_cast<std::size_t>(std::count(table_.begin(), table_.end(), 0));
  }

 private:
  std::unique_ptr<im::Filter> filter_;
  bool flies_, looks_;
  Table table_;
  std::size_t wrong_ = 0;
};

std::size_t judge(const Case& judged, std::uint32_t subscribers, std::uint32_t objects,
                  double moved) {
  Scene scene(subscribers, objects);
  Told told(judged.expression, scene);
  Table expected(scene.since.size());
  std::size_t wrong = told.mismatches(scene, judged, expected);
  for (int tick = 0; tick < 15; ++tick) {
    scene.step(moved);
    told.pass(scene);
    wrong += told.mismatches(scene, judged, expected);
  }
  return wrong;
}

double median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2),
                   values.end());
  return values[values.size() / 2];
}

void composed(benchmark::State& state, const Case& measured, std::uint32_t subscribers,
              std::uint32_t objects, double moved) {
  Scene scene(subscribers, objects);
  Told told(measured.expression, scene), region("region", scene);
  const im::FilterCounters before = told.counters();
  std::vector<double> own, beside;
  for (auto _ : state) {
    scene.step(moved);
    beside.push_back(region.pass(scene));
    own.push_back(told.pass(scene));
    state.SetIterationTime(own.back());
  }
  using benchmark::Counter;
  state.counters["median_us"] = 1e6 * median(own);
  state.counters["region_median_us"] = 1e6 * median(beside);
  state.counters["times_region"] = median(own) / median(beside);
  state.counters["changes"] = Counter(static_cast<double>(told.counters().changes - before.changes),
                                      Counter::kAvgIterations);
  state.counters["tests"] =
      Counter(static_cast<double>(told.counters().pairs_tested - before.pairs_tested),
              Counter::kAvgIterations);
  state.counters["standing"] = static_cast<double>(told.standing());
  state.counters["mismatches"] = static_cast<double>(judge(measured, subscribers, objects, moved));
}

const bool is_registered = [] {
  for (const Case& each : cases)
    for (const char* moved : {"1", "0.01"}) {
      const bool is_of_all =
          std::string(each.expression).starts_with("not");  // keeps every pair there is
      const std::uint32_t subscribers = is_of_all ? 250 : 1'000,
                          objects = is_of_all ? 2'500 : 10'000;
      const std::string name = "im/composed/" + im::file_name_of(each.expression) +
                               "/subscribers:" + std::to_string(subscribers) +
                               "/objects:" + std::to_string(objects) + "/moved:" + moved;
      benchmark::RegisterBenchmark(name.c_str(), composed, each, subscribers, objects,
                                   std::stod(moved))
          ->UseManualTime()
          ->Unit(benchmark::kMicrosecond)
          ->Iterations(60);
    }
  return true;
}();

}  // namespace
}  // namespace rink::bench::im_composed_bench
