// The stage `swept`: regions that reach ahead along known flights, and the exact times at which
// pairs begin and cease to touch.
#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "im/basics/checked.h"
#include "im/composition/parts.h"
#include "im/schemes/candidate_pairs.h"
#include "im/stages/flight.h"
#include "im/stages/stages.h"

namespace rink::im {
namespace {

/// The flights of all entities, or of all subscribers.
class Flights {
 public:
  struct Own {
    Flight flight;
    HalfExtent half;
    double holds_until = 0.0;  ///< of the swept region that the inner filter has
    bool is_known = false;
    bool is_given = false;   ///< has a flight that was set, and not a region alone
    bool is_news = false;    ///< since the last match
    bool is_listed = false;  ///< among those in flight
  };

  void put(std::uint32_t id, const Region& region, double now) {
    if (id >= all_.size()) all_.resize(id + std::size_t{1});
    Own& own = all_[id];
    const HalfExtent half{0.5 * region.high_x - 0.5 * region.low_x,
                          0.5 * region.high_y - 0.5 * region.low_y};
    const Flight flight{0.5 * region.low_x + 0.5 * region.high_x,
                        0.5 * region.low_y + 0.5 * region.high_y, 0.0, 0.0, now};
    if (own.is_known && !own.is_given && own.flight.x == flight.x && own.flight.y == flight.y &&
        own.half.x == half.x && own.half.y == half.y)
      return;
    own.flight = flight, own.half = half, own.is_known = true, own.is_given = false;
    mark(id);
  }
  /// False if the id is unknown, or has that flight already.
  bool fly(std::uint32_t id, const Flight& flight) {
    if (id >= all_.size() || !all_[id].is_known || (all_[id].is_given && all_[id].flight == flight))
      return false;
    Own& own = all_[id];
    own.flight = flight, own.is_given = true, own.holds_until = -1e300;
    mark(id);
    if (!own.is_listed) own.is_listed = true, flying_.push_back(id);
    return true;
  }
  void forget(std::uint32_t id) {
    if (id >= all_.size()) return;
    const bool is_listed = all_[id].is_listed, is_news = all_[id].is_news;
    all_[id] = Own{}, all_[id].is_listed = is_listed, all_[id].is_news = is_news;
  }

  /// A decision holds until the next match, so a region is made anew when less than half of its
  /// horizon is left. Calls `hand_on(id, from, to)` with its places at both ends. An id that rests
  /// or has no flight any more leaves the list and costs nothing from then on.
  template <class HandOn>
  std::size_t sweep(double now, double horizon, double drag, const HandOn& hand_on) {
    assert(horizon >= 0.0 && drag >= 0.0);
    std::size_t kept = 0, swept = 0;
    for (const std::uint32_t id : flying_.span()) {
      Own& own = all_[id];
      const bool is_flying =
          own.is_given && (own.flight.velocity_x != 0.0 || own.flight.velocity_y != 0.0);
      if (own.is_given && own.holds_until < now + 0.5 * horizon)
        hand_on(id, place(own, now, drag), place(own, now + horizon, drag)),
            own.holds_until = now + horizon, ++swept;
      if (is_flying) flying_[kept++] = id;
      else own.is_listed = false;
    }
    flying_.resize(kept);
    return swept;
  }
  std::span<const std::uint32_t> news() const { return news_.span(); }
  void settle() {
    for (const std::uint32_t id : news_.span()) all_[id].is_news = false;
    news_.clear();
  }
  const Own& operator[](std::uint32_t id) const {
    assert(id < all_.size());
    return all_[id];
  }
  /// Asserts that the lists have each marked id once.
  void check() const {
    [[maybe_unused]] std::size_t listed = 0, news = 0;
    for (const Own& own : all_) listed += own.is_listed ? 1u : 0u, news += own.is_news ? 1u : 0u;
    assert(listed == flying_.size() && news == news_.size());
    for ([[maybe_unused]] const std::uint32_t id : flying_.span()) assert(all_[id].is_listed);
    for ([[maybe_unused]] const std::uint32_t id : news_.span()) assert(all_[id].is_news);
  }

 private:
  void mark(std::uint32_t id) {
    if (!all_[id].is_news) all_[id].is_news = true, news_.push_back(id);
  }
  /// Against the same drag along both axes a flight is a straight line, so all places between two
  /// times lie between those at both ends.
  static Region place(const Own& own, double time, double drag) {
    constexpr double largest = std::numeric_limits<double>::max();
    const auto bounded = [=](double coordinate) {
      return std::clamp(coordinate, -largest, largest);
    };
    const Flight at = at_time(own.flight, time, drag);
    return {bounded(at.x - own.half.x), bounded(at.y - own.half.y), bounded(at.x + own.half.x),
            bounded(at.y + own.half.y)};
  }

  std::vector<Own> all_;
  Buffer<std::uint32_t> news_, flying_;
};

class Swept final : public Parts {
 public:
  Swept(std::unique_ptr<Filter> inner, double horizon, double drag, bool is_disc)
      : Parts(std::move(inner)), horizon_(horizon), drag_(drag), is_disc_(is_disc) {
    assert(horizon_ >= 0.0 && drag_ >= 0.0);
  }

  void set_update_region(Entity entity, const Region& region) override {
    assert(is_valid(region));
    entities_.put(entity, region, now_);
    Parts::set_update_region(entity, region);
  }
  void set_subscription_region(Subscriber subscriber, const Region& region) override {
    assert(is_valid(region));
    subscribers_.put(subscriber, region, now_);
    Parts::set_subscription_region(subscriber, region);
  }
  void remove_entity(Entity entity) override {
    entities_.forget(entity);
    pairs_.remove_entity(entity);
    Parts::remove_entity(entity);
  }
  void remove_subscriber(Subscriber subscriber) override {
    subscribers_.forget(subscriber);
    pairs_.remove_subscriber(subscriber);
    Parts::remove_subscriber(subscriber);
  }
  Traits traits() const override {
    Traits own = Parts::traits();
    own.uses_flights = true;
    return own;
  }
  void set_flight(Entity entity, const Flight& flight) override {
    flights_told_ += entities_.fly(entity, flight) ? 1u : 0u;
  }
  void set_subscriber_flight(Subscriber subscriber, const Flight& flight) override {
    flights_told_ += subscribers_.fly(subscriber, flight) ? 1u : 0u;
  }
  void set_time(double now) override {
    assert(std::isfinite(now) && now >= now_);
    now_ = now;
    Parts::set_time(now);
  }

  std::span<const Change> match() override {
    Filter& inner = *parts_.front();
    regions_swept_ += entities_.sweep(
        now_, horizon_, drag_, [&inner](Entity entity, const Region& from, const Region& to) {
          inner.set_swept_update_region(entity, from, to);
        });
    regions_swept_ +=
        subscribers_.sweep(now_, horizon_, drag_,
                           [&inner](Subscriber subscriber, const Region& from, const Region& to) {
                             inner.set_swept_subscription_region(subscriber, from, to);
                           });
    const std::span<const Change> let_through = inner.match();
    for (const Entity entity : entities_.news()) pairs_.touch_near(entity);
    for (const Subscriber subscriber : subscribers_.news()) pairs_.touch(subscriber);
    changes_.clear();
    intervals_.clear();
    pairs_.review(
        let_through,
        [this](Subscriber subscriber, Entity entity, bool was) {
          return look(subscriber, entity, was);
        },
        changes_);
    if constexpr (checks_whole_structures) entities_.check(), subscribers_.check();
    entities_.settle();
    subscribers_.settle();
    return reported(changes_.span());
  }
  std::span<const RelevanceInterval> relevance_intervals() const override {
    return intervals_.span();
  }
  void list_counts(std::vector<StageCount>& counts) const override {
    Parts::list_counts(counts);
    counts.push_back({"swept", "flights told", flights_told_});
    counts.push_back({"swept", "regions swept", regions_swept_});
    counts.push_back({"swept", "stays worked out", intervals_found_});
  }

 private:
  bool look(Subscriber subscriber, Entity entity, bool was) {
    const Flights::Own &s = subscribers_[subscriber], &e = entities_[entity];
    assert(s.is_known && e.is_known);  // an id that is gone is in no pair
    if ((!was || s.is_news || e.is_news) && (s.is_given || e.is_given)) {
      const TimeSpan span =
          is_disc_ ? touching_disc(e.flight, e.half, s.flight, std::min(s.half.x, s.half.y), drag_)
                   : touching_boxes(e.flight, e.half, s.flight, s.half, drag_);
      intervals_.push_back({subscriber, entity, span.enters, span.leaves});
      ++intervals_found_;
    }
    return true;
  }

  double horizon_, drag_, now_ = 0.0;
  bool is_disc_;
  Flights entities_, subscribers_;
  CandidatePairs pairs_;
  Buffer<RelevanceInterval> intervals_;
  std::uint64_t flights_told_ = 0, regions_swept_ = 0, intervals_found_ = 0;
};

}  // namespace

std::unique_ptr<Filter> make_swept(std::unique_ptr<Filter> inner, double horizon, double drag,
                                   bool is_disc) {
  return std::make_unique<Swept>(std::move(inner), horizon, drag, is_disc);
}

}  // namespace rink::im
