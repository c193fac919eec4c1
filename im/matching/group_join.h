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

  /// The asker's id, and below it the found id with `entered_bit`: those of the first half of the
  /// askers, and of the second.
  std::span<const std::uint64_t> found() const { return own_.found.span(); }
  std::span<const std::uint64_t> found_by_worker() const { return other_.found.span(); }
  std::uint64_t candidate_count() const { return own_.candidate_count + other_.candidate_count; }
  std::size_t bytes() const { return own_.bytes() + other_.bytes(); }

 private:
  /// What some askers found.
  struct Part {
    std::uint64_t candidate_count = 0;
    Buffer<Stretch> stretches;
    Buffer<std::uint64_t> found, suspects;

    void clear() { candidate_count = 0, found.clear(); }
    std::size_t bytes() const {
      return sizeof(Stretch) * stretches.capacity() +
             sizeof(std::uint64_t) * (found.capacity() + suspects.capacity());
    }
  };
  /// Who asks about what.
  struct Inquiry {
    const BoxIndex &index, &askers;
    const TieJudge& judge;
  };
  /// The askers from `begin` to before `end`.
  void add(const Inquiry& inquiry, std::size_t begin, std::size_t end, Part& part) const;

  GroupScan scan_;
  Worker* worker_ = nullptr;
  Part own_, other_;
};

}  // namespace rink::im
