// Checks the messages of other peers once, on receipt.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "game/peer/messages.h"
#include "game/peer/session/loss.h"
#include "game/peer/session/part_change.h"
#include "game/peer/session/scoring.h"
#include "game/peer/start.h"

namespace rink::peer {

/// The constant properties of a body.
struct BodyConstants {
  double radius = 0.0, mass = 1.0, inverse_mass = 1.0;  ///< m, kg, 1/kg
  Vector2 half_extent{0.0, 0.0};                        ///< m
  physics::BodyKind kind = physics::BodyKind::puck;
  physics::MaterialId material = 0;
  physics::Half half = physics::Half::both;

  static BodyConstants of(const BodyState& state);
  friend bool operator==(const BodyConstants&, const BodyConstants&) = default;
};

/// Whether one of the contacts holds the body along axis 0 or 1.
bool is_held_by(const std::vector<RestContact>& rest_contacts, std::uint32_t body, int axis);

/// Knows the scene, so that it detects what no honest peer sends: unknown bodies, NaN, bodies with
/// another radius, mass, material or kind than in the scene. Claims and digests detect messages
/// that are possible but false (docs/peer-to-peer.md).
class Validator {
 public:
  explicit Validator(const Start& start);

  bool has_body(std::uint32_t number) const { return number < body_count_; }
  std::uint32_t body_count() const { return body_count_; }
  /// The body, which must be there, with what the scene gives it and nothing else: it lies still in
  /// the field's corner.
  BodyState still(std::uint32_t number) const;

  /// The fault of a message, as in "hands over body 7 at no place"; empty if there is none. `now`
  /// [s] is the instant of its states, `end` [s] the end of its window.
  std::string fault_of(const Handover& message, double now) const;
  std::string fault_of(const Claims& message, double end) const;
  std::string fault_of(const Verdict& message) const;
  std::string fault_of(const PartChange& message, double now) const;
  std::string fault_of(const FaceOffWord& message, double now) const;
  std::string fault_of(const Loss& message) const;
  std::string fault_of(const std::vector<Key>& keys) const;
  /// Of keys that took effect until `now` [s].
  std::string fault_of_log(const std::vector<Key>& log, double now) const;
  std::string fault_of(const Press& press) const;
  /// Of what is sent when all is over, without contacts.
  std::string fault_of_last(const Handover& message, double now) const;
  /// Of all that a part has: a ghost in it may lean on a post that is too far away to be there.
  std::string fault_of_part(const Handover& message, double now) const;

 private:
  std::string fault_of(const Handover::Body& body, double now) const;
  std::string fault_of(const FreeFlightState& free_flights, double now) const;
  std::string fault_of(const RestContact& rest) const;
  std::string fault_of(const Key& key) const;
  std::string fault_of(const Observation& observation) const;
  template <class Item, class... Instant>
  std::string first_fault(const std::vector<Item>& list, Instant... now) const;
  bool is_on_its_way(const physics::Motion& motion, double now) const;
  bool is_of_kind(std::uint32_t number, physics::BodyKind kind) const {
    return has_body(number) && constants_of(number).kind == kind;
  }
  const BodyConstants& constants_of(std::uint32_t number) const;
  bool is_place(const Vector2& place) const;
  bool is_drag(double drag) const;

  double puck_drag_ = 0.0;  ///< 1/s
  double drag_max_ = 0.0;   ///< of any body [1/s]
  double glide_max_ = 0.0;  ///< s
  double reach_ = 0.0;      ///< no coordinate lies farther from the field's corner [m]
  std::size_t material_count_ = 0;
  std::uint32_t body_count_ = 0;
  std::vector<BodyConstants> constants_;  ///< each once: a scene has few
  /// Of body `first` and all up to the next run: bodies alike stand side by side.
  struct Run {
    std::uint32_t first, constants;
  };
  std::vector<Run> runs_;
};

}  // namespace rink::peer
