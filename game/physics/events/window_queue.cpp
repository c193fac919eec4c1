// Windows that hold a third of the pending events.
#include "game/physics/events/window_queue.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>

namespace rink::physics::inline RINK_PRECISION {

namespace {
/// How many pending events are asked how long a window should be.
constexpr std::size_t sample_size = 48;
}  // namespace

void WindowQueue::set(std::uint32_t body, Real time, std::uint32_t lower, std::uint32_t higher) {
  EventOrder& entry = entries_[body];
  const EventOrder order{time, lower, higher};
  if (entry == order) return;
  entry = order;
  if (!(time < std::numeric_limits<Real>::infinity())) return;
  list(body);
  if (time <= bins_.end()) bins_.add(body, order);
  else later_begin_ = std::min(later_begin_, time);
}

/// So that about a third of what is pending falls into the window; at least one event.
Real WindowQueue::next_end(Real begin) const {
  std::array<Real, sample_size> times;
  const std::size_t stride = std::max<std::size_t>(1, listed_.size() / sample_size);
  std::size_t count = 0;
  for (std::size_t k = 0; k < listed_.size() && count < sample_size; k += stride) {
    const Real time = entries_[listed_[k]].time;
    if (time < std::numeric_limits<Real>::infinity()) times[count++] = time;
  }
  if (count == 0) return begin;
  const auto third = times.begin() + static_cast<std::ptrdiff_t>(count / 3);
  std::nth_element(times.begin(), third, times.begin() + static_cast<std::ptrdiff_t>(count));
  return std::max(begin, *third);
}

/// The next window; false if nothing comes by `until`.
bool WindowQueue::open(Real until) {
  constexpr Real infinity = std::numeric_limits<Real>::infinity();
  while (later_begin_ <= until && later_begin_ < infinity) {
    const Real begin = later_begin_, end = next_end(begin);
    bins_.open(begin, end, listed_.size() / 3);
    later_begin_ = infinity;
    bool is_empty = true;
    std::size_t kept = 0;
    for (const std::uint32_t body : listed_) {
      const EventOrder& entry = entries_[body];
      if (!(entry.time < infinity)) {
        is_listed_[body] = 0;
        continue;
      }
      listed_[kept++] = body;
      if (entry.time <= end) bins_.add(body, entry), is_empty = false;
      else later_begin_ = std::min(later_begin_, entry.time);
    }
    listed_.resize(kept);
    if (!is_empty) return true;
  }
  return false;
}

void WindowQueue::reopen(Real begin, Real end, std::span<const std::uint32_t> bodies) {
  bins_.open(begin, end, bodies.size());
  // Or later, but not in this window: the next open() finds out.
  later_begin_ = std::nextafter(end, std::numeric_limits<Real>::infinity());
  for (const std::uint32_t body : bodies)
    if (entries_[body].time <= end) bins_.add(body, entries_[body]);
}

std::uint32_t WindowQueue::first(Real until) {
  for (;;) {
    const std::uint32_t body = bins_.first(entries_.data());
    if (body != none) return entries_[body].time <= until ? body : none;
    if (!open(until)) return none;
  }
}

}  // namespace rink::physics::inline RINK_PRECISION
