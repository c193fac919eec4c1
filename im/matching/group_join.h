// Finds what changed between two sets of moving boxes, eight neighbours of one set at a time.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "im/matching/buffer.h"
#include "im/matching/index/box_index.h"
#include "im/worker.h"

namespace rink::im {

/// Askers that follow each other in the order of their cells are neighbours, and look at nearly the
/// same cells. So these are looked up once for eight of them, and each box there is compared with
/// all eight at once: an asker costs a third of what it costs to look its cells up alone.
class GroupJoin {
 public:
  explicit GroupJoin(Instructions instructions) : scan_(scans(instructions).changes_of_group) {}

  void clear();
  /// Sets a worker that takes half of what is added from now on, or null for none. The answers are
  /// the same, in the same order.
  void share_with(Worker* worker) { worker_ = worker; }
  /// All pairs of rectangles of `askers` and `index` that overlap either before or now, not both.
  void add_changes(const BoxIndex& index, const BoxIndex& askers, const TieJudge& judge);

  /// Calls `take(asker, found)` for each asker that found something, in the order of their cells:
  /// `found` are the ids as `found_change`, ascending.
  template <class Take>
  void for_each_asker(const Take& take) const {
    for (const Part* part : {&own_, &other_}) {
      const std::uint32_t* first = part->found.data();
      for (const Run& run : part->runs.span())
        take(run.asker, std::span(first, run.size)), first += run.size;
    }
  }
  std::size_t found_count() const { return own_.found.size() + other_.found.size(); }
  std::uint64_t candidate_count() const { return own_.candidate_count + other_.candidate_count; }
  std::size_t bytes() const { return own_.bytes() + other_.bytes(); }

 private:
  /// What an asker found.
  struct Run {
    std::uint32_t asker, size;
  };
  struct Part {
    std::uint64_t candidate_count = 0;
    Buffer<Run> runs;
    Buffer<std::uint32_t> found;  // of all runs
    // Of one group.
    Buffer<Stretch> stretches;
    std::size_t looked_at = 0;  // boxes in them
    Buffer<std::uint64_t> suspects;
    Buffer<std::uint32_t> lanes, spare;

    void clear() { candidate_count = 0, runs.clear(), found.clear(); }
    std::size_t bytes() const {
      return sizeof(Stretch) * stretches.capacity() + sizeof(Run) * runs.capacity() +
             sizeof(std::uint64_t) * suspects.capacity() +
             sizeof(std::uint32_t) * (found.capacity() + lanes.capacity() + spare.capacity());
    }
  };
  /// Who asks about what.
  struct Inquiry {
    const BoxIndex &index, &askers;
    const TieJudge& judge;
  };
  /// The askers from `begin` to before `end`.
  void add(const Inquiry& inquiry, std::size_t begin, std::size_t end, Part& part) const;
  /// As many of those from `first` on as are near each other; the cells that they look at are then
  /// in `stretches`.
  static std::size_t gather(const Inquiry& inquiry, std::size_t first, std::size_t end, Part& part);

  GroupScan scan_;
  Worker* worker_ = nullptr;
  Part own_, other_;
};

}  // namespace rink::im
