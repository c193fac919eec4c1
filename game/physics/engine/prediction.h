// The earliest event of a body, from last-event states alone.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "game/physics/bodies/bodies.h"
#include "game/physics/bodies/clock.h"
#include "game/physics/bodies/impact_history.h"
#include "game/physics/bodies/partner.h"
#include "game/physics/body.h"
#include "game/physics/counters.h"
#include "game/physics/engine/next_events.h"
#include "game/physics/engine/rest_contacts.h"
#include "game/physics/flight/dragged_flight.h"
#include "game/physics/grid/cell_grid.h"
#include "game/physics/real.h"

namespace rink::physics::inline RINK_PRECISION {

/// Writes the next events, and nothing else.
class Prediction {
 public:
  struct Uses {
    const Clock& clock;
    const Bodies& bodies;
    const CellGrid& grid;
    const ImpactHistory& history;
    const RestContacts& rests;
    NextEvents& events;
    Counters& counters;
  };
  Prediction(const WorldSpec& spec, const Uses& uses);
  Prediction(const Prediction&) = delete;
  Prediction& operator=(const Prediction&) = delete;

  void predict(std::uint32_t body);
  /// All of `bodies` that are in play, which are all there are. Whoever moves finds those who rest;
  /// these need not look for themselves.
  void predict_all(std::span<const std::uint32_t> bodies);
  /// As predict() and predict_beyond(), but for telling the schedule.
  void look(std::uint32_t body) { predict_pairs(body, begin(body)); }
  void look_beyond(std::uint32_t body, CellGrid::Direction direction) {
    if (bodies_[body].is(Body::curved)) return look(body);
    predict_flight(body);
    predict_pairs(body, grid_.collect_ahead(body, direction, room_for_candidates()));
  }
  /// Predicts a puck in straight flight, but for telling the schedule. Returns how many touch it
  /// now, itself included: never too few, hardly ever too many.
  std::uint32_t predict_counting(std::uint32_t body);
  /// The same of one on a curve, when its flight begins.
  std::uint32_t predict_curved_counting(std::uint32_t body);
  /// Of a body that has just been moved to the next cell: in straight flight, the earliest impact
  /// in the others is known and stays the earliest.
  void predict_beyond(std::uint32_t body, CellGrid::Direction direction);

 private:
  /// For all whom the grid may name at once.
  std::uint32_t* room_for_candidates() {
    if (candidates_.size() < grid_.collected_max()) candidates_.resize(grid_.collected_max());
    return candidates_.data();
  }
  void begin_alone(std::uint32_t body);
  std::uint32_t begin(std::uint32_t body);
  bool is_left_alone(std::uint32_t body) const;
  bool may_ask_pairs_once() const;
  void ask_pairs_once();
  bool sees_curves(std::uint32_t count) const;
  std::uint32_t sort_by_curves(std::uint32_t count);
  bool may_touch_on_curve(std::uint32_t body, std::uint32_t other) const;
  void predict_field(std::uint32_t body);
  void predict_flight(std::uint32_t body);
  void predict_side_wall(std::uint32_t body);
  void predict_end_wall(std::uint32_t body);
  void predict_curved_walls(std::uint32_t body);
  void predict_mouth(std::uint32_t body);
  void predict_pairs(std::uint32_t body, std::uint32_t count);
  template <bool counts>
  std::uint32_t predict_straight_pairs(std::uint32_t body, std::uint32_t* near,
                                       std::uint32_t count);
  void predict_pair(std::uint32_t body, std::uint32_t other);
  void offer_dragged(std::uint32_t body, std::uint32_t other, const Sighting& sighting);
  std::uint32_t predict_dragged_counting(std::uint32_t body, std::uint32_t count);
  Real limit_of_curved(std::uint32_t body, std::uint32_t other) const;
  bool may_meet(std::uint32_t one, std::uint32_t other, Real limit) const;
  bool may_meet_since(std::uint32_t earlier, std::uint32_t later, const RealVector& reach,
                      Real limit) const;
  bool may_reach(std::uint32_t body, const HalfPlane& plane, Real limit) const;
  void predict_curved_pair(std::uint32_t body, std::uint32_t other);
  void predict_curved_crossing(std::uint32_t body);
  bool is_known(const NextEvent& slot, Real time, Partner partner) const;
  void offer(std::uint32_t body, Real time, Partner partner);
  /// On the pucks' warped clock.
  Real real_time(Real start, Real warped) const {
    return time_on_warped_clock(start, warped, puck_drag_);
  }
  bool is_open(Real y) const;

  const Field& field_;
  const Clock& clock_;
  const Bodies& bodies_;
  const CellGrid& grid_;
  const ImpactHistory& history_;
  const RestContacts& rests_;
  NextEvents& events_;
  Counters& counters_;
  Real puck_drag_, tolerance_;
  std::vector<std::uint32_t> candidates_;  // near the body that is being predicted
};

}  // namespace rink::physics::inline RINK_PRECISION
