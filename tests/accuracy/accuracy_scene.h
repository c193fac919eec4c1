// The scenes of scenes/accuracy/ and how their tests say what they measured.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <string>
#include <vector>

#include "game/control/game.h"
#include "game/model/scene_file.h"
#include "tests/places.h"

namespace rink::accuracy {

using game::Game;
using game::Scene;
using physics::BodyId;
using physics::Vector2;
using physics::World;

inline Scene scene_named(const std::string& name) {
  return game::load_scene(test::source_folder() + "/scenes/accuracy/" + name + ".toml");
}

/// Sanitizers look for other mistakes than drift, and take up to thirty times as long.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool is_sanitized = true;
#else
constexpr bool is_sanitized = false;
#endif

/// A game adds posts, then bats, then pucks, in the scene's order.
inline BodyId body_named(const Scene& scene, const std::string& name) {
  std::vector<std::string> names;
  for (const auto& post : scene.bodies.posts) names.push_back(post.name);
  for (const auto& bat : scene.bodies.bats) names.push_back(bat.name);
  for (const auto& puck : scene.bodies.pucks) names.push_back(puck.name);
  const auto place = std::find(names.begin(), names.end(), name);
  EXPECT_NE(place, names.end()) << name;
  return {static_cast<std::uint32_t>(place - names.begin())};
}

/// Prints what was measured beside what is expected (docs/accuracy-suite.md quotes it), and expects
/// it to be at most that.
inline void expect_at_most(const char* what, double measured, double limit) {
  std::printf("    %-52s %.3g (at most %.3g)\n", what, measured, limit);
  EXPECT_LE(measured, limit) << what;
}

/// Likewise of a relative deviation from a formula.
inline void expect_within(const char* what, double measured, double expected, double part) {
  std::printf("    %-52s %.9g (%.9g within %.3g %%): %+.2g %%\n", what, measured, expected,
              100.0 * part, 100.0 * (measured / expected - 1.0));
  EXPECT_LE(std::abs(measured / expected - 1.0), part)
      << what << ": " << measured << " instead of " << expected;
}

inline double largest(const std::vector<double>& values) {
  return *std::max_element(values.begin(), values.end());
}

inline double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace rink::accuracy
