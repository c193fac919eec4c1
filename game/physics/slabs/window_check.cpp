// Compares courses that came late with all that they may have missed.
#include "game/physics/slabs/window_check.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <optional>

#include "game/physics/bodies/tolerances.h"
#include "game/physics/flight/dragged_flight.h"
#include "game/physics/flight/impact_time.h"

namespace rink::physics::inline RINK_PRECISION {

/// Courses are numbered by worker, the last pass being the last of them.
const Courses::Replaced& WindowCheck::course_at(std::uint32_t at) const {
  const auto workers = static_cast<std::uint32_t>(tiles_.size());
  const std::uint32_t worker = at % workers;
  Tile& tile = *tiles_[worker + 1 == workers ? 0 : worker + 1];
  return tile.courses().replaced()[at / workers];
}

Real WindowCheck::greatest_speed() const {
  Real square = 0.0;
  for (Tile* tile : tiles_) square = std::max(square, tile->courses().square_max());
  return std::sqrt(square);
}

bool WindowCheck::is_right(Workers* workers) const {
  const Real speed = greatest_speed();
  if (workers == nullptr)
    return std::ranges::all_of(
        tiles_, [&](Tile* tile) { return are_right(tile->courses().late(), speed); });
  assert(workers->count() + 1 == tiles_.size());
  const std::span<const Courses::Late> last = tiles_[0]->courses().late();
  std::atomic<bool> are_all_right = true;
  auto check = [&](std::uint32_t worker) {
    const std::size_t first = last.size() * worker / workers->count(),
                      end = last.size() * (worker + 1) / workers->count();
    if (!are_right(tiles_[worker + 1]->courses().late(), speed) ||
        !are_right(last.subspan(first, end - first), speed))
      are_all_right.store(false, std::memory_order_relaxed);
  };
  run_on(*workers, check);
  return are_all_right;
}

bool WindowCheck::are_right(std::span<const Courses::Late> late, Real speed) const {
  return std::ranges::none_of(
      late, [&](const Courses::Late& course) { return meets_unseen(course, speed); });
}

/// Where those are listed whom the course may meet by its `end`, when the window is over, all are
/// listed right and none has been faster than `speed`.
CellGrid::Range WindowCheck::range_of(const Courses::Late& late, Real end, Real speed) const {
  const CellGrid& grid = parts_.places.grid();
  const Real lasts = end - late.from;
  const bool is_curved = parts_.bodies[late.body].is(Body::curved),
             is_straight = !is_curved && parts_.spec.puck_drag == 0.0;
  const Flight& flight = late.flight;
  const RealVector velocity(flight.vx, flight.vy);  // which drag only lessens
  RealVector back = (velocity * lasts).cwiseMin(0.0), forth = (velocity * lasts).cwiseMax(0.0);
  if (is_curved) {
    const RealVector gain =
        parts_.bodies.law(late.body).acceleration * (shared_.end - flight.time) * lasts;
    back += gain.cwiseMin(0.0), forth += gain.cwiseMax(0.0);
  }
  const RealVector start = is_straight
                               ? RealVector(flight.x + flight.vx * (late.from - flight.time),
                                            flight.y + flight.vy * (late.from - flight.time))
                               : motion_of({late.body, flight}).at(late.from).position;
  const Real reach = parts_.places.reach() + Real(0.1 * grid.side());  // and cells' margins
  const RealVector far = extent_of(parts_.bodies, late.body) +
                         RealVector::Constant(reach + speed * (shared_.end - late.from));
  const auto low = (start + back - far).cast<double>().eval(),
             high = (start + forth + far).cast<double>().eval();
  return {grid.column(low.x()), grid.row(low.y()), grid.column(high.x()), grid.row(high.y())};
}

/// Whether its course meets one that it was not compared with, as that was over or had gone on to
/// cells out of sight. Both take a later event, of which the cell tells where the other body is.
bool WindowCheck::meets_unseen(const Courses::Late& late, Real speed) const {
  const CellGrid& grid = parts_.places.grid();
  const Real end = std::min(end_of(late), shared_.end);
  const CellGrid::Range range = range_of(late, end, speed);
  bool meets = false;
  for (std::uint32_t row = range.row_low; row <= range.row_high; ++row)
    for (std::uint32_t column = range.column_low; column <= range.column_high; ++column) {
      if (!(shared_.played[std::size_t{row} * grid.columns() + column] > late.from)) continue;
      grid.within({column, row, column, row}, [&](std::uint32_t other) {
        meets = meets || meets_unseen(late, other, end, speed);
      });
    }
  return meets;
}

bool WindowCheck::meets_unseen(const Courses::Late& late, std::uint32_t other, Real end,
                               Real speed) const {
  if (other == late.body) return false;
  const bool has_journal = shared_.observers.journal != nullptr;
  if (has_journal && !parts_.bodies.is_fixed(other) && !is_in_sight(late, other) &&
      touched_unseen(late, {other, parts_.bodies[other]}, speed))
    return true;  // it has crossed to cells out of sight
  if (meets_by(late, {other, parts_.bodies[other]}, end)) return true;
  for (std::uint32_t at = latest_of(other); at != Courses::none;) {
    const Courses::Replaced& r = course_at(at);
    if (!(r.end > late.from)) return false;
    if (has_journal && touched_unseen(late, {other, r.flight}, speed)) return true;
    if (meets_by(late, {other, r.flight}, std::min(r.end, end))) return true;
    at = r.earlier;
  }
  return false;
}

/// In straight flight nobody who is in sight when the window is over was out of it before.
bool WindowCheck::is_in_sight(const Courses::Late& late, std::uint32_t other) const {
  const CellGrid::Place here = late.place, there = parts_.places.grid().place(other);
  return std::abs(int{here.column} - int{there.column}) <= 1 &&
         std::abs(int{here.row} - int{there.row}) <= 1;
}

/// Whether somebody who has been played further touched the body in the impact that began its late
/// course, by four times the roundings that JointImpacts allows: the two do not meet, but a journal
/// is told of it. `speed` is the window's greatest, for velocities before the impact count. Within
/// 1e-6 m somebody was in every tenth window of a dense gas.
bool WindowCheck::touched_unseen(const Courses::Late& late, const Course& other, Real speed) const {
  const bool began_late = late.flight.time >= late.from;  // by an impact
  if (!began_late || !(other.flight.time < late.from)) return false;
  const RealVector there = motion_of(other).at(late.from).position,
                   offset = RealVector(late.flight.x, late.flight.y) - there;
  const Real rounding =
      offset_tolerance(parts_.spec) + std::numeric_limits<Real>::epsilon() * late.from * speed;
  return shape_of(parts_.bodies, late.body, other.body).gap(offset).distance <= 64.0 * rounding;
}

/// Asked as prediction asks, so that a meeting that it knows comes at the same bits. Laws of motion
/// are the same all through a window.
bool WindowCheck::meets_by(const Courses::Late& late, const Course& other, Real end) const {
  const Bodies& bodies = parts_.bodies;
  if (!(other.flight.time < end)) return false;
  std::optional<Real> time;
  if (!bodies[late.body].is(Body::curved) && !bodies[other.body].is(Body::curved)) {
    const Real drag = parts_.spec.puck_drag, reach = late.flight.radius + other.flight.radius;
    time = drag == 0.0 ? disc_contact_time(late.flight, other.flight, end)
                       : dragged_contact_time(sighting_of(late.flight, other.flight, drag), reach,
                                              end, drag);
  } else {
    const Course own{late.body, late.flight};
    const bool is_low = own.body < other.body;
    const Motion low = motion_of(is_low ? own : other), high = motion_of(is_low ? other : own);
    time = first_contact(RelativeMotion{low, high}, shape_of(bodies, late.body, other.body),
                         std::max(low.time, high.time), end, offset_tolerance(parts_.spec));
  }
  return time && *time < end;
}

Motion WindowCheck::motion_of(const Course& course) const {
  Motion motion = parts_.bodies.motion(course.body);
  const Flight& flight = course.flight;
  motion.time = flight.time;
  motion.position = {flight.x, flight.y}, motion.velocity = {flight.vx, flight.vy};
  return motion;
}

/// The last one that was replaced in this window, or `none`.
std::uint32_t WindowCheck::latest_of(std::uint32_t body) const {
  const Courses::Latest& latest = shared_.latest[body];
  return latest.window == shared_.number ? latest.at : Courses::none;
}

/// When the course was replaced, or would be.
Real WindowCheck::end_of(const Courses::Late& late) const {
  for (std::uint32_t at = latest_of(late.body); at != Courses::none; at = course_at(at).earlier) {
    const Courses::Replaced& r = course_at(at);
    if (r.flight.time == late.flight.time && r.flight.vx == late.flight.vx &&
        r.flight.vy == late.flight.vy)
      return std::min(late.until, r.end);
  }
  return late.until;
}

}  // namespace rink::physics::inline RINK_PRECISION
