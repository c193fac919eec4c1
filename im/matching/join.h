// Asks an index on behalf of the boxes of another, a block at a time, and gathers the answers.
#pragma once

#include <cstdint>

#include "im/matching/box_index.h"
#include "im/matching/live_index.h"
#include "im/matching/probe_list.h"

namespace rink::im {

/// The answers: for each asker, in the order of its cell, the ids that it found.
class Join {
 public:
  explicit Join(Instructions instructions) : scans_(scans(instructions)) {}

  void clear();
  /// All pairs of `askers` and `index` that overlap now.
  void add_overlaps(const BoxIndex& index, const BoxIndex& askers, const TieJudge& judge);
  /// All pairs whose overlap before and now differ. Index: BoxIndex or LiveIndex; askers: BoxIndex or ProbeList.
  template <class Index, class Askers>
  void add_changes(const Index& index, const Askers& askers, const TieJudge& judge);

  std::size_t asker_count() const { return askers_.size(); }
  std::uint32_t asker(std::size_t i) const { return askers_[i]; }
  std::span<const std::uint32_t> found(std::size_t i) const {
    const std::size_t first = i == 0 ? 0 : ends_[i - 1];
    return {found_.data() + first, ends_[i] - first};
  }
  std::size_t found_count() const { return found_.size(); }
  std::uint64_t candidate_count() const { return candidate_count_; }
  const char* instructions() const { return scans_.name; }
  std::size_t bytes() const;

 private:
  template <class Index, class Askers, class Find>
  void add(const Index& index, const Askers& askers, const TieJudge& judge, Scan scan, const Find& find);

  const Scans& scans_;
  std::uint64_t candidate_count_ = 0;
  Buffer<Stretch> stretches_;
  Buffer<std::uint32_t> askers_, found_;
  Buffer<std::size_t> ends_;
};

}  // namespace rink::im
