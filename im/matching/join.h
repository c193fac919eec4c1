// Queries an index with the boxes of another, a block at a time, and gathers the answers.
#pragma once

#include <cassert>
#include <cstdint>

#include "im/matching/index/box_index.h"
#include "im/matching/index/live_index.h"
#include "im/matching/probe_list.h"
#include "im/worker.h"

namespace rink::im {

/// The answers: for each asker, in the order of its cell, the ids that it found.
class Join {
 public:
  explicit Join(Instructions instructions) : scans_(scans(instructions)) {}

  void clear();
  /// Sets a worker that takes half of what is added from now on, or null for none. The answers are
  /// the same, in the same order.
  void share_with(Worker* worker) { worker_ = worker; }
  /// All pairs of `askers` and `index` that overlap now.
  void add_overlaps(const BoxIndex& index, const BoxIndex& askers, const TieJudge& judge);
  /// All pairs whose answer to `question` before and now differ. Index: BoxIndex or LiveIndex;
  /// askers: BoxIndex or ProbeList.
  template <class Index, class Askers>
  void add_changes(const Index& index, const Askers& askers, const TieJudge& judge,
                   Question question);

  std::size_t asker_count() const { return own_.askers.size(); }
  std::uint32_t asker(std::size_t i) const { return own_.askers[i]; }
  std::span<const std::uint32_t> found(std::size_t i) const {
    assert(i < asker_count());
    const std::size_t first = i == 0 ? 0 : own_.ends[i - 1];
    return {own_.found.data() + first, own_.ends[i] - first};
  }
  std::size_t found_count() const { return own_.found.size(); }
  std::uint64_t candidate_count() const { return own_.candidate_count; }
  const char* instructions() const { return scans_.name; }
  std::size_t bytes() const;

 private:
  /// Those of `all` from `begin` to before `end`.
  template <class Askers>
  struct Slice {
    const Askers& all;
    std::size_t begin, end;
  };
  /// What some askers found.
  struct Part {
    std::uint64_t candidate_count = 0;
    Buffer<Stretch> stretches;
    Buffer<std::uint32_t> askers, found;
    Buffer<std::size_t> ends;

    void clear();
    void append(const Part& other);
    template <class Index, class Askers, class Find>
    void add(const Index& index, const Slice<Askers>& askers, const TieJudge& judge, Scan scan,
             const Find& find);
    std::size_t bytes() const;
  };
  template <class Index, class Askers, class Find>
  void add(const Index& index, const Askers& askers, const TieJudge& judge, Scan scan,
           const Find& find);

  const Scans& scans_;
  Worker* worker_ = nullptr;
  Part own_, other_;  // the worker's part is added to the own one
};

}  // namespace rink::im
