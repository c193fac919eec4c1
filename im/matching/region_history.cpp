// Keeps before and now of every region and the list of those that differ.
#include "im/matching/region_history.h"

#include <algorithm>
#include <bit>
#include <cassert>

#include "im/basics/checked.h"

namespace rink::im {

bool RegionHistory::set(std::uint32_t id, const Region& region) {
  assert(is_valid(region) && id < id_max);
  if (id >= motions_.size()) grow(id + std::size_t{1});
  Motion& motion = motions_[id];
  if (motion.now == region) return false;
  list(id);
  if (absent_count_ != 0 && is_nowhere(motion.now)) --absent_count_;
  motion.now = region;
  return true;
}

void RegionHistory::touch(std::uint32_t id) {
  if (contains(id)) list(id);
}

/// The place that it leaves is its former one, if it is the first since the last match.
void RegionHistory::list(std::uint32_t id) {
  if (is_listed(id)) return;
  is_ascending_ = is_ascending_ && (moved_.empty() || moved_[moved_.size() - 1] < id);
  moved_.push_back(id);
  listed_[id / 64] |= std::uint64_t{1} << id % 64;
  motions_[id].before = motions_[id].now;
}

void RegionHistory::grow(std::size_t count) {
  assert(count > motions_.size());
  const std::size_t old_count = motions_.size(), old_words = listed_.size();
  motions_.resize(count);
  std::fill(motions_.data() + old_count, motions_.data() + count, Motion{});
  absent_count_ += count - old_count;
  listed_.resize((count + 63) / 64);
  std::fill(listed_.data() + old_words, listed_.data() + listed_.size(), 0);
}

bool RegionHistory::remove(std::uint32_t id) {
  if (id >= motions_.size() || is_nowhere(motions_[id].now)) return false;
  motions_[id] = Motion{};
  ++absent_count_;
  has_removed_ = true;
  return true;
}

void RegionHistory::unlist(std::uint32_t id) { listed_[id / 64] &= ~(std::uint64_t{1} << id % 64); }

/// Takes those out of the list that are nowhere.
void RegionHistory::drop_removed() {
  std::size_t kept = 0;
  for (const std::uint32_t id : moved_.span()) {
    moved_[kept] = id;
    if (is_nowhere(motions_[id].now)) unlist(id);
    else ++kept;
  }
  moved_.resize(kept);
  has_removed_ = false;
}

std::span<const std::uint32_t> RegionHistory::take_moved() {
  for (const std::uint32_t id : settled_.span())
    if (!is_listed(id)) motions_[id].before = motions_[id].now;
  settled_.clear();
  if (has_removed_) drop_removed();
  // A caller that moves everything does so in order; then there is nothing to sort.
  if (!is_ascending_) std::sort(moved_.data(), moved_.data() + moved_.size());
  if constexpr (checks_whole_structures) check();
  return moved_.span();
}

void RegionHistory::settle() {
  assert(settled_.empty());  // `take_moved` has brought those up to date that settled before
  if (moved_.size() > listed_.size()) listed_.fill(listed_.size(), 0);
  else
    for (const std::uint32_t id : moved_.span()) unlist(id);
  settled_.clear();
  std::swap(moved_, settled_);
  is_ascending_ = true;
  if constexpr (checks_whole_structures) check();
}

void RegionHistory::check() const {
  assert(listed_.size() == (motions_.size() + 63) / 64);
  [[maybe_unused]] std::size_t listed = 0, absent = 0, out_of_date = 0;
  for (const std::uint64_t word : listed_.span())
    listed += static_cast<std::size_t>(std::popcount(word));
  assert(listed == moved_.size());
  assert(!is_ascending_ || std::is_sorted(moved_.span().begin(), moved_.span().end()));
  for ([[maybe_unused]] const std::uint32_t id : moved_.span()) {
    assert(is_listed(id));
    assert(has_removed_ || !is_nowhere(motions_[id].now));
  }
  for (std::uint32_t id = 0; id < motions_.size(); ++id) {
    const Motion& motion = motions_[id];
    absent += is_nowhere(motion.now) ? 1u : 0u;
    assert(!is_nowhere(motion.now) || is_nowhere(motion.before));  // its past is forgotten too
    out_of_date += !is_listed(id) && motion.before != motion.now ? 1u : 0u;
  }
  assert(absent == absent_count_ && out_of_date <= settled_.size());
}

}  // namespace rink::im
