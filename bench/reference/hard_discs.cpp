// Prediction over the cells around, one bucket of events after the other.
#include "bench/reference/hard_discs.h"

#include <algorithm>
#include <cmath>

namespace rink::bench {

HardDiscs::HardDiscs(double side, double radius, const std::vector<Disc>& discs)
    : side_(side), reach_(2.0 * radius) {
  assert(!discs.empty() && side > reach_ && radius > 0.0);
  // Few crossings are worth many discs in sight where flights are long.
  const double spacing = side / std::sqrt(static_cast<double>(discs.size()));
  cell_side_ = std::max(1.2 * spacing - radius, 1.01 * reach_);
  columns_ = std::clamp(static_cast<int>(side / cell_side_), 1, 65'000);
  cell_side_ = side / columns_;
  pitch_ = static_cast<std::size_t>(columns_) + 2;
  cells_.resize(pitch_ * pitch_);
  records_.reserve(discs.size());
  for (const Disc& d : discs) {
    assert(d.x >= radius && d.x <= side - radius && d.y >= radius && d.y <= side - radius);
    const auto index = [&](double at) {
      return static_cast<std::uint16_t>(std::min(static_cast<int>(at / cell_side_), columns_ - 1));
    };
    records_.push_back({d.x, d.y, d.vx, d.vy, d.time, never, nobody, index(d.x), index(d.y), 0, 0});
    enter(count() - 1);
  }
  dues_.resize(records_.size());
  buckets_.assign(1, nobody);
  for (Index disc = 0; disc < count(); ++disc) predict(disc), settle(disc);
}

void HardDiscs::enter(Index disc) {
  Cell& c = cell(records_[disc].column, records_[disc].row);
  assert(c.count < room);
  c.discs[c.count++] = disc;
}

void HardDiscs::leave(Index disc) {
  Cell& c = cell(records_[disc].column, records_[disc].row);
  *std::find(c.discs, c.discs + c.count, disc) = c.discs[c.count - 1];
  --c.count;
}

/// Into the next cell, or never where the box ends.
HardDiscs::Crossing HardDiscs::crossing(const Record& r) const {
  const int across = r.vx > 0.0 ? 1 : -1, along = r.vy > 0.0 ? 1 : -1;
  const auto wait = [&](double at, double speed, int index, int step) {
    const int beyond = index + step;
    if (speed == 0.0 || beyond < 0 || beyond >= columns_) return never;
    return std::max(0.0, ((index + (step > 0)) * cell_side_ - at) / speed);
  };
  const double x = wait(r.x, r.vx, r.column, across), y = wait(r.y, r.vy, r.row, along);
  return x <= y ? Crossing{r.time + x, across, 0} : Crossing{r.time + y, 0, along};
}

void HardDiscs::meet_walls(Record& r) const {
  const double radius = 0.5 * reach_;
  const auto meet = [&](double at, double speed, Index wall) {
    if (speed == 0.0) return;
    const double gap = speed > 0.0 ? side_ - radius - at : at - radius;
    const double time = r.time + std::max(0.0, gap) / std::abs(speed);
    if (time < r.impact) r.impact = time, r.partner = wall;
  };
  meet(r.x, r.vx, wall_x);
  meet(r.y, r.vy, wall_y);
}

/// The first root of |d + w s| = reach, from the later of the two last collisions on, in the form
/// that does not cancel.
void HardDiscs::meet_in(Record& r, Index disc, int column, int row) {
  const Cell& near = cell(column, row);
  for (std::uint32_t k = 0; k < near.count; ++k) {
    const Index other = near.discs[k];
    const Record& o = records_[other];
    const double since = std::max(r.time, o.time), wx = o.vx - r.vx, wy = o.vy - r.vy;
    const double x = o.x - r.x + (o.vx * (since - o.time) - r.vx * (since - r.time)),
                 y = o.y - r.y + (o.vy * (since - o.time) - r.vy * (since - r.time));
    const double closing = -(x * wx + y * wy);
    if (!(closing > 0.0) || other == disc) continue;
    const double gap = x * x + y * y - reach_ * reach_;
    if (gap > 2.001 * closing * (r.impact - since)) continue;
    const double square = wx * wx + wy * wy, miss = x * wy - y * wx,
                 rest = reach_ * reach_ * square - miss * miss;
    if (rest < 0.0) continue;
    const double time = since + std::max(0.0, gap) / (closing + std::sqrt(rest));
    if (time >= r.impact) continue;
    r.impact = time, r.partner = other, r.partner_collisions = o.collisions;
  }
}

void HardDiscs::predict(Index disc) {
  Record& r = records_[disc];
  r.impact = never, r.partner = nobody;
  meet_walls(r);
  for (int row = r.row - 1; row <= r.row + 1; ++row)
    for (int column = r.column - 1; column <= r.column + 1; ++column) meet_in(r, disc, column, row);
}

/// Only those in the three cells that come into sight can be new.
void HardDiscs::cross(Index disc) {
  Record& r = records_[disc];
  const Crossing c = crossing(r);
  leave(disc);
  r.column = static_cast<std::uint16_t>(r.column + c.columns);
  r.row = static_cast<std::uint16_t>(r.row + c.rows);
  enter(disc);
  for (int k = -1; k <= 1; ++k)
    if (c.columns != 0) meet_in(r, disc, r.column + c.columns, r.row + k);
    else meet_in(r, disc, r.column + k, r.row + c.rows);
  settle(disc);
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
    Record& b = records_[a.partner];
    move(b);
    const double x = a.x - b.x, y = a.y - b.y,
                 impulse = (x * (b.vx - a.vx) + y * (b.vy - a.vy)) / (x * x + y * y);
    a.vx += impulse * x, a.vy += impulse * y, b.vx -= impulse * x, b.vy -= impulse * y;
    ++collisions_;
    const Index other = a.partner;
    predict(other), settle(other);
  }
  predict(disc), settle(disc);
}

/// Its next event is known, and noted if it comes in this stretch.
void HardDiscs::settle(Index disc) {
  const double due = std::min(records_[disc].impact, crossing(records_[disc]).time);
  dues_[disc] = due;
  if (due < stretch_end_) note(disc, due);
}

void HardDiscs::note(Index disc, double time) {
  const auto bucket = std::min(
      static_cast<std::size_t>((time - stretch_begin_) * buckets_per_second_), buckets_.size() - 1);
  if (bucket < bucket_) return sort_in(disc, time);
  notes_.push_back({time, disc, buckets_[bucket]});
  buckets_[bucket] = static_cast<Index>(notes_.size() - 1);
}

void HardDiscs::sort_in(Index disc, double time) {
  due_.push_back({time, disc, nobody});
  for (std::size_t k = due_.size() - 1; k > 0 && due_[k - 1].time < due_[k].time; --k)
    std::swap(due_[k - 1], due_[k]);
}

/// As long as a third of the discs need for an event each, by the rate of the last one.
void HardDiscs::open_stretch() {
  const double last = stretch_end_ - stretch_begin_,
               taken = static_cast<double>(events_ - events_before_);
  double length = last > 0.0 && taken > 0.0 ? last * count() / (3.0 * taken) : 0.0;
  const double first = *std::min_element(dues_.begin(), dues_.end());
  if (length == 0.0) {
    double speed = 0.0;
    for (const Record& r : records_)
      speed = std::max({speed, std::abs(r.vx), std::abs(r.vy), 1e-300});
    length = 0.1 * cell_side_ / speed;
  }
  events_before_ = events_;
  stretch_begin_ = first, stretch_end_ = std::max(first + length, std::nextafter(first, never));
  buckets_.assign(count() / 8 + 1, nobody);
  buckets_per_second_ = static_cast<double>(buckets_.size()) / (stretch_end_ - stretch_begin_);
  bucket_ = 0;
  notes_.clear();
  for (Index disc = 0; disc < count(); ++disc)
    if (dues_[disc] < stretch_end_) note(disc, dues_[disc]);
}

/// Who has the first event of the stretch; nobody if it is over.
HardDiscs::Index HardDiscs::next() {
  for (;;) {
    for (; !due_.empty(); due_.pop_back())
      if (dues_[due_.back().disc] == due_.back().time) return due_.back().disc;
    if (bucket_ == buckets_.size()) return nobody;
    // Whoever comes in the bucket after that is fetched meanwhile.
    if (bucket_ + 1 < buckets_.size())
      for (Index k = buckets_[bucket_ + 1]; k != nobody; k = notes_[k].next) {
        __builtin_prefetch(&records_[notes_[k].disc]);
        __builtin_prefetch(&dues_[notes_[k].disc]);
      }
    const Index first = buckets_[bucket_++];
    for (Index k = first; k != nobody; k = notes_[k].next)
      if (dues_[notes_[k].disc] == notes_[k].time) sort_in(notes_[k].disc, notes_[k].time);
  }
}

void HardDiscs::advance(double until, const std::function<void(const Collision&)>& see) {
  assert(until >= now_ && until < never);
  for (;;) {
    const Index disc = next();
    if (disc == nobody) {
      if (stretch_end_ > until) break;
      if (*std::min_element(dues_.begin(), dues_.end()) > until) break;
      open_stretch();
      continue;
    }
    const double time = dues_[disc];
    if (time > until) break;
    due_.pop_back();
    ++events_;
    const Record& r = records_[disc];
    const Index partner = r.partner;
    if (time < r.impact) cross(disc);
    else if (partner < wall_y && records_[partner].collisions != r.partner_collisions)
      predict(disc), settle(disc);
    else {
      collide(disc, time);
      if (see && partner < wall_y) see({time, std::min(disc, partner), std::max(disc, partner)});
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
  for (const Record& a : records_)
    for (int row = a.row - 1; row <= a.row + 1; ++row)
      for (int column = a.column - 1; column <= a.column + 1; ++column) {
        const Cell& near = cell(column, row);
        for (std::uint32_t k = 0; k < near.count; ++k) {
          const Record& b = records_[near.discs[k]];
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
