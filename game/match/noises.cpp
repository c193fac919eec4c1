// A puck whose velocity jumped hit the nearest thing.
#include "game/match/noises.h"

#include <algorithm>
#include <cmath>

namespace rink::game {
namespace {

constexpr double quietest = 0.1,
                 loudest = 3.0;  ///< changes of velocity [m/s]: below the first silent, above the
                                 ///< second no louder
constexpr double reach = 0.03;   ///< m: distance from the puck's surface to the thing that it hit,
                                 ///< a frame later

double gap(const Thing& puck, const Thing& other) {
  const Vector2 offset = puck.position - other.position;
  if (other.kind != physics::BodyKind::bat)
    return offset.norm() - puck.half_extent.x() - other.half_extent.x();
  return (offset.cwiseAbs() - other.half_extent).cwiseMax(0.0).norm() - puck.half_extent.x();
}

Noise::Kind kind_of(const Thing& puck, const std::vector<Thing>& things) {
  double nearest = reach;
  Noise::Kind kind = Noise::Kind::puck_on_wall;
  for (const Thing& other : things) {
    const double distance = gap(puck, other);
    if (other.id == puck.id || distance >= nearest) continue;
    nearest = distance;
    kind = other.kind == physics::BodyKind::bat    ? Noise::Kind::puck_on_bat
           : other.kind == physics::BodyKind::post ? Noise::Kind::puck_on_post
                                                   : Noise::Kind::puck_on_puck;
  }
  return kind;
}

}  // namespace

void NoiseDetector::listen(MatchSight& sight) {
  sight.noises.clear();
  if (has_listened_) {
    hear_pucks(sight);
    hear_rules(sight);
  }
  before_ = sight.things;
  score_ = sight.score;
  phase_ = sight.phase;
  count_ =
      sight.phase == MatchPhase::countdown ? static_cast<int>(std::ceil(sight.remaining_s)) : 0;
  has_listened_ = true;
}

void NoiseDetector::hear_pucks(MatchSight& sight) const {
  if (sight.phase != MatchPhase::playing || before_.size() != sight.things.size()) return;
  for (std::size_t k = 0; k < sight.things.size(); ++k) {
    const Thing& puck = sight.things[k];
    if (puck.kind != physics::BodyKind::puck || before_[k].id != puck.id) continue;
    const bool was_put_elsewhere = (puck.position - before_[k].position).norm() > 0.3,
               is_out = puck.position.x() < 0.0 || puck.position.x() > sight.field.length;
    const double change = (puck.velocity - before_[k].velocity).norm();
    if (change < quietest || was_put_elsewhere || is_out) continue;
    sight.noises.push_back({kind_of(puck, sight.things), std::min(1.0, change / loudest),
                            std::clamp(puck.position.x() / sight.field.length, 0.0, 1.0),
                            puck.position, puck.velocity - before_[k].velocity});
  }
}

void NoiseDetector::hear_rules(MatchSight& sight) const {
  using Kind = Noise::Kind;
  const bool is_same_match = sight.score.left >= score_.left && sight.score.right >= score_.right;
  if (sight.score != score_ && is_same_match)
    sight.noises.push_back({Kind::goal, 1.0, sight.score.left > score_.left ? 1.0 : 0.0});
  if (sight.phase == MatchPhase::countdown &&
      static_cast<int>(std::ceil(sight.remaining_s)) != count_)
    sight.noises.push_back({Kind::count, 1.0, 0.5});
  if (sight.phase == MatchPhase::playing && phase_ == MatchPhase::countdown)
    sight.noises.push_back({Kind::face_off, 1.0, 0.5});
  if (sight.phase == MatchPhase::over && phase_ != MatchPhase::over)
    sight.noises.push_back({Kind::win, 1.0, 0.5});
}

}  // namespace rink::game
