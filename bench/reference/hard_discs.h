// A minimal gas of equal hard discs in a square box, written apart from the engine: the rate that
// an event-driven simulation reaches which can do nothing else.
#pragma once

#include <cassert>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <vector>

#include "game/physics/large_pages.h"

namespace rink::bench {

/// The textbook's method (Alder and Wainwright 1959, Lubachevsky 1991): each disc stands at its own
/// last collision, cells tell who is near, and each disc keeps its next collision and the time of
/// its next event. There is no queue of all events: those of the next stretch of time are sorted
/// into buckets, the later ones wait with their discs until it is over. What the next few events
/// will look at is fetched before their turn, which is most of the speed with many discs.
class HardDiscs {
 public:
  struct Disc {
    double x, y, vx, vy;  ///< m, m/s, at `time`
    double time;          ///< of its last collision [s]
  };
  struct Collision {
    double time;
    std::uint32_t low, high;
  };
  using See = std::function<void(const Collision&)>;

  /// Discs of mass 1 in the box [0, side] x [0, side], where no two may overlap. Throws
  /// std::length_error, as advance() does, if more of them gather in a cell than it can hold; in a
  /// gas at packing 0.05 one of 1e13 cells is so full.
  HardDiscs(double side, double radius, const std::vector<Disc>& discs);

  /// Processes all events up to `until` [s], and calls `see`, if there is one, after each collision
  /// of two discs.
  void advance(double until, const See& see = {});

  double now() const { return now_; }
  std::uint64_t collisions() const { return collisions_; }
  std::uint32_t count() const { return static_cast<std::uint32_t>(records_.size()); }
  Disc disc(std::uint32_t index) const {
    const Record& r = records_[index];
    return {r.x, r.y, r.vx, r.vy, r.time};
  }
  double kinetic_energy() const;
  /// The deepest overlap of two discs now [m]; looks at all that are near each other.
  double max_overlap() const;

 private:
  using Index = std::uint32_t;
  static constexpr Index nobody = 0xffffffff, wall_x = 0xfffffffe, wall_y = 0xfffffffd;
  static constexpr double never = std::numeric_limits<double>::infinity();
  static constexpr std::uint32_t narrow = 8, wide = 16;  // numbers in a cell: its count, then discs
  static constexpr std::size_t near_max = 9 * wide;
  // How many events before its turn one is put in order, and its cells and discs are fetched.
  static constexpr std::size_t order_ahead = 24, cells_ahead = 12, discs_ahead = 6;

  /// One cache line: the disc, its cell, and its next collision. A collision is void if the
  /// partner's number of collisions is no longer that which it was predicted with.
  struct alignas(64) Record {
    double x, y, vx, vy, time, impact;
    Index partner;
    std::uint32_t column : 15, row : 15, direction : 2;  // direction: of its next crossing
    std::uint32_t collisions, partner_collisions;
  };
  struct Note {
    double time;
    Index disc, next;
  };
  struct Stretch {
    double begin = 0.0, end = 0.0, buckets_per_second = 0.0;
    std::uint64_t events_before = 0;
    std::size_t next_bucket = 0;
  };
  /// How two discs approach each other from the later of their last collisions on.
  struct Approach {
    double since, closing, gap, rest;
  };

  std::size_t cell_of(const Record& r) const { return (r.row + 1u) * pitch_ + r.column + 1u; }
  void enter(Index disc);
  void leave(Index disc);
  Index* gather(std::size_t centre, std::size_t across, Index* end) const;
  Index* gather_around(const Record& r, Index* end) const;
  Index* gather_beyond(const Record& r, Index* end) const;
  double fly(Record& r) const;
  void meet_wall(Record& r, double at, double speed, Index wall) const;
  Approach approach(const Record& a, const Record& b) const;
  void meet(Record& r, const Index* near, const Index* end) const;
  void predict(Index disc);
  void cross(Index disc);
  void collide(Index disc, double time);
  void settle(Index disc, double crossing);
  void process(Index disc, double time, const See& see);
  bool open_stretch(double until);
  double stretch_length() const;
  void note(Index disc, double time);
  void sort_in(Index disc, double time);
  void order_next_bucket();
  void look_ahead();
  void fetch_cells(Index disc) const;
  void fetch_discs(Index disc) const;
  bool find_next();

  double side_, reach_;
  std::uint32_t columns_, cell_size_;
  std::size_t pitch_;
  std::size_t steps_[4], across_[4];  // by direction, in cells: left, right, down, up
  std::vector<double> edges_;         // of the columns and rows, the outer ones at infinity
  physics::LargeArray<Record> records_;
  physics::LargeArray<double> dues_;  // when the next event of each disc comes
  physics::LargeArray<Index> cells_;  // with a frame of empty ones
  double now_ = 0.0;
  std::uint64_t collisions_ = 0, events_ = 0;
  Stretch stretch_;
  std::vector<Index> buckets_;  // the first note of each
  std::vector<Note> notes_;
  std::vector<Note> ahead_;  // of the buckets before the next one, by time, from head_ on
  std::size_t head_ = 0;
};

}  // namespace rink::bench
