// Chooses the size levels greedily from the largest boxes down.
#include "im/matching/index/size_levels.h"

#include <algorithm>
#include <functional>

#include "im/basics/checked.h"

namespace rink::im {
namespace {

/// A box eight times smaller than the widest of its level costs a few tests more; a level of its
/// own costs a visit by every query.
constexpr std::size_t octaves_per_level = 3;
/// A level with fewer boxes than this part of the one above costs more visits than it saves tests.
constexpr std::size_t merged_below = 16;

}  // namespace

/// Lets the last level join the one above it if it is small.
void SizeLevels::close_level() {
  if (size_ < 2 || populations_[size_ - 1] * merged_below >= populations_[size_ - 2]) return;
  populations_[size_ - 2] += populations_[size_ - 1];
  for (std::uint8_t& level : level_of_)
    if (level == size_ - 1) level = static_cast<std::uint8_t>(size_ - 2);
  --size_;
}

void SizeLevels::choose() {
  end_run(0);
  size_ = 0;
  std::size_t top = 0;  // bucket of the largest boxes of the present level
  for (std::size_t bucket = counts_.size(); bucket-- > 0;) {
    level_of_[bucket] = static_cast<std::uint8_t>(size_ == 0 ? 0 : size_ - 1);
    if (counts_[bucket] == 0) continue;
    if (size_ == 0 || (bucket + octaves_per_level <= top && size_ < level_max)) {
      close_level();
      populations_[size_++] = 0;
      top = bucket;
    }
    level_of_[bucket] = static_cast<std::uint8_t>(size_ - 1);
    populations_[size_ - 1] += counts_[bucket];
  }
  close_level();
  if (size_ == 0) populations_[size_++] = 0;
  if constexpr (checks_whole_structures) check();
}

void SizeLevels::check() const {
  assert(1 <= size_ && size_ <= level_max);
  assert(run_length_ == 0);  // all sides are in the counts
  assert(std::is_sorted(level_of_.begin(), level_of_.end(), std::greater<>()));
  assert(level_of_.front() < size_);
  std::array<std::size_t, level_max> populations{};
  for (std::size_t bucket = 0; bucket < counts_.size(); ++bucket)
    populations[level_of_[bucket]] += counts_[bucket];
  assert(std::equal(populations.begin(), populations.begin() + size_, populations_.begin()));
}

}  // namespace rink::im
