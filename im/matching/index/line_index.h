// Boxes that stand, each stored once in its cell and a cell in one line of memory, where few of
// them move at a time: those are put elsewhere in place and nothing else is touched.
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

/// What a load beyond the caches costs, 100 ns and more, is what a mover costs; so who asks reads
/// one line for each cell, and who moves finds his own without being told where it is: his cell
/// follows from where he was. What does not fit into a cell's line is in a run of further lines
/// elsewhere, all full. About 26 bytes per box where boxes are spread evenly.
class LineIndex {
 public:
  /// What some askers found, in no order.
  struct Answers {
    Buffer<std::uint64_t>
        found;  ///< the asker's id, and below it what he found, with `entered_bit`
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
    Buffer<std::uint64_t> doubts;  // the asker's id, and below it whom he may have found
  };

  /// Who asks, some of `askers`, and what decides where bytes cannot: `judge`, which asks the
  /// regions that `regions` holds.
  struct Inquiry {
    const ProbeList& askers;
    std::size_t begin, end;
    const TieJudge& judge;
    const RegionHistory& regions;
  };

  /// Starts anew with those of `regions` that are somewhere at `place`: where they were or where
  /// they are now.
  void build(const Region& world, const RegionHistory& regions, Region Motion::*place);
  /// Adds boxes or moves them from where they were to where they are now.
  void put(const ProbeList& moved);
  /// Of a box that is there.
  void remove(std::uint32_t id, const Region& place);

  bool is_built() const { return is_built_; }
  std::size_t size() const { return size_; }
  /// True if it was never built, or so much came or grew since that it is worth building anew.
  bool is_outgrown() const;
  /// All of which an overlap with one of the askers changed while those went from where they were
  /// to where they are.
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
