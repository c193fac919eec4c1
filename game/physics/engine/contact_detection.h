// Who touches whom, and where.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <vector>

#include "game/physics/bodies/bodies.h"
#include "game/physics/bodies/contact.h"
#include "game/physics/bodies/partner.h"
#include "game/physics/body.h"
#include "game/physics/grid/cell_grid.h"
#include "game/physics/real.h"

namespace rink::physics::inline RINK_PRECISION {

/// Only looks. Bodies are where their laws have brought them at the time that is asked about.
class ContactDetection {
 public:
  ContactDetection(const WorldSpec& spec, const Bodies& bodies, const CellGrid& grid);
  ContactDetection(const ContactDetection&) = delete;
  ContactDetection& operator=(const ContactDetection&) = delete;

  Contact contact(std::uint32_t body, Partner partner, Real time) const;
  /// That contact if its gap is at most `gap` [m]: most who are near are farther, and do not take
  /// long.
  std::optional<Contact> contact_within(std::uint32_t body, Partner partner, Real gap,
                                        Real time) const;
  Real restitution(std::uint32_t body, Partner partner) const;
  /// Calls `visit(partner)` for everybody that `body` may touch, in an order that depends on ids
  /// alone: bodies near it, walls, and whatever else of the field concerns it. `visit` must not
  /// look for partners itself.
  template <class Visit>
  void visit_partners(std::uint32_t body, Visit&& visit);
  /// Whether a third body may touch one of the two: never missed, and hardly ever wrong.
  bool has_company(std::uint32_t body, Partner partner, Real time);

 private:
  RealVector position_at(std::uint32_t body, Real time) const;
  bool is_alone(std::uint32_t one, std::uint32_t two, Real time);
  bool has_third(std::uint32_t one, Partner two, Real time);

  const WorldSpec& spec_;
  const Bodies& bodies_;
  const CellGrid& grid_;
  Real puck_drag_;
  std::vector<std::uint32_t> near_;        // the body whose partners are visited
  std::vector<std::uint32_t> candidates_;  // for company
};

template <class Visit>
void ContactDetection::visit_partners(std::uint32_t body, Visit&& visit) {
  near_.clear();
  grid_.around(body, [&](std::uint32_t other) {
    if (other != body) near_.push_back(other);
  });
  std::sort(near_.begin(), near_.end());
  for (const std::uint32_t other : near_) visit(other);
  const bool is_in_mouth = bodies_[body].mouth != Body::no_mouth;
  for (Partner wall = partner::wall_left; wall <= partner::wall_top; ++wall)
    if (!(is_in_mouth && wall <= partner::wall_right)) visit(wall);
  if (spec_.field.bats_keep_to_half && bodies_[body].kind == BodyKind::bat &&
      bodies_.build(body).half != Half::both)
    visit(partner::halfway);
  if (spec_.field.goal_width > 0.0 && bodies_[body].kind == BodyKind::puck)
    for (Partner edge = partner::edge_left_low; edge <= partner::edge_right_high; ++edge)
      visit(edge);
}

}  // namespace rink::physics::inline RINK_PRECISION
