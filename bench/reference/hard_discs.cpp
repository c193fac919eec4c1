// Prediction over the cells around, and events one bucket after the other.
#include "bench/reference/hard_discs.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <stdexcept>

namespace rink::bench {

HardDiscs::HardDiscs(double side, double radius, const std::vector<Disc>& discs)
    : side_(side), reach_(2.0 * radius) {
  assert(!discs.empty() && discs.size() < wall_y && radius > 0.0 && side > reach_);
  // Few crossings are worth many discs in sight where flights are long.
  const double spacing = side / std::sqrt(static_cast<double>(discs.size())),
               wanted = std::max(1.2 * spacing - radius, 1.01 * reach_);
  columns_ = static_cast<std::uint32_t>(std::clamp(side / wanted, 1.0, 32'000.0));
  const double cell_side = side / columns_, around = cell_side + reach_;
  cell_size_ = around * around < 2.0 * std::sqrt(3.0) * radius * radius * narrow ? narrow : wide;
  pitch_ = columns_ + std::size_t{2};
  for (const std::size_t k : {0, 1}) {
    steps_[k] = 2 * k - 1, across_[k] = pitch_;
    steps_[2 + k] = steps_[k] * pitch_, across_[2 + k] = 1;
  }
  for (std::uint32_t k = 0; k <= columns_; ++k) edges_.push_back(k * cell_side);
  edges_.front() = -never, edges_.back() = never;
  cells_.resize(pitch_ * pitch_ * cell_size_);
  records_.reserve(discs.size());
  for (const Disc& d : discs) {
    assert(d.x >= radius && d.x <= side - radius && d.y >= radius && d.y <= side - radius);
    const auto index = [&](double at) {
      return std::min(static_cast<std::uint32_t>(at / cell_side), columns_ - 1);
    };
    records_.push_back({d.x, d.y, d.vx, d.vy, d.time, never, nobody, index(d.x) & 0x7fffu,
                        index(d.y) & 0x7fffu, 0, 0, 0});
    enter(count() - 1);
  }
  dues_.resize(records_.size());
  buckets_.assign(1, nobody);
  for (Index disc = 0; disc < count(); ++disc) predict(disc);
}

void HardDiscs::enter(Index disc) {
  Index* const cell = &cells_[cell_of(records_[disc]) * cell_size_];
  if (cell[0] + 1 == cell_size_) throw std::length_error("HardDiscs: too many discs in a cell");
  cell[++cell[0]] = disc;
}

void HardDiscs::leave(Index disc) {
  Index* const cell = &cells_[cell_of(records_[disc]) * cell_size_];
  *std::find(cell + 1, cell + cell[0], disc) = cell[cell[0]];
  --cell[0];
}

/// The discs of three cells, as many as there are, without a branch on each one's number.
HardDiscs::Index* HardDiscs::gather(std::size_t centre, std::size_t across, Index* end) const {
  for (const std::size_t k : {centre - across, centre, centre + across}) {
    const Index* const cell = &cells_[k * cell_size_];
    std::memcpy(end, cell + 1, (narrow - 1) * sizeof(Index));
    if (cell[0] >= narrow) std::copy(cell + narrow, cell + cell[0] + 1, end + narrow - 1);
    end += cell[0];
  }
  return end;
}

HardDiscs::Index* HardDiscs::gather_around(const Record& r, Index* end) const {
  const std::size_t cell = cell_of(r);
  return gather(cell + pitch_, 1, gather(cell, 1, gather(cell - pitch_, 1, end)));
}

/// Of the cells that its next crossing brings into sight.
HardDiscs::Index* HardDiscs::gather_beyond(const Record& r, Index* end) const {
  return gather(cell_of(r) + 2 * steps_[r.direction], across_[r.direction], end);
}

void HardDiscs::meet_wall(Record& r, double at, double speed, Index wall) const {
  const double radius = 0.5 * reach_, gap = speed > 0.0 ? side_ - radius - at : at - radius;
  const double time = r.time + std::max(0.0, gap) / std::abs(speed);
  if (time < r.impact) r.impact = time, r.partner = wall;
}

/// When it enters the next cell; in the outer cells it meets the wall instead.
double HardDiscs::fly(Record& r) const {
  const bool right = r.vx > 0.0, up = r.vy > 0.0;
  const double x = r.vx == 0.0 ? never : (edges_[r.column + right] - r.x) / r.vx,
               y = r.vy == 0.0 ? never : (edges_[r.row + up] - r.y) / r.vy;
  if (x == never && r.vx != 0.0) meet_wall(r, r.x, r.vx, wall_x);
  if (y == never && r.vy != 0.0) meet_wall(r, r.y, r.vy, wall_y);
  r.direction = (x <= y ? right : 2u + up) & 3u;
  return r.time + std::max(0.0, std::min(x, y));
}

inline HardDiscs::Approach HardDiscs::approach(const Record& a, const Record& b) const {
  const double since = std::max(a.time, b.time), wx = b.vx - a.vx, wy = b.vy - a.vy,
               x = b.x - a.x + (b.vx * (since - b.time) - a.vx * (since - a.time)),
               y = b.y - a.y + (b.vy * (since - b.time) - a.vy * (since - a.time)),
               miss = x * wy - y * wx;
  return {since, -(x * wx + y * wy), x * x + y * y - reach_ * reach_,
          reach_ * reach_ * (wx * wx + wy * wy) - miss * miss};
}

/// The first root of |d + w s| = reach, in the form that does not cancel.
void HardDiscs::meet(Record& r, const Index* near, const Index* end) const {
  Index likely[near_max];
  std::size_t count = 0;
  for (; near != end; ++near) {
    const Approach a = approach(r, records_[*near]);
    likely[count] = *near;
    count +=
        (a.closing > 0.0) & (a.rest >= 0.0) & (a.gap <= 2.001 * a.closing * (r.impact - a.since));
  }
  for (std::size_t k = 0; k < count; ++k) {
    const Record& other = records_[likely[k]];
    const Approach a = approach(r, other);
    const double time = a.since + std::max(0.0, a.gap) / (a.closing + std::sqrt(a.rest));
    // Whoever meets another one before will look for its next partner then, and find this disc.
    if (time >= r.impact || other.impact < time) continue;
    r.impact = time, r.partner = likely[k], r.partner_collisions = other.collisions;
  }
}

void HardDiscs::predict(Index disc) {
  Record& r = records_[disc];
  Index near[near_max];
  r.impact = never, r.partner = nobody;
  const double crossing = fly(r);
  meet(r, near, gather_around(r, near));
  settle(disc, crossing);
}

/// Only those in the three cells that come into sight can be new.
void HardDiscs::cross(Index disc) {
  Record& r = records_[disc];
  Index near[near_max];
  const Index* const end = gather_beyond(r, near);
  leave(disc);
  const std::uint32_t step = r.direction & 1u ? 1u : ~0u;
  if (r.direction < 2) r.column = (r.column + step) & 0x7fff;
  else r.row = (r.row + step) & 0x7fff;
  enter(disc);
  const double crossing = fly(r);
  meet(r, near, end);
  settle(disc, crossing);
}

void HardDiscs::collide(Index disc, double time) {
  Record& a = records_[disc];
  const auto move = [&](Record& r) {
    r.x += r.vx * (time - r.time), r.y += r.vy * (time - r.time);
    r.time = time;
    ++r.collisions;
  };
  move(a);
  if (a.partner >= wall_y) {
    (a.partner == wall_x ? a.vx : a.vy) *= -1.0;
  } else {
    const Index other = a.partner;
    Record& b = records_[other];
    move(b);
    const double x = a.x - b.x, y = a.y - b.y,
                 impulse = (x * (b.vx - a.vx) + y * (b.vy - a.vy)) / (x * x + y * y);
    a.vx += impulse * x, a.vy += impulse * y, b.vx -= impulse * x, b.vy -= impulse * y;
    ++collisions_;
    predict(other);
  }
  predict(disc);
}

/// Its next event is known, and noted if it comes in this stretch.
void HardDiscs::settle(Index disc, double crossing) {
  const double due = std::min(records_[disc].impact, crossing);
  dues_[disc] = due;
  if (due < stretch_.end) note(disc, due);
}

void HardDiscs::note(Index disc, double time) {
  const auto bucket =
      std::min(static_cast<std::size_t>((time - stretch_.begin) * stretch_.buckets_per_second),
               buckets_.size() - 1);
  if (bucket < stretch_.next_bucket) return sort_in(disc, time);
  notes_.push_back({time, disc, buckets_[bucket]});
  buckets_[bucket] = static_cast<Index>(notes_.size() - 1);
}

void HardDiscs::sort_in(Index disc, double time) {
  ahead_.push_back({time, disc, nobody});
  for (std::size_t k = ahead_.size() - 1; k > head_ && ahead_[k].time < ahead_[k - 1].time; --k)
    std::swap(ahead_[k], ahead_[k - 1]);
}

double HardDiscs::stretch_length() const {
  const double last = stretch_.end - stretch_.begin,
               taken = static_cast<double>(events_ - stretch_.events_before);
  if (last > 0.0 && taken > 0.0) return last * count() / (4.0 * taken);
  double speed = 1e-300;
  for (const Record& r : records_) speed = std::max({speed, std::abs(r.vx), std::abs(r.vy)});
  return 0.1 * side_ / columns_ / speed;
}

/// As long as a quarter of the discs need for an event each, by the rate of the last one. False if
/// nothing happens until then.
bool HardDiscs::open_stretch(double until) {
  const double length = stretch_length(), first = *std::min_element(dues_.begin(), dues_.end());
  if (first > until) return false;
  stretch_.events_before = events_;
  stretch_.begin = first, stretch_.end = std::max(first + length, std::nextafter(first, never));
  buckets_.assign(count() / 4 + 1, nobody);
  stretch_.buckets_per_second =
      static_cast<double>(buckets_.size()) / (stretch_.end - stretch_.begin);
  stretch_.next_bucket = 0;
  notes_.clear();
  for (Index disc = 0; disc < count(); ++disc)
    if (dues_[disc] < stretch_.end) note(disc, dues_[disc]);
  return true;
}

/// What process() will read of the cells, and the partner.
void HardDiscs::fetch_cells(Index disc) const {
  const Record& r = records_[disc];
  const std::size_t cell = cell_of(r);
  const auto fetch = [&](std::size_t centre, std::size_t across) {
    for (const std::size_t k : {centre - across, centre, centre + across})
      __builtin_prefetch(&cells_[k * cell_size_]);
  };
  if (dues_[disc] < r.impact) {
    const std::size_t step = steps_[r.direction];
    fetch(cell + step + step, across_[r.direction]);
    __builtin_prefetch(&cells_[cell * cell_size_]);
    __builtin_prefetch(&cells_[(cell + step) * cell_size_]);
  } else {
    for (const std::size_t middle : {cell - pitch_, cell, cell + pitch_}) fetch(middle, 1);
    if (r.partner < wall_y) __builtin_prefetch(&records_[r.partner]);
  }
}

void HardDiscs::fetch_discs(Index disc) const {
  const Record& r = records_[disc];
  Index near[near_max];
  const Index* const end = dues_[disc] < r.impact ? gather_beyond(r, near) : gather_around(r, near);
  for (const Index* k = near; k != end; ++k) __builtin_prefetch(&records_[*k]);
}

void HardDiscs::order_next_bucket() {
  for (Index k = buckets_[stretch_.next_bucket++]; k != nobody; k = notes_[k].next) {
    __builtin_prefetch(&records_[notes_[k].disc]);
    __builtin_prefetch(&dues_[notes_[k].disc]);
    sort_in(notes_[k].disc, notes_[k].time);
  }
}

/// Three steps, each a while before the next, as each reads what the one before it fetched.
void HardDiscs::look_ahead() {
  if (head_ >= 512) {
    ahead_.erase(ahead_.begin(), ahead_.begin() + static_cast<std::ptrdiff_t>(head_));
    head_ = 0;
  }
  while (ahead_.size() < head_ + order_ahead && stretch_.next_bucket < buckets_.size())
    order_next_bucket();
  if (head_ + cells_ahead < ahead_.size()) fetch_cells(ahead_[head_ + cells_ahead].disc);
  if (head_ + discs_ahead < ahead_.size()) fetch_discs(ahead_[head_ + discs_ahead].disc);
}

/// The next event of the stretch, at head_. False if it is over.
bool HardDiscs::find_next() {
  for (;; ++head_) {
    look_ahead();
    if (head_ == ahead_.size()) return false;
    if (dues_[ahead_[head_].disc] == ahead_[head_].time) return true;
  }
}

void HardDiscs::process(Index disc, double time, const See& see) {
  const Record& r = records_[disc];
  const Index partner = r.partner;
  ++events_;
  if (time < r.impact) return cross(disc);
  if (partner < wall_y && records_[partner].collisions != r.partner_collisions)
    return predict(disc);
  collide(disc, time);
  if (see && partner < wall_y) see({time, std::min(disc, partner), std::max(disc, partner)});
}

void HardDiscs::advance(double until, const See& see) {
  assert(until >= now_ && until < never);
  for (;;) {
    if (find_next()) {
      const Note next = ahead_[head_];
      if (next.time > until) break;
      ++head_;
      process(next.disc, next.time, see);
    } else if (stretch_.end > until || !open_stretch(until)) {
      break;
    }
  }
  now_ = until;
}

double HardDiscs::kinetic_energy() const {
  double sum = 0.0;
  for (const Record& r : records_) sum += 0.5 * (r.vx * r.vx + r.vy * r.vy);
  return sum;
}

double HardDiscs::max_overlap() const {
  double deepest = 0.0;
  Index near[near_max];
  for (const Record& a : records_) {
    const Index* const end = gather_around(a, near);
    for (const Index* k = near; k != end; ++k) {
      const Record& b = records_[*k];
      if (&a == &b) continue;
      const auto at = [&](double x, double v, double since) { return x + v * (now_ - since); };
      const double x = at(b.x, b.vx, b.time) - at(a.x, a.vx, a.time),
                   y = at(b.y, b.vy, b.time) - at(a.y, a.vy, a.time);
      deepest = std::max(deepest, reach_ - std::sqrt(x * x + y * y));
    }
  }
  return deepest;
}

}  // namespace rink::bench
