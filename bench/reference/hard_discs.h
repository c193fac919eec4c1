// A minimal gas of equal hard discs in a square box, written apart from the engine: the rate that
// an event-driven simulation reaches which can do nothing else.
#pragma once

#include <cassert>
#include <cstdint>
#include <functional>
#include <limits>
#include <vector>

namespace rink::bench {

/// The textbook's method (Alder and Wainwright 1959, Lubachevsky 1991): each disc stands at its own
/// last collision, cells tell who is near, and each disc keeps its next collision and the time of
/// its next event. There is no queue of all events: those of the next stretch of time are sorted
/// into buckets, the later ones wait with their discs until it is over.
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

  /// Discs of mass 1 in the box [0, side] x [0, side], where no two may overlap.
  HardDiscs(double side, double radius, const std::vector<Disc>& discs);

  /// Processes all events up to `until` [s], and calls `see`, if there is one, after each collision
  /// of two discs.
  void advance(double until, const std::function<void(const Collision&)>& see = {});

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
  static constexpr std::uint32_t room = 15;  // discs that a cell can hold

  /// One cache line: the disc, its cell, and its next collision. A collision is void if the
  /// partner's number of collisions is no longer that which it was predicted with.
  struct alignas(64) Record {
    double x, y, vx, vy, time, impact;
    Index partner;
    std::uint16_t column, row;
    std::uint32_t collisions, partner_collisions;
  };
  struct alignas(64) Cell {
    std::uint32_t count = 0;
    Index discs[room];
  };
  struct Note {
    double time;
    Index disc, next;
  };
  struct Crossing {
    double time;
    int columns, rows;  // by how many it moves, one of them 0
  };

  Cell& cell(int column, int row) {
    return cells_[static_cast<std::size_t>(row + 1) * pitch_ + static_cast<std::size_t>(column) +
                  1];
  }
  const Cell& cell(int column, int row) const {
    return const_cast<HardDiscs*>(this)->cell(column, row);
  }
  void enter(Index disc);
  void leave(Index disc);
  Crossing crossing(const Record& r) const;
  void meet_walls(Record& r) const;
  void meet_in(Record& r, Index disc, int column, int row);
  void predict(Index disc);
  void cross(Index disc);
  void collide(Index disc, double time);
  void settle(Index disc);
  void open_stretch();
  void note(Index disc, double time);
  void sort_in(Index disc, double time);
  Index next();

  double side_, reach_, cell_side_;
  int columns_;
  std::size_t pitch_;
  std::vector<Record> records_;
  std::vector<double> dues_;  // when the next event of each disc comes
  std::vector<Cell> cells_;   // with a frame of empty ones
  double now_ = 0.0, stretch_begin_ = 0.0, stretch_end_ = 0.0, buckets_per_second_ = 0.0;
  std::uint64_t collisions_ = 0, events_ = 0, events_before_ = 0;
  std::vector<Index> buckets_;  // the first note of each
  std::size_t bucket_ = 0;
  std::vector<Note> notes_, due_;  // due: of the bucket at hand, the first one last
};

}  // namespace rink::bench
