// Trails are the ways themselves, sparks fly out of contacts, and pucks turn as one that grips
// would.
#include "game/view/feel/impact_effects.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

namespace rink::view {
namespace {

constexpr std::size_t pucks_max = 8;      ///< in a crowd nobody would see them
constexpr double slow = 0.5, fast = 3.0;  ///< m/s: below there is no trail, above it is brightest
constexpr double sparks_from = 1.0;       ///< m/s that an impact changes the velocity by
constexpr double spark_drag_s = 0.12, spin_drag_s = 2.0;
constexpr double leap = 0.3;  ///< m: a puck that was put elsewhere
constexpr Colour spark_colour{1.0f, 0.42f, 0.05f, 1.0f}, trail_colour{1.0f, 0.60f, 0.10f, 1.0f};

bool is_impact(Noise::Kind kind) { return kind <= Noise::Kind::puck_on_puck; }

/// Whether `b` is on the straight way from `a` to `c`. Who returns on its own way turns at `b`.
bool is_on_way(const Vector2& a, const Vector2& b, const Vector2& c) {
  constexpr double off_max = 5e-4;  // m
  const Vector2 way = c - a;
  const double length = way.norm();
  if (length < 1e-9) return (b - a).norm() < off_max;
  return (b - a).dot(c - b) >= 0.0 &&
         std::abs(way.x() * (b - a).y() - way.y() * (b - a).x()) / length < off_max;
}

}  // namespace

void ImpactEffects::look(const MatchSight& sight, double now_s) {
  assert(!has_begun_ || now_s >= now_s_);
  const double elapsed = std::exchange(has_begun_, true) ? now_s - now_s_ : 0.0;
  now_s_ = now_s;
  const auto is_puck = [](const Thing& thing) { return thing.kind == physics::BodyKind::puck; };
  if (!sight.goals_to_win ||
      static_cast<std::size_t>(std::ranges::count_if(sight.things, is_puck)) > pucks_max) {
    pucks_.clear(), sparks_.clear();
    return;
  }
  for (Puck& puck : pucks_) puck.place.reset();
  std::size_t place = 0;
  for (const Thing& thing : sight.things)
    if (is_puck(thing)) follow(thing, elapsed).place = place++;
  std::erase_if(pucks_, [](const Puck& puck) { return !puck.place; });
  std::ranges::sort(pucks_, {}, [](const Puck& puck) { return *puck.place; });
  std::erase_if(sparks_, [now_s](const Spark& spark) { return now_s > spark.born + spark_s; });
  for (const Noise& noise : sight.noises) {
    if (noise.kind == Noise::Kind::goal) nudge_ = 0.011, nudged_s_ = now_s;
    if (!is_impact(noise.kind)) continue;
    if (noise.strength > 0.8 && now_s > nudged_s_ + nudge_s) nudge_ = 0.003, nudged_s_ = now_s;
    const auto puck = std::ranges::find_if(sight.things, [&](const Thing& thing) {
      return is_puck(thing) && thing.position == noise.at;
    });
    if (puck != sight.things.end()) fly(noise, *puck);
  }
}

/// Pucks fly straight, so that corners are enough of the way.
ImpactEffects::Puck& ImpactEffects::follow(const Thing& thing, double elapsed_s) {
  auto found = std::ranges::find(pucks_, thing.id, &Puck::id);
  if (found == pucks_.end()) {
    pucks_.push_back({.id = thing.id, .way = {}});
    found = pucks_.end() - 1;
  }
  Puck& puck = *found;
  puck.radius = thing.half_extent.x();
  puck.spin = thing.spin != 0.0 ? thing.spin : puck.spin * std::exp(-elapsed_s / spin_drag_s);
  puck.angle = std::remainder(puck.angle + puck.spin * elapsed_s, 6.283185307179586);
  std::vector<Place>& way = puck.way;
  if (!way.empty() && (thing.position - way.back().at).norm() > leap) way.clear();
  if (way.size() >= 2 && is_on_way(way[way.size() - 2].at, way.back().at, thing.position) &&
      way.back().time - way[way.size() - 2].time < 0.1)
    way.pop_back();
  way.push_back({thing.position, now_s_});
  while (way.size() > 2 && way[1].time < now_s_ - trail_s) way.erase(way.begin());
  return puck;
}

/// Sparks fly from the contact, more and faster ones from a harder hit. A rough disc that hits
/// something and stops sliding loses a third of its velocity along the contact and then turns with
/// two thirds of it at its rim (a uniform disc, from the balance of momenta).
void ImpactEffects::fly(const Noise& noise, const Thing& puck) {
  const double change = noise.change.norm(), radius = puck.half_extent.x();
  if (change <= 0.0) return;
  const Vector2 away = noise.change / change, along(-away.y(), away.x());
  const auto known = std::ranges::find(pucks_, puck.id, &Puck::id);
  if (puck.spin == 0.0 && known != pucks_.end() && radius > 0.0)
    known->spin = std::clamp(2.0 / 3.0 * puck.velocity.dot(along) / radius, -60.0, 60.0);
  if (change < sparks_from) return;
  const auto count = static_cast<int>(std::min(14.0, 2.0 + 3.0 * change));
  for (int i = 0; i < count && sparks_.size() < sparks_max; ++i) {
    const double aside = random_.uniform(-1.3, 1.3),
                 speed = std::min(change, 5.0) * random_.uniform(0.15, 0.6);
    sparks_.push_back({noise.at - away * radius,
                       speed * (std::cos(aside) * away + std::sin(aside) * along), now_s_});
  }
}

void ImpactEffects::add_trail(const Puck& puck, Picture& picture) const {
  for (std::size_t k = 1; k < puck.way.size(); ++k) {
    const Place &older = puck.way[k - 1], &newer = puck.way[k];
    const double took = newer.time - older.time;
    if (took <= 0.0) continue;
    const double speed = (newer.at - older.at).norm() / took;
    if (speed < slow) continue;
    const double from = std::max(older.time, now_s_ - trail_s);
    if (newer.time <= from) continue;
    const Vector2 end = older.at + (newer.at - older.at) * ((from - older.time) / took);
    const auto left = [this](double time) { return 1.0 - (now_s_ - time) / trail_s; };
    const double bright = 0.5 * std::min(1.0, (speed - slow) / (fast - slow));
    picture.streaks.push_back(
        {.x = static_cast<float>(newer.at.x()),
         .y = static_cast<float>(newer.at.y()),
         .end_x = static_cast<float>(end.x()),
         .end_y = static_cast<float>(end.y()),
         .half_width = static_cast<float>(puck.radius * (0.25 + 0.65 * left(newer.time))),
         .end_half_width = static_cast<float>(puck.radius * (0.25 + 0.65 * left(from))),
         .fading = static_cast<float>(left(from) / std::max(1e-6, left(newer.time))),
         .colour = faded(trail_colour, static_cast<float>(bright * left(newer.time)))});
  }
}

void ImpactEffects::add_sparks(Picture& picture) const {
  for (const Spark& spark : sparks_) {
    const double age = now_s_ - spark.born;
    const auto place = [&](double t) -> Vector2 {
      return spark.from +
             spark.velocity * (spark_drag_s * (1.0 - std::exp(-std::max(0.0, t) / spark_drag_s)));
    };
    const Vector2 head = place(age + 0.01), tail = place(age - 0.02);
    Colour colour = spark_colour;
    colour.alpha = static_cast<float>(1.0 - age / spark_s);
    picture.streaks.push_back({.x = static_cast<float>(head.x()),
                               .y = static_cast<float>(head.y()),
                               .end_x = static_cast<float>(tail.x()),
                               .end_y = static_cast<float>(tail.y()),
                               .half_width = 0.006f,
                               .end_half_width = 0.004f,
                               .fading = 0.2f,
                               .colour = colour});
  }
}

void ImpactEffects::add_to(Picture& picture) const {
  for (const Puck& puck : pucks_) add_trail(puck, picture);
  add_sparks(picture);
  const auto is_puck = [](const Piece& piece) { return piece.shape == Piece::Shape::puck; };
  std::size_t next = 0;  // both are in the order of the sight's things
  for (Piece& piece : picture.pieces)
    if (is_puck(piece) && next < pucks_.size())
      piece.angle = static_cast<float>(pucks_[next++].angle);
  const double since = now_s_ - nudged_s_;
  if (nudged_s_ < 0.0 || since >= nudge_s) return;
  const double part = 1.0 - since / nudge_s;
  picture.nudge_x = static_cast<float>(nudge_ * part * part * std::sin(55.0 * since));
  picture.nudge_y = static_cast<float>(0.6 * nudge_ * part * part * std::cos(43.0 * since));
}

}  // namespace rink::view
