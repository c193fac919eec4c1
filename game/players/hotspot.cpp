// Draws hot places from the seed alone, so that all players agree on them without messages.
#include "game/players/hotspot.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "im/basics/checked.h"

namespace rink::game {
namespace {

constexpr std::uint64_t places_stream =
    0x706c61636573;  // apart from the streams of players, which are their numbers

}  // namespace

HotPlaces::HotPlaces(const physics::Field& field, std::uint64_t seed) {
  constexpr double pi = 3.14159265358979323846;
  RandomStream random(seed, places_stream);
  const double area = field.length * field.width;
  radius_ =
      std::min(std::sqrt(area_fraction * area / pi), 0.25 * std::min(field.length, field.width));
  const auto count =
      static_cast<std::size_t>(std::clamp(std::floor(area / area_per_place), 3.0, 1000.0));
  const Reach inner{Vector2::Constant(radius_),
                    Vector2(field.length, field.width) - Vector2::Constant(radius_)};
  double sum = 0.0;
  for (std::size_t place = 0; place < count; ++place) {
    centres_.push_back(anywhere(inner, random));
    cumulative_.push_back(sum += 1.0 / static_cast<double>(place + 1));
  }
  if constexpr (checks_whole_structures) check();
}

void HotPlaces::check() const {
  assert(centres_.size() == cumulative_.size());
  for (std::size_t place = 1; place < cumulative_.size(); ++place)
    assert(cumulative_[place] > cumulative_[place - 1] && weight(place) < weight(place - 1));
}

double HotPlaces::weight(std::size_t place) const {
  assert(place < centres_.size());
  return 1.0 / static_cast<double>(place + 1) / cumulative_.back();
}

std::size_t HotPlaces::choose(RandomStream& random) const {
  const double drawn = random.uniform(0.0, cumulative_.back());
  const auto place =
      std::upper_bound(cumulative_.begin(), cumulative_.end(), drawn) - cumulative_.begin();
  return std::min(static_cast<std::size_t>(place), centres_.size() - 1);
}

Vector2 HotPlaces::point_in(std::size_t place, RandomStream& random) const {
  assert(place < centres_.size());
  return centres_[place] + radius_ * random.in_disc();
}

Hotspot::Hotspot(const PlayerRules& rules, const PlayerSeat& seat, std::uint64_t seed)
    : random_(seed, seat.number), places_(rules.field, seed), traveller_(rules, seat) {}

Vector2 Hotspot::next_target() {
  if (!place_ || random_.uniform() >= lingering)
    place_ = random_.uniform() < attraction ? std::optional(places_.choose(random_)) : std::nullopt;
  return place_ ? places_.point_in(*place_, random_) : anywhere(traveller_.reach(), random_);
}

KeysHeld Hotspot::decide(const PlayerView& view, double instant) {
  if (traveller_.needs_target(view, instant, random_))
    traveller_.go_to(next_target(), view, instant, random_);
  return hands_.hold(traveller_.travel(view, hands_.last_wish()), view.velocity, random_);
}

}  // namespace rink::game
