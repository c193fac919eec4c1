// Sorts boxes into few classes of similar size, so that one huge box does not widen every query.
#pragma once

#include <array>
#include <bit>
#include <cassert>
#include <cstdint>

namespace rink::im {

/// Classes by powers of two of the longer side. Count all sides, then `choose`, then ask for each
/// one's level.
class SizeLevels {
 public:
  static constexpr std::size_t level_max = 8;

  void clear() {
    counts_.fill(0);
    run_bucket_ = run_length_ = 0;
  }
  /// Sides alike come one after the other; counting each in memory would wait for the one before.
  void count(float side) {
    assert(side >= 0.0f);
    const std::uint32_t bucket = bucket_of(side);
    if (bucket != run_bucket_) end_run(bucket);
    ++run_length_;
  }
  /// Levels from the largest boxes down, each of a factor of at most eight (the last of all below);
  /// a level with few boxes joins the one above it. There is at least one level, and every side has
  /// one, counted or not.
  void choose();

  std::size_t size() const { return size_; }
  std::size_t level(float side) const {
    assert(size_ > 0);  // `choose` was called
    return level_of_[bucket_of(side)];
  }
  std::size_t population(std::size_t level) const {
    assert(level < size_);
    return populations_[level];
  }
  /// Asserts that each size has a level, larger ones an earlier one, and populations add up.
  void check() const;

 private:
  void close_level();
  void end_run(std::uint32_t next) {
    counts_[run_bucket_] += run_length_;
    run_bucket_ = next;
    run_length_ = 0;
  }
  static std::uint32_t bucket_of(float side) {
    return std::bit_cast<std::uint32_t>(side) >> 23 & 0xFFu;
  }

  std::array<std::uint32_t, 256> counts_{};
  std::array<std::uint8_t, 256> level_of_{};
  std::array<std::size_t, level_max> populations_{};
  std::size_t size_ = 0;
  std::uint32_t run_bucket_ = 0, run_length_ = 0;
};

}  // namespace rink::im
