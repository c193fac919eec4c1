// Players drawn to a few hot places, as crowds of virtual worlds are: the popularity of places
// follows Zipf's law.
#pragma once

#include <optional>
#include <vector>

#include "game/players/waypoint.h"

namespace rink::game {

/// The hot places of all players of one seed: place k, counted from 1, is chosen with probability
/// proportional to 1/k.
class HotPlaces {
 public:
  /// One place per `area_per_place` of the field, 3 to 1,000 of them; each a disc that is
  /// `area_fraction` of the field.
  HotPlaces(const physics::Field& field, std::uint64_t seed);

  static constexpr double area_per_place = 25.0;  ///< m^2
  static constexpr double area_fraction = 0.02;

  const std::vector<Vector2>& centres() const { return centres_; }
  double radius() const { return radius_; }  ///< m
  /// The share of visits that go to place `place`.
  double weight(std::size_t place) const;
  /// The number of a place, chosen by weight.
  std::size_t choose(RandomStream& random) const;
  /// A point in that hot disc, uniform within it.
  Vector2 point_in(std::size_t place, RandomStream& random) const;

  /// Asserts that every place has a weight, the earlier the more.
  void check() const;

 private:
  std::vector<Vector2> centres_;
  std::vector<double> cumulative_;
  double radius_;
};

/// Travels like Waypoint, but four journeys of five lead to a hot place, within which it then makes
/// three more trips on average: people linger where it is hot.
class Hotspot : public Player {
 public:
  static constexpr double attraction = 0.8, lingering = 0.75;

  Hotspot(const PlayerRules& rules, const PlayerSeat& seat, std::uint64_t seed);
  KeysHeld decide(const PlayerView& view, double instant) override;

 private:
  Vector2 next_target();
  RandomStream random_;
  HotPlaces places_;
  std::optional<std::size_t> place_;  ///< its place or target, if that is hot
  Traveller traveller_;
  Hands hands_;
};

}  // namespace rink::game
