// What lets impacts be felt, as parts of the picture alone: trails behind fast pucks, sparks,
// turning pucks, and a nudge of the camera.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "game/model/random_stream.h"
#include "game/view/match_source.h"
#include "game/view/render/picture.h"

namespace rink::view {

/// Looks at one sight after the other. Pure: the same sights at the same times look the same.
class ImpactEffects {
 public:
  static constexpr double trail_s = 0.3, spark_s = 0.4, nudge_s = 0.35;
  static constexpr std::size_t sparks_max = 96;

  /// Takes up the impacts of `sight`, which is of `now_s` [s] by a clock that goes as the match
  /// does.
  void look(const MatchSight& sight, double now_s);
  /// Into the picture of the last sight, whose pieces are in the order of its things.
  void add_to(Picture& picture) const;

 private:
  struct Place {
    Vector2 at;
    double time;
  };
  struct Puck {
    std::uint32_t id;
    std::vector<Place> way;  ///< corners, and the latest place last
    double angle = 0.0, spin = 0.0;
    double radius = 0.0;
    std::optional<std::size_t> place{};  ///< among the pucks of the last sight, if it is there
  };
  struct Spark {
    Vector2 from, velocity;
    double born;
  };
  Puck& follow(const Thing& thing, double elapsed_s);
  void fly(const Noise& noise, const Thing& puck);
  void add_trail(const Puck& puck, Picture& picture) const;
  void add_sparks(Picture& picture) const;

  std::vector<Puck> pucks_;
  std::vector<Spark> sparks_;
  game::RandomStream random_{1};
  double now_s_ = 0.0, nudged_s_ = -1.0, nudge_ = 0.0;
  bool has_begun_ = false;
};

}  // namespace rink::view
