// An index for boxes of which few move at a time: each box is stored once in its cell, a cell is
// one line of memory, and moving a box touches nothing else.
#pragma once

#include <array>
#include <cassert>
#include <cstdint>
#include <span>
#include <vector>

#include "im/matching/buffer.h"
#include "im/matching/index/cell_level.h"
#include "im/matching/index/line.h"
#include "im/matching/index/scan.h"
#include "im/matching/probe_list.h"
#include "im/matching/region_history.h"

namespace rink::im {

struct LineHits;

/// The cost of a mover is that of loads beyond the caches, 100 ns and more each; so a query reads
/// one line for each cell, and a moving box finds its line from its old place. What does not fit
/// into a cell's line is in a run of further lines elsewhere, all full. About 26 bytes per box
/// where boxes are spread evenly.
class LineIndex {
 public:
  /// What some askers found, in no order.
  struct Answers {
    Buffer<std::uint64_t> found;  ///< the asker's id, and below it the found id with `entered_bit`
    std::uint64_t candidate_count = 0;
    void clear() { found.clear(), candidate_count = 0; }
    std::size_t bytes() const {
      return sizeof(std::uint64_t) * (found.capacity() + doubts.capacity()) +
             sizeof(Visit) * (visits.capacity() + crowded.capacity()) +
             sizeof(Hit) * hits.capacity();
    }

   private:
    friend class LineIndex;
    struct Visit {
      std::uint64_t asking;  // edges now and before within the line's cell
      std::uint32_t line, asker;
    };
    /// A line with boxes that changed or tied, a bit for each.
    struct Hit {
      const Line* line;
      std::uint32_t asker;
      std::uint8_t changed, entered, tied;
    };
    Buffer<Visit> visits, crowded;  // those of cells with further lines once more
    Buffer<Hit> hits;
    Buffer<std::uint64_t> doubts;  // the asker's id, and below it an id that it may have found
  };

  /// The queries, some of `askers`, and `judge`, which decides by `regions` where bytes cannot.
  struct Inquiry {
    const ProbeList& askers;
    std::size_t begin, end;
    const TieJudge& judge;
    const RegionHistory& regions;
  };

  /// Builds the index of those `regions` that are somewhere at `place`, their old or their present
  /// one.
  void build(const Region& world, const RegionHistory& regions, Region Motion::*place);
  /// Adds boxes or moves them from their old to their present places.
  void put(const ProbeList& moved);
  /// Of a box that is there.
  void remove(std::uint32_t id, const Region& place);

  bool is_built() const { return is_built_; }
  std::size_t size() const { return size_; }
  /// True if it was never built, or so many boxes came or grew since that it is worth building
  /// anew.
  bool is_outgrown() const;
  /// Finds all boxes whose overlap with an asker changes while the askers move from their old to
  /// their present places.
  void find_changes(const Inquiry& inquiry, Instructions instructions, Answers& answers) const;
  std::size_t bytes() const;
  /// Asserts that lines and runs hold each box once, where its id is looked for, and no other
  /// memory is lost.
  void check() const;

 private:
  using Visit = Answers::Visit;
  using Hit = Answers::Hit;
  static constexpr std::uint32_t lanes = Line::lanes;

  /// Of a cell: its further lines, and for how many there is room.
  struct Run {
    std::uint32_t first, size, capacity;
  };
  /// Where a box is to be.
  struct Place {
    std::uint32_t cell, packed;
  };
  std::size_t level_of(const FloatBox& box) const {
    assert(levels_.size() > 0);
    return levels_.size() == 1 ? 0 : sizes_.level(longer_side(box));
  }
  Place place_of(std::size_t level, const FloatBox& box) const;
  CellQuery query(const CellLevel& level, const Probe& probe) const;
  void insert(std::uint32_t id, const Place& place);
  void move(std::uint32_t id, std::uint32_t from, const Place& to);
  void remove(std::uint32_t id, std::uint32_t cell);
  void copy(std::uint32_t from, std::uint32_t to);
  void grow_run(std::uint32_t cell);
  std::uint32_t take_run(std::uint32_t size);
  std::size_t check(std::uint32_t cell) const;
  template <class Compare>
  void find_changes(const Inquiry& inquiry, Answers& answers) const;
  void visit(const Probe& probe, std::uint32_t asker, Buffer<Visit>& visits) const;
  static Hit* list(Hit* hit, const Line& line, std::uint32_t asker, const LineHits& outcome);
  template <class Compare>
  void read_lines(Answers& answers) const;
  template <class Compare>
  void read_further(Answers& answers) const;
  static void take_hits(const ProbeList& askers, const RegionHistory& regions, Answers& answers);
  template <class Compare>
  void read(const ProbeList& askers, const TieJudge& judge, const RegionHistory& regions,
            Answers& answers) const;

  Projection projection_;
  bool is_built_ = false, has_grown_ = false;
  std::size_t size_ = 0, built_size_ = 0;
  SizeLevels sizes_;
  CellLevels levels_;
  std::vector<EdgeCoding> codings_;  // of each level
  Buffer<FloatBox> staged_;
  Buffer<std::uint32_t> staged_ids_;
  Buffer<Line> lines_;                          // those of the cells first
  Buffer<Run> runs_;                            // by cell, read where a line says so
  std::array<Buffer<std::uint32_t>, 28> free_;  // runs, by the power of two that they are long
  Buffer<std::uint32_t> further_place_of_;  // line * lanes + lane, of an id that is in a further
                                            // line; what it says of others is old
};

}  // namespace rink::im
