// Keeps before and now of every region and the list of those that differ.
#include "im/region_history.h"

#include <algorithm>
#include <cassert>

namespace rink::im {

bool RegionHistory::set(std::uint32_t id, const Region& region) {
  assert(is_valid(region) && id < id_max);
  if (id >= motions_.size()) grow(id + std::size_t{1});
  Motion& motion = motions_[id];
  if (motion.now == region) return false;
  motion.now = region;
  if (!is_listed(id)) moved_.push_back(id);
  listed_[id / 64] |= std::uint64_t{1} << id % 64;
  return true;
}

void RegionHistory::grow(std::size_t count) {
  const std::size_t old_count = motions_.size(), old_words = listed_.size();
  motions_.resize(count);
  std::fill(motions_.data() + old_count, motions_.data() + count, Motion{});
  listed_.resize((count + 63) / 64);
  std::fill(listed_.data() + old_words, listed_.data() + listed_.size(), 0);
}

bool RegionHistory::remove(std::uint32_t id) {
  if (id >= motions_.size() || is_nowhere(motions_[id].now)) return false;
  motions_[id] = Motion{};
  return true;
}

void RegionHistory::unlist(std::uint32_t id) { listed_[id / 64] &= ~(std::uint64_t{1} << id % 64); }

std::span<const std::uint32_t> RegionHistory::take_moved() {
  std::size_t kept = 0;
  bool is_sorted = true;
  for (const std::uint32_t id : moved_.span()) {
    if (motions_[id].now == motions_[id].before) {
      unlist(id);
      continue;
    }
    is_sorted &= kept == 0 || moved_[kept - 1] < id;
    moved_[kept++] = id;
  }
  moved_.resize(kept);
  // Whoever moves everything does so in order; then there is nothing to sort.
  if (!is_sorted) std::sort(moved_.data(), moved_.data() + kept);
  return moved_.span();
}

void RegionHistory::settle() {
  for (const std::uint32_t id : moved_.span()) {
    motions_[id].before = motions_[id].now;
    unlist(id);
  }
  moved_.clear();
}

}  // namespace rink::im
