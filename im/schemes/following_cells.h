// The default size of cells: it follows the subscriptions, since what cells let through beyond a
// subscription depends on their size against its own.
#pragma once

#include <algorithm>
#include <cassert>
#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "im/filter.h"
#include "im/marks.h"
#include "im/schemes/cells.h"

namespace rink::im {

/// Cells are a fifth of the subscriptions' median side when they are chosen, and stay while they
/// are from a seventh to a third of it. Of n sides the median is the one with (n - 1) / 2, rounded
/// down, before it in ascending order; a region's side is half the sum of its width and height.
class SubscriptionSides {
 public:
  static constexpr double least = 1e-300;  ///< m; shorter ones, as of points, do not count

  explicit SubscriptionSides(double cell_size) : cell_size_(cell_size) {}

  void set(Subscriber subscriber, const Region& region) {
    set(subscriber, std::min((0.5 * region.high_x - 0.5 * region.low_x) +
                                 (0.5 * region.high_y - 0.5 * region.low_y),
                             largest));
  }
  void remove(Subscriber subscriber) { set(subscriber, 0.0); }

  /// The size [m] that cells have from now on, chosen anew if the present one no longer suits.
  double choose() {
    if (count_ == 0) return cell_size_;
    const std::size_t rank = (count_ - 1) / 2;
    const bool is_less = below_ > rank, is_more = count_ - above_ <= rank;
    if (!is_less && !is_more) return cell_size_;
    sorted_.clear();
    for (const double side : sides_)
      if (counts(side)) sorted_.push_back(side);
    assert(sorted_.size() == count_);
    const auto median = sorted_.begin() + static_cast<std::ptrdiff_t>(rank);
    std::nth_element(sorted_.begin(), median, sorted_.end());
    cell_size_ = 0.2 * *median;
    below_ = above_ = 0;
    for (const double side : sorted_) below_ += is_below(side), above_ += is_above(side);
    return cell_size_;
  }

 private:
  static bool counts(double side) { return side >= least; }
  bool is_below(double side) const { return side < 3.0 * cell_size_; }
  bool is_above(double side) const { return 7.0 * cell_size_ < side; }

  void set(Subscriber subscriber, double side) {
    if (subscriber >= sides_.size()) sides_.resize(subscriber + std::size_t{1});
    const double before = std::exchange(sides_[subscriber], side);
    if (before == side) return;
    if (counts(before)) --count_, below_ -= is_below(before), above_ -= is_above(before);
    if (counts(side)) ++count_, below_ += is_below(side), above_ += is_above(side);
  }

  double cell_size_;
  std::vector<double> sides_;  // by subscriber; 0 if it is not there
  std::vector<double> sorted_;
  std::size_t count_ = 0, below_ = 0, above_ = 0;
};

/// A scheme with cells whose size nobody gave. Keeps all regions, 32 bytes each or 64 once one is
/// swept, and hands them to the scheme anew when its cells change.
template <class Scheme>
class FollowingCells final : public Scheme {
 public:
  FollowingCells(const Region& world, double cell_size)
      : Scheme(world, cell_size), sides_(cell_size) {}

  void set_update_region(Entity entity, const Region& region) override {
    updates_.keep(entity, region, region);
    Scheme::set_update_region(entity, region);
  }
  void set_subscription_region(Subscriber subscriber, const Region& region) override {
    subscriptions_.keep(subscriber, region, region);
    sides_.set(subscriber, region);
    Scheme::set_subscription_region(subscriber, region);
  }
  void set_swept_update_region(Entity entity, const Region& from, const Region& to) override {
    if (from == to) return set_update_region(entity, from);
    Scheme::set_swept_update_region(entity, from, to);
    updates_.keep(entity, from, to);  // the scheme may have set the hull of both in between
  }
  void set_swept_subscription_region(Subscriber subscriber, const Region& from,
                                     const Region& to) override {
    if (from == to) return set_subscription_region(subscriber, from);
    Scheme::set_swept_subscription_region(subscriber, from, to);
    subscriptions_.keep(subscriber, from, to);
    sides_.set(subscriber, from);
  }
  void remove_subscriber(Subscriber subscriber) override {
    sides_.remove(subscriber);
    Scheme::remove_subscriber(subscriber);
  }
  std::span<const Change> match() override {
    if (const double size = sides_.choose(); size != this->cell_size()) resize(size);
    return Scheme::match();
  }

 private:
  /// The places between which each region sweeps, equal ones for one that does not.
  class Ways {
   public:
    void keep(std::uint32_t id, const Region& from, const Region& to) {
      if (id >= from_.size()) from_.resize(id + std::size_t{1});
      from_[id] = from;
      if (from == to) return void(swept_.unset(id));
      swept_.set(id);
      if (id >= to_.size()) to_.resize(id + std::size_t{1});
      to_[id] = to;
    }
    const Region& from(std::uint32_t id) const { return from_[id]; }
    const Region& to(std::uint32_t id) const { return swept_.has(id) ? to_[id] : from_[id]; }

   private:
    std::vector<Region> from_, to_;
    Marks swept_;
  };

  void resize(double size) {
    Scheme::resize_cells(size);
    for (Entity entity = 0; entity < this->entities_.size(); ++entity)
      if (this->entities_.contains(entity)) {
        const Region from = updates_.from(entity), to = updates_.to(entity);
        set_swept_update_region(entity, from, to);
      }
    for (Subscriber subscriber = 0; subscriber < this->subscribers_.size(); ++subscriber)
      if (this->subscribers_.contains(subscriber)) {
        const Region from = subscriptions_.from(subscriber), to = subscriptions_.to(subscriber);
        set_swept_subscription_region(subscriber, from, to);
      }
  }

  Ways updates_, subscriptions_;
  SubscriptionSides sides_;
};

/// The scheme with cells of the settings' size, or of one that follows the subscriptions.
template <class Scheme>
std::unique_ptr<Filter> make_celled_filter(const FilterSettings& settings) {
  if (settings.cell_size > 0.0) return std::make_unique<Scheme>(settings.world, settings.cell_size);
  return std::make_unique<FollowingCells<Scheme>>(settings.world, cell_size_of(settings));
}

}  // namespace rink::im
