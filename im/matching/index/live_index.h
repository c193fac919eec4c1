// An index for boxes of which few move at a time: each box is stored once in its cell, and moving
// one touches nothing else.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "im/matching/buffer.h"
#include "im/matching/index/cell_level.h"
#include "im/matching/index/scan.h"
#include "im/matching/probe_list.h"
#include "im/matching/region_history.h"

namespace rink::im {

/// Every cell has a block of eight lanes, three lines of memory, adjacent cells adjacent ones; so a
/// row of cells is one stretch to scan. What does not fit is in a run of further blocks elsewhere,
/// all full. Empty lanes hold nowhere. About 60 bytes per box where boxes are spread evenly.
class LiveIndex {
 public:
  /// Never the id of a box: an empty lane's.
  static constexpr std::uint32_t nobody = RegionHistory::id_max;

  /// Builds the index of those `regions` that are somewhere at `place`, their old or their present
  /// one.
  void build(const Region& world, const RegionHistory& regions, Region Motion::*place);
  /// Adds or moves boxes to where they are now.
  void put(std::span<const std::uint32_t> ids, const RegionHistory& regions);
  void remove(std::uint32_t id);

  /// True if it was never built, or so many boxes came or grew since that it is worth building
  /// anew.
  bool is_outgrown() const;
  std::size_t size() const { return size_; }
  Candidates candidates() const;
  /// Appends where boxes may have an overlap with `probe` that changed; returns how many boxes
  /// those are.
  std::size_t find_changes(const Probe& probe, Buffer<Stretch>& stretches) const;
  /// As above for a query about the probe's disc.
  std::size_t find_disc_changes(const Probe& probe, Buffer<Stretch>& stretches) const;
  std::size_t bytes() const;
  /// Asserts that blocks hold each box once, in its cell and where its id says, and no other memory
  /// is lost.
  void check() const;

 private:
  static constexpr std::uint32_t lanes = scan_width, none = 0xFFFFFFFF;

  struct alignas(64) Block {
    float low_x[lanes], low_y[lanes], high_x[lanes], high_y[lanes];
    std::uint32_t ids[lanes];
    std::uint32_t cell;
    std::uint32_t run, run_size, run_capacity;  // of the first block of a cell: its further blocks,
                                                // and for how many there is room
  };
  static_assert(sizeof(Block) == 192);
  static constexpr std::uint32_t stride = sizeof(Block) / sizeof(float);

  /// Of a cell. Apart from the blocks, so that finding candidates waits for none.
  struct Head {
    std::uint8_t count : 7;  // of boxes in its first block, in the first lanes
    std::uint8_t has_more : 1;
  };

  template <class Query>
  std::size_t collect(const CellLevel& level, const Query& query, Buffer<Stretch>& stretches) const;
  FloatBox box(std::uint32_t place) const;
  void set(std::uint32_t place, const FloatBox& box);
  void set(std::uint32_t place, std::uint32_t id, const FloatBox& box);
  void add_blocks(std::uint32_t count);
  std::uint32_t take_run(std::uint32_t size);
  void grow_run(std::uint32_t cell);
  void clear(std::uint32_t place);
  void empty(std::uint32_t block);
  void copy_boxes(std::uint32_t from, std::uint32_t to);
  void insert(std::uint32_t cell, std::uint32_t id, const FloatBox& box);
  void put(std::uint32_t id, const Region& region);
  std::uint32_t cell_for(const FloatBox& box);
  std::size_t check(std::uint32_t cell) const;
  void check_place(std::uint32_t place, std::uint32_t cell) const;
  bool holds(std::uint32_t id) const { return id < place_of_.size() && place_of_[id] != none; }

  Projection projection_;
  bool is_built_ = false, has_grown_ = false;
  std::size_t size_ = 0, built_size_ = 0;
  SizeLevels sizes_;
  CellLevels levels_;
  Buffer<FloatBox> staged_;
  Buffer<std::uint32_t> staged_ids_;
  Buffer<Head> heads_;                          // by cell
  Buffer<Block> blocks_;                        // those of the cells first
  std::array<Buffer<std::uint32_t>, 28> free_;  // runs, by the power of two that they are long
  Buffer<std::uint32_t> place_of_;              // of an id: block * lanes + lane
};

}  // namespace rink::im
