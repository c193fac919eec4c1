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
  /// Of the bodies only those with gaps up to `gap` [m] and the least bit more; as far as the cells
  /// of the grid reach.
  template <class Visit>
  void visit_partners_within(std::uint32_t body, Real gap, Real time, Visit&& visit);
  /// The same, however small the cells are. The state of `body` is that of now.
  template <class Visit>
  void visit_all_within(std::uint32_t body, Real gap, Real time, Visit&& visit);
  /// Whether a third body may touch one of the two: never missed, and hardly ever wrong.
  bool has_company(std::uint32_t body, Partner partner, Real time);

 private:
  RealVector position_at(std::uint32_t body, Real time) const;
  void list_near(std::uint32_t body);
  void keep_within(std::uint32_t body, Real gap, Real time);
  bool is_alone(std::uint32_t one, std::uint32_t two, Real time);
  bool has_third(std::uint32_t one, Partner two, Real time);
  template <class Visit>
  void visit_near_and_field(std::uint32_t body, Visit&& visit);

  const WorldSpec& spec_;
  const Bodies& bodies_;
  const CellGrid& grid_;
  Real puck_drag_;
  std::vector<std::uint32_t> near_;        // the body whose partners are visited
  std::vector<std::uint32_t> candidates_;  // for company
};

template <class Visit>
void ContactDetection::visit_partners(std::uint32_t body, Visit&& visit) {
  list_near(body);
  visit_near_and_field(body, visit);
}

template <class Visit>
void ContactDetection::visit_partners_within(std::uint32_t body, Real gap, Real time,
                                             Visit&& visit) {
  list_near(body);
  keep_within(body, gap, time);
  visit_near_and_field(body, visit);
}

/// Small bodies are listed by their centres and reach no further than half a cell; wide ones stand
/// wherever a small one may touch them.
template <class Visit>
void ContactDetection::visit_all_within(std::uint32_t body, Real gap, Real time, Visit&& visit) {
  near_.clear();
  const Body& b = bodies_[body];
  const RealVector extent =
      bodies_.build(body).half_extent + RealVector::Constant(b.radius + gap + Real(grid_.side()));
  const auto x = static_cast<double>(b.x), y = static_cast<double>(b.y),
             width = static_cast<double>(extent.x()), height = static_cast<double>(extent.y());
  grid_.within({grid_.column(x - width), grid_.row(y - height), grid_.column(x + width),
                grid_.row(y + height)},
               [&](std::uint32_t other) {
                 if (other != body) near_.push_back(other);
               });
  keep_within(body, gap, time);
  visit_near_and_field(body, visit);
}

template <class Visit>
void ContactDetection::visit_near_and_field(std::uint32_t body, Visit&& visit) {
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
