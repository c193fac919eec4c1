// Long random sequences of moves, arrivals, removals and returns, each match judged by brute force.
#pragma once

#include <gtest/gtest.h>

#include <array>

#include "tests/im/layouts.h"
#include "tests/im/recount.h"

namespace rink::im {

/// Along an axis or a diagonal, anywhere, or nowhere.
inline Heading draw_heading(Random& random) {
  const int kind = static_cast<int>(between(random, 0.0, 8.0));
  const double x = between(random, -1.0, 1.0), y = between(random, -1.0, 1.0);
  if (kind == 0) return {};
  return kind < 5 ? Heading{std::round(1.4 * x), std::round(1.4 * y)} : Heading{x, y};
}

inline Role draw_role(Random& random) {
  const auto number = [&random] {
    const double drawn = std::floor(between(random, 0.0, 5.0));
    return drawn == 0.0   ? Role::none
           : drawn == 1.0 ? Role::none - 1u
                          : static_cast<std::uint32_t>(drawn);
  };
  Role role{.team = number(), .owner = 0, .is_always_relevant = false};
  role.owner = number();
  role.is_always_relevant = between(random, 0.0, 1.0) < 0.2;
  return role;
}

/// A round of what may happen between two matches; `activity` is the share of ids that something
/// happens to.
inline void disturb(Judged& judged, Random& random, const Layout& layout, double activity) {
  constexpr std::uint32_t entity_max = 60, subscriber_max = 15;
  constexpr double entity_half = 0.5, subscriber_half = 3.0;
  const auto happens = [&](double probability) { return between(random, 0.0, 1.0) < probability; };
  for (Entity entity = 0; entity < entity_max; ++entity) {
    if (!happens(activity)) continue;
    if (happens(0.1)) judged.remove_entity(entity);
    const auto found = judged.entities().find(entity);
    if (found != judged.entities().end())
      judged.move_entity(entity, moved(random, found->second, layout, entity_half));
    else if (happens(0.5)) judged.move_entity(entity, layout.draw(random, entity_half));
    if (happens(0.2)) judged.take_role(entity, draw_role(random));
  }
  for (Subscriber subscriber = 0; subscriber < subscriber_max; ++subscriber) {
    if (!happens(activity)) continue;
    if (happens(0.1)) judged.remove_subscriber(subscriber);
    const auto found = judged.subscribers().find(subscriber);
    if (found != judged.subscribers().end())
      judged.move_subscriber(subscriber, moved(random, found->second, layout, subscriber_half));
    else if (happens(0.5)) judged.move_subscriber(subscriber, layout.draw(random, subscriber_half));
    if (happens(0.2)) judged.join(subscriber, draw_role(random));
    if (happens(0.2)) judged.turn(subscriber, draw_heading(random));
  }
}

/// Angles and posts that touch a lattice, and others.
inline FilterSettings settings_for(std::uint64_t seed) {
  constexpr std::array half_angles{45.0, 60.0, 90.0, 135.0, 17.0, 180.0, 0.0, 120.0, 100.0, 179.5};
  FilterSettings settings{.world = {0.0, 0.0, side, side},
                          .cell_size = seed % 2 == 0 ? 1.0 : 0.7,
                          .half_angle_deg = half_angles[seed % half_angles.size()]};
  // No ratio of quarters comes near the awareness, which decides ties between rounded numbers.
  constexpr std::array awarenesses{0.0, 0.31415926535897931};
  settings.nimbus_radius = seed % 3 == 0 ? 0.0 : seed % 3 == 1 ? 1.25 : 4.0;
  settings.awareness = awarenesses[seed / 3 % awarenesses.size()];
  settings.tile_steps = static_cast<std::uint32_t>(seed % 6);
  settings.posts = {{2.0, 2.0, 1.0},   {4.0, 4.0, 0.5},  {8.0, 8.25, 1.5},
                    {12.0, 3.0, 0.25}, {5.0, 12.0, 2.0}, {1.0, 0.5, 0.0}};
  Random random(seed);
  for (int i = 0; i < 4; ++i) {
    const double x = between(random, 0.0, side), y = between(random, 0.0, side);
    settings.posts.push_back({x, y, between(random, 0.0, 1.0)});
  }
  return settings;
}

/// `make` gives a fresh `Judged` for each layout.
template <class Make>
void play(std::uint64_t seed, int matches, const Make& make) {
  for (const Layout& layout : layouts) {
    SCOPED_TRACE(std::string("on ") + layout.name + " with seed " + std::to_string(seed));
    Random random(seed);
    Judged judged = make();
    for (int i = 0; i < matches; ++i) {
      constexpr std::array activities{1.0, 0.3, 0.05};
      disturb(judged, random, layout, activities[static_cast<std::size_t>(i) % activities.size()]);
      if (i % 7 == 3) disturb(judged, random, layout, 0.5);  // several moves between two matches
      judged.check_match();
      if (testing::Test::HasFatalFailure()) return;
    }
  }
}

}  // namespace rink::im
