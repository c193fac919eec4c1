// What a message of another peer must keep to, whoever sent it: checked once, where it is received.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "game/peer/messages.h"
#include "game/peer/session/loss.h"
#include "game/peer/session/part_replica.h"
#include "game/peer/session/scoring.h"

namespace rink::peer {

/// What nothing that happens in a game changes of a body.
struct BodyConstants {
  double radius = 0.0, mass = 1.0, inverse_mass = 1.0;  ///< m, kg, 1/kg
  Vector2 half_extent{0.0, 0.0};                        ///< m
  physics::BodyKind kind = physics::BodyKind::puck;
  physics::MaterialId material = 0;
  physics::Half half = physics::Half::both;

  static BodyConstants of(const BodyState& state);
  friend bool operator==(const BodyConstants&, const BodyConstants&) = default;
};

/// Knows the scene, so that it can tell what no honest peer says: numbers of bodies that do not
/// exist, numbers that are none, bodies with another radius, mass, material or kind than the scene
/// gives them. What could be true, and is not, is not seen here: claims and digests tell of that
/// (docs/peer-to-peer.md).
class Validator {
 public:
  explicit Validator(const physics::World& world);

  /// What is wrong with the message, as in "hands over body 7 at no place"; empty if nothing is.
  /// `now` [s] is the instant of the states in it, `end` [s] that of the window of which it tells.
  std::string fault_of(const Handover& message, double now) const;
  std::string fault_of(const Claims& message, double end) const;
  std::string fault_of(const Verdict& message) const;
  std::string fault_of(const PartChange& message, double now) const;
  std::string fault_of(const FaceOffWord& message, double now) const;
  std::string fault_of(const Loss& message) const;
  std::string fault_of(const std::vector<Key>& log) const;

 private:
  std::string fault_of(const Handover::Body& body, double now) const;
  std::string fault_of(const FreeFlightState& free_flights, double now) const;
  std::string fault_of(const RestContact& rest) const;
  std::string fault_of(const Key& key) const;
  std::string fault_of(const Observation& observation) const;
  template <class Item, class... Instant>
  std::string first_fault(const std::vector<Item>& list, Instant... now) const;
  bool is_on_its_way(const physics::Motion& motion, double now) const;
  bool is_body(std::uint32_t number) const { return number < constants_of_.size(); }
  bool is_of_kind(std::uint32_t number, physics::BodyKind kind) const {
    return is_body(number) && constants_[constants_of_[number]].kind == kind;
  }
  bool is_place(const Vector2& place) const;

  double puck_drag_ = 0.0;  ///< 1/s
  double reach_ = 0.0;      ///< no coordinate lies farther from the field's corner [m]
  std::size_t material_count_ = 0;
  std::vector<BodyConstants> constants_;     ///< each once: a scene has few
  std::vector<std::uint32_t> constants_of_;  ///< by body
};

}  // namespace rink::peer
