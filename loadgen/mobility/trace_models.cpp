// The three models; what is not of the literature is called so.
#include "loadgen/mobility/trace_models.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <functional>
#include <map>
#include <numbers>
#include <string>
#include <utility>

#include "game/model/random_stream.h"
#include "game/model/scene.h"
#include "game/physics/flight/exponential.h"

namespace rink::loadgen {
namespace {

using game::RandomStream;

/// base^exponent for base > 0, with equal bits on every machine.
double power(double base, double exponent) {
  const double x = exponent * physics::log1p_of(base - 1.0);
  return x <= 0.0 ? 1.0 + physics::expm1_of(x) : 1.0 / (1.0 + physics::expm1_of(-x));
}

/// Standard normal but for its tails, which end at 6: the sum of twelve uniform numbers.
double normal(RandomStream& random) {
  double sum = -6.0;
  for (int k = 0; k < 12; ++k) sum += random.uniform();
  return sum;
}

/// Pedestrians walk at 1.34 m/s on average with a standard deviation of 0.26 m/s (Henderson 1971).
double walking_speed(RandomStream& random) {
  return std::clamp(1.34 + 0.26 * normal(random), 0.5, 2.2);
}

/// A duration whose probability falls with its square, from `low` to `high` [s]: pause times follow
/// truncated power laws (Rhee et al. 2011; Lee et al. 2009 take the exponent of density 2).
double pause_s(RandomStream& random, double low, double high) {
  return 1.0 / random.uniform(1.0 / high, 1.0 / low);
}

/// An agent under way, which stays within the square and ends where the trace does.
class Walker {
 public:
  Walker(const TraceModel& model, std::uint32_t number, const Vector2& place) : model_(model) {
    agent_.id = std::to_string(number);
    agent_.points.push_back({0.0, place.x(), place.y()});
  }
  bool is_over() const { return here().time_s >= model_.duration_s; }
  Vector2 place() const { return {here().x, here().y}; }
  double now_s() const { return here().time_s; }

  void wait_until(double instant_s) {
    instant_s = std::min(instant_s, model_.duration_s);
    if (instant_s > now_s()) agent_.points.push_back({instant_s, here().x, here().y});
  }
  /// Goes to `target`, as far as it gets.
  void go(const Vector2& target, double takes_s) {
    if (is_over() || !(takes_s > 0.0) || now_s() + takes_s <= now_s()) return;
    const double part = (model_.duration_s - now_s()) / takes_s;
    if (part >= 1.0) return arrive(std::min(now_s() + takes_s, model_.duration_s), target);
    const Vector2 there = place() + part * (target - place());
    arrive(model_.duration_s, there);
  }
  Agent take() {
    wait_until(model_.duration_s);
    return std::move(agent_);
  }

 private:
  const TracePoint& here() const { return agent_.points.back(); }
  void arrive(double instant_s, const Vector2& there) {
    agent_.points.push_back({instant_s, there.x(), there.y()});
  }
  const TraceModel& model_;
  Agent agent_;
};

/// The agents that have been drawn. One has a point in a second at most, so it is early enough to
/// count after each.
class DrawnAgents {
 public:
  explicit DrawnAgents(const TraceModel& model) : model_(model) {}
  void add(Agent agent) {
    points_ += agent.points.size();
    if (points_ > model_.points_max)
      throw game::SceneError("model " + model_.name + ": more than " +
                             std::to_string(model_.points_max) +
                             " points: expected fewer agents, or a shorter duration_s");
    agents_.push_back(std::move(agent));
  }
  std::vector<Agent> take() { return std::move(agents_); }

 private:
  const TraceModel& model_;
  std::vector<Agent> agents_;
  std::size_t points_ = 0;
};

Vector2 anywhere(RandomStream& random, double side) {
  const double x = random.uniform(0.0, side), y = random.uniform(0.0, side);
  return {x, y};
}

Vector2 within(const Vector2& place, double side) {
  return place.cwiseMax(Vector2(0.0, 0.0)).cwiseMin(Vector2(side, side));
}

/// A place near `middle`, normally distributed along both axes.
Vector2 near(RandomStream& random, const Vector2& middle, double deviation, double side) {
  const double x = normal(random), y = normal(random);
  return within(middle + deviation * Vector2(x, y), side);
}

/// Hot spots are as popular as the inverse of their rank (Bharambe, Pang and Seshan 2006; Pittman
/// and GauthierDickey 2007). There are as many as the square root of the agents, each 1/40 of the
/// side wide, and pauses last 2 to 600 s: ours.
std::vector<Agent> hotspots(const TraceModel& model, RandomStream& random) {
  const auto spot_count = static_cast<std::uint32_t>(
      std::max(1.0, std::round(std::sqrt(static_cast<double>(model.count)))));
  std::vector<Vector2> spots;
  std::vector<double> popular_below;
  for (std::uint32_t rank = 1; rank <= spot_count; ++rank) {
    spots.push_back(anywhere(random, model.side));
    popular_below.push_back((popular_below.empty() ? 0.0 : popular_below.back()) + 1.0 / rank);
  }
  const auto place = [&] {
    const double drawn = random.uniform(0.0, popular_below.back());
    const auto spot = std::min<std::ptrdiff_t>(
        std::ranges::upper_bound(popular_below, drawn) - popular_below.begin(), spot_count - 1);
    return near(random, spots[static_cast<std::size_t>(spot)], model.side / 40.0, model.side);
  };
  DrawnAgents agents(model);
  for (std::uint32_t number = 0; number < model.count; ++number) {
    Walker walker(model, number, place());
    const double speed = walking_speed(random);
    // Those who begin in a pause are in its middle.
    walker.wait_until(pause_s(random, 2.0, 600.0) * random.uniform());
    while (!walker.is_over()) {
      const Vector2 target = place();
      walker.go(target, (target - walker.place()).norm() / speed);
      walker.wait_until(walker.now_s() + pause_s(random, 2.0, 600.0));
    }
    agents.add(walker.take());
  }
  return agents.take();
}

/// A flash crowd grows, lasts and shrinks, in phases of linear change (Ari et al. 2003). It stands
/// at 0.65 m^2 a person, where people begin to touch (Fruin 1971). Four of five come, from 1/5 of
/// the time on within a tenth of it, and begin to go at 7/10 within a fifth: ours.
std::vector<Agent> flash_crowd(const TraceModel& model, RandomStream& random) {
  constexpr double part_coming = 0.8, area_each = 0.65;
  const Vector2 event = 0.5 * Vector2(model.side, model.side);
  const double radius = std::min(
      0.5 * model.side, std::sqrt(part_coming * model.count * area_each / std::numbers::pi));
  DrawnAgents agents(model);
  for (std::uint32_t number = 0; number < model.count; ++number) {
    const Vector2 home = anywhere(random, model.side);
    Walker walker(model, number, home);
    const double speed = walking_speed(random), comes_s = random.uniform(0.2, 0.3),
                 goes_s = random.uniform(0.7, 0.9);
    const Vector2 target = event + radius * random.in_disc();
    if (random.coin(part_coming)) {
      const double takes_s = (target - home).norm() / speed;
      walker.wait_until(comes_s * model.duration_s);
      walker.go(target, takes_s);
      walker.wait_until(goes_s * model.duration_s);
      walker.go(home, takes_s);
    }
    agents.add(walker.take());
  }
  return agents.take();
}

/// A distance between home and work, of density (d + 1500 m)^-1.75 exp(-d / 400 km) up to `most`
/// (Gonzalez, Hidalgo and Barabasi 2008).
double commute(RandomStream& random, double most) {
  while (true) {
    const double distance = random.uniform(0.0, most);
    if (random.coin(power((distance + 1500.0) / 1500.0, -1.75) *
                    (1.0 + physics::expm1_of(-distance / 400e3))))
      return distance;
  }
}

/// Homes are anywhere, work is a commute away. Travel times are those of flight_time_s(). They go
/// at a quarter of the time, and back at three quarters, with a standard deviation of 1/20: ours.
std::vector<Agent> commuters(const TraceModel& model, RandomStream& random) {
  DrawnAgents agents(model);
  const double deviation_s = model.duration_s / 20.0;
  for (std::uint32_t number = 0; number < model.count; ++number) {
    const Vector2 home = anywhere(random, model.side);
    Vector2 work = home;
    do {
      work = home + commute(random, model.side) * random.direction();
    } while (within(work, model.side) != work);
    Walker walker(model, number, home);
    const double takes_s = flight_time_s((work - home).norm());
    const double goes_s = 0.25 * model.duration_s + deviation_s * normal(random),
                 back_s = 0.75 * model.duration_s + deviation_s * normal(random);
    walker.wait_until(goes_s);
    walker.go(work, takes_s);
    walker.wait_until(back_s);
    walker.go(home, takes_s);
    agents.add(walker.take());
  }
  return agents.take();
}

using Draw = std::vector<Agent> (*)(const TraceModel&, RandomStream&);
const std::map<std::string, Draw>& models() {
  static const std::map<std::string, Draw> all{
      {"hotspots", hotspots}, {"flash-crowd", flash_crowd}, {"commuters", commuters}};
  return all;
}

}  // namespace

double flight_time_s(double distance) {
  assert(distance >= 0.0);
  if (distance == 0.0) return 0.0;
  return distance < 500.0 ? 30.55 * power(distance, 0.11) : 0.76 * power(distance, 0.72);
}

double default_side(std::uint32_t count) { return 5.0 * std::sqrt(static_cast<double>(count)); }

std::vector<std::string> trace_models() {
  std::vector<std::string> names;
  for (const auto& [name, draw] : models()) names.push_back(name);
  return names;
}

MobilityTrace drawn_trace(const TraceModel& model) {
  assert(model.count > 0 && model.duration_s > 0.0 && model.side >= 0.0);
  TraceModel sized = model;
  if (sized.side == 0.0) sized.side = default_side(model.count);
  RandomStream random(model.seed);
  MobilityTrace trace{.agents = models().at(model.name)(sized, random),
                      .begin_s = 0.0,
                      .end_s = model.duration_s,
                      .low = {0.0, 0.0},
                      .high = {sized.side, sized.side}};
  assert(trace.agents.size() == model.count);
  return trace;
}

}  // namespace rink::loadgen
