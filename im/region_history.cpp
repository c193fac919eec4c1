// Keeps before and now of every region and the list of those that differ.
#include "im/region_history.h"

#include <algorithm>
#include <cassert>

namespace rink::im {

bool RegionHistory::set(std::uint32_t id, const Region& region) {
  assert(is_valid(region));
  if (id >= motions_.size()) {
    motions_.resize(id + std::size_t{1});
    is_listed_.resize(id + std::size_t{1});
  }
  Motion& motion = motions_[id];
  if (motion.now == region) return false;
  motion.now = region;
  if (!is_listed_[id]) moved_.push_back(id);
  is_listed_[id] = 1;
  return true;
}

bool RegionHistory::remove(std::uint32_t id) {
  if (id >= motions_.size() || is_nowhere(motions_[id].now)) return false;
  motions_[id] = Motion{};
  return true;
}

std::span<const std::uint32_t> RegionHistory::take_moved() {
  const auto is_still = [this](std::uint32_t id) {
    if (motions_[id].now != motions_[id].before) return false;
    is_listed_[id] = 0;
    return true;
  };
  std::erase_if(moved_, is_still);
  // Whoever moves everything does so in order; then there is nothing to sort.
  if (!std::is_sorted(moved_.begin(), moved_.end())) std::sort(moved_.begin(), moved_.end());
  return moved_;
}

void RegionHistory::settle() {
  for (const std::uint32_t id : moved_) {
    motions_[id].before = motions_[id].now;
    is_listed_[id] = 0;
  }
  moved_.clear();
}

}  // namespace rink::im
