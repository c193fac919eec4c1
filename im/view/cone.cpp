// The scheme `cone`: an entity matters to a subscriber while its rectangle touches the subscriber's
// field of view, a closed sector.
#include <cassert>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "im/schemes/predicate_filter.h"
#include "im/view/sector.h"

namespace rink::im {
namespace {

/// The directions in which subscribers look.
class Views {
 public:
  explicit Views(double half_angle_deg) : half_angle_deg_(half_angle_deg) {}

  /// False if `subscriber` has that heading already.
  bool look(Subscriber subscriber, const Heading& heading, bool is_given) {
    assert(subscriber < views_.size());
    View& view = views_[subscriber];
    const bool is_news = view.heading != heading;
    if (is_news) view.heading = heading, view.wedge = Wedge(heading, half_angle_deg_);
    view.is_given = is_given;
    return is_news;
  }
  bool is_given(Subscriber subscriber) const { return views_[subscriber].is_given; }
  Heading heading(Subscriber subscriber) const { return views_[subscriber].heading; }
  void set_swept(Subscriber subscriber, bool is_swept) {
    assert(subscriber < views_.size());
    views_[subscriber].is_swept = is_swept;
  }
  /// True if it moved from one place to another since its last move. Call it once for each move.
  bool has_way(Subscriber subscriber) {
    View& view = views_[subscriber];
    return !std::exchange(view.was_swept, view.is_swept) && !view.is_swept;
  }
  void make_room(Subscriber subscriber) {
    if (subscriber >= views_.size()) views_.resize(subscriber + std::size_t{1});
  }
  void forget(Subscriber subscriber) {
    if (subscriber < views_.size()) views_[subscriber] = View{};
  }
  const Wedge& wedge(Subscriber subscriber) const { return views_[subscriber].wedge; }
  std::size_t bytes() const { return views_.capacity() * sizeof(View); }

 private:
  struct View {
    Heading heading;
    bool is_given = false;  ///< not learnt from moves
    bool is_swept = false,
         was_swept = false;  ///< its present region, and that of its last move, is swept and no
                             ///< single place
    Wedge wedge;
  };
  std::vector<View> views_;
  double half_angle_deg_;
};

struct InView {
  const Views* views;
  /// A change of all coordinates of a region by 1 moves its middle by sqrt 2 and the rim of its
  /// disc by 1 more.
  Judgement operator()(const Party& subscriber, const Party& entity) const {
    const Wedge& wedge = views->wedge(subscriber.id);
    const Region mine = plain(subscriber.region), its = plain(entity.region);
    const double clearance = wedge.clearance(mine, its);
    return std::abs(clearance) > 0.0 ? Judgement{clearance > 0.0, 0.4 * std::abs(clearance)}
                                     : Judgement{wedge.touches(mine, its), 0.0};
  }
};

class ConeFilter final : private Views, public PredicateFilter<InView> {
 public:
  explicit ConeFilter(const FilterSettings& settings)
      : Views(settings.half_angle_deg), PredicateFilter(settings.world, {this}) {}

  void set_subscription_region(Subscriber subscriber, const Region& region) override {
    make_room(subscriber);
    set_swept(subscriber, false);
    PredicateFilter::set_subscription_region(subscriber, region);
  }
  void set_swept_subscription_region(Subscriber subscriber, const Region& from,
                                     const Region& to) override {
    if (from == to) return set_subscription_region(subscriber, from);
    PredicateFilter::set_swept_subscription_region(subscriber, from, to);
    set_swept(subscriber, true);
    const Eye start(plain(from)), end(plain(to));
    if (!is_given(subscriber))
      look(subscriber, {end.x - start.x, end.y - start.y},
           false);  // which matters once it has landed
  }
  void remove_subscriber(Subscriber subscriber) override {
    forget(subscriber);
    PredicateFilter::remove_subscriber(subscriber);
  }
  Traits traits() const override { return {.uses_headings = true}; }
  void set_heading(Subscriber subscriber, const Heading& heading) override {
    assert(std::isfinite(heading.x) && std::isfinite(heading.y));
    if (!subscribers_.contains(subscriber)) return;
    if (heading == Heading{})
      return void(look(subscriber, Views::heading(subscriber),
                       false));  // on with the last direction, until it moves
    if (look(subscriber, heading, true))
      turned(subscriber), subscribers_.touch(subscriber), ++counters_.regions_moved;
  }
  std::span<const Change> match() override {
    for (const Subscriber subscriber : subscribers_.moved()) learn(subscriber);
    return PredicateFilter::match();
  }

  std::size_t bytes() const { return PredicateFilter::bytes() + Views::bytes(); }

 private:
  void learn(Subscriber subscriber) {
    const Motion& motion = subscribers_[subscriber];
    if (!has_way(subscriber) || is_given(subscriber) || is_nowhere(motion.before) ||
        is_nowhere(motion.now))
      return;
    const Eye from(plain(motion.before)), to(plain(motion.now));
    const Heading way{to.x - from.x, to.y - from.y};
    if (way == Heading{}) return;
    // Straight on, but for rounding: the arc of the rim is what that can change.
    const double turn = angle_between(Views::heading(subscriber), way);
    if (!look(subscriber, way, false)) return;
    if (turn < 1e-6)
      turned(subscriber, turn * (std::abs(motion.now.high_x - motion.now.low_x) +
                                 std::abs(motion.now.high_y - motion.now.low_y)));
    else turned(subscriber);
  }
  /// At least the angle, for small ones; infinite where there is none. Of lengths near 1, for the
  /// products of the longest would be infinite and those of the shortest nothing.
  static double angle_between(const Heading& one, const Heading& other) {
    const Heading a = scaled(one), b = scaled(other);
    const double cross = a.x * b.y - a.y * b.x, dot = a.x * b.x + a.y * b.y;
    return dot > 0.0 ? 2.0 * std::abs(cross) / dot + 1e-12
                     : std::numeric_limits<double>::infinity();
  }
};

}  // namespace

std::unique_ptr<Filter> make_cone_filter(const FilterSettings& settings);

std::unique_ptr<Filter> make_cone_filter(const FilterSettings& settings) {
  return std::make_unique<ConeFilter>(settings);
}

}  // namespace rink::im
