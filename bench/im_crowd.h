// The crowd that whole passes of interest management are timed on, and the table that their changes
// are replayed into.
#pragma once

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <random>
#include <span>
#include <vector>

#include "im/filter.h"

namespace rink::bench {

/// A crowd on a square field: pucks of 4 cm radius at five per square metre that move 1 m/s, and
/// subscriptions of 5 % of the field that follow bats.
struct Crowd {
  struct Mover {
    double x, y, dx, dy;
  };
  Crowd(std::uint32_t subscriber_count, std::uint32_t object_count, double rate_hz)
      : side(std::sqrt(object_count / 5.0)) {
    assert(object_count > 0 && rate_hz > 0.0);
    std::mt19937_64 random(42);
    std::uniform_real_distribution<double> place(0.0, side), angle(0.0, 6.283185307179586);
    const auto draw = [&] {
      const double a = angle(random);
      return Mover{place(random), place(random), std::cos(a) / rate_hz, std::sin(a) / rate_hz};
    };
    std::generate_n(std::back_inserter(objects), object_count, draw);
    std::generate_n(std::back_inserter(subscribers), subscriber_count, draw);
  }

  /// Moves `share` of all on, a different share each tick, reflected at the walls.
  void step(double share) {
    assert(0.0 < share && share <= 1.0);
    const auto stride = static_cast<std::size_t>(std::lround(1.0 / share));
    for (std::vector<Mover>* movers : {&objects, &subscribers})
      for (std::size_t i = tick % stride; i < movers->size(); i += stride) advance((*movers)[i]);
    ++tick;
  }
  void advance(Mover& mover) const {
    mover.x += mover.dx;
    mover.y += mover.dy;
    if (mover.x < 0.0 || mover.x > side) mover.dx = -mover.dx;
    if (mover.y < 0.0 || mover.y > side) mover.dy = -mover.dy;
  }

  static im::Region around(const Mover& mover, double half) {
    return {mover.x - half, mover.y - half, mover.x + half, mover.y + half};
  }
  im::Region update(std::size_t i) const { return around(objects[i], 0.04); }
  im::Region subscription(std::size_t i) const { return around(subscribers[i], half_interest()); }
  double half_interest() const { return 0.5 * side * std::sqrt(0.05); }

  void tell(im::Filter& filter) const {
    for (std::uint32_t i = 0; i < objects.size(); ++i) filter.set_update_region(i, update(i));
    for (std::uint32_t i = 0; i < subscribers.size(); ++i)
      filter.set_subscription_region(i, subscription(i));
  }

  double side;
  std::vector<Mover> objects, subscribers;
  std::size_t tick = 0;
};

/// Interest as a table, subscriber by subscriber, either replayed from changes or counted anew: 0,
/// or 1 + tier.
using Table = std::vector<std::uint8_t>;

/// Returns how many of `changes` are no news: they enter who was in, or tell of who was not.
inline std::size_t replay(std::span<const im::Change> changes, std::size_t object_count,
                          Table& table) {
  std::size_t wrong = 0;
  for (const im::Change& change : changes) {
    assert(change.entity < object_count);
    assert(change.subscriber * object_count + change.entity < table.size());
    std::uint8_t& place = table[change.subscriber * object_count + change.entity];
    wrong += (place == 0) != (change.transition == im::Transition::entered) ? 1u : 0u;
    place = change.transition == im::Transition::left ? std::uint8_t{0}
                                                      : static_cast<std::uint8_t>(1 + change.tier);
  }
  return wrong;
}

}  // namespace rink::bench
