// The flights that a window of time replaced: what it takes to find out whether it was right, and
// to undo it.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "game/physics/bodies/bodies.h"
#include "game/physics/flight/straight_flight.h"
#include "game/physics/grid/cell_grid.h"
#include "game/physics/real.h"

namespace rink::physics::inline RINK_PRECISION {

/// One worker's part of them. A course is one flight of one body, from the event that set it to the
/// event that replaced it.
class Courses {
 public:
  static constexpr std::uint32_t none = 0xffffffff;

  struct Replaced {
    Flight flight;
    Real end;  ///< when it was replaced [s]
    std::uint32_t body, version;
    std::uint32_t earlier;  ///< of the same body, in the chain that Latest begins; or `none`
  };
  /// By body, shared by all workers: where the course is that was replaced last in this window.
  struct Latest {
    std::uint32_t window = 0, at = none;
  };
  /// An event after which later ones had been processed near it: one of its bodies, and the course
  /// on which that goes on until its next event.
  struct Late {
    Flight flight;
    Real from, until;  // s
    std::uint32_t body;
    CellGrid::Place place;
  };

  /// Worker `number` of `count` keeps courses at `number` + k `count`.
  Courses(std::uint32_t number, std::uint32_t count) : number_(number), count_(count) {}

  void begin(std::uint32_t window) {
    window_ = window;
    replaced_.clear(), late_.clear();
    square_max_ = 0.0;
  }
  /// Before or after the flight of `body` changes at `end`: it was `flight`, with `version`.
  void replace(std::uint32_t body, const Flight& flight, std::uint32_t version, Real end,
               Latest& latest) {
    const std::uint32_t earlier = latest.window == window_ ? latest.at : none;
    latest = {window_, number_ + count_ * static_cast<std::uint32_t>(replaced_.size())};
    replaced_.push_back({flight, end, body, version, earlier});
    note_speed(flight);
  }
  /// Of the flight that follows.
  void note_speed(const Flight& flight) {
    square_max_ = std::max(square_max_, flight.vx * flight.vx + flight.vy * flight.vy);
  }
  void note_late(const Late& late) { late_.push_back(late); }

  std::span<const Replaced> replaced() const { return replaced_; }
  std::span<const Late> late() const { return late_; }
  /// Of the greatest speed of all whose flight was replaced, before or after.
  Real square_max() const { return square_max_; }

 private:
  std::uint32_t number_, count_, window_ = 0;
  std::vector<Replaced> replaced_;
  std::vector<Late> late_;
  Real square_max_ = 0.0;
};

}  // namespace rink::physics::inline RINK_PRECISION
