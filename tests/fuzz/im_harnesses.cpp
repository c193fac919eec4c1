// What interest management is told by strangers: expressions, and calls in any order with any
// numbers.
#include <array>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <map>
#include <set>
#include <vector>

#include "im/checked_filter.h"
#include "im/stages/priority_order.h"
#include "tests/fuzz/harness.h"

namespace rink::fuzz {
namespace {

using Pair = std::pair<im::Subscriber, im::Entity>;

/// Small numbers on a lattice, for ties, and what else a double can say.
double number(Input& input) {
  constexpr double infinite = std::numeric_limits<double>::infinity(),
                   largest = std::numeric_limits<double>::max();
  constexpr std::array odd{std::numeric_limits<double>::quiet_NaN(),
                           infinite,
                           -infinite,
                           largest,
                           -largest,
                           5e-324,
                           -0.0,
                           1e9,
                           -1e9,
                           1e160,
                           0x1p-200,
                           1.0 + 0x1p-52,
                           1e-9,
                           -0x1p200,
                           3.3};
  const unsigned byte = input.byte();
  return byte < 240 ? (byte - 80.0) / 8.0 : odd[byte - 240 < odd.size() ? byte - 240 : 0];
}

/// Mostly as it should be, for else nearly all would be turned away.
im::Region region(Input& input) {
  const double x = number(input), y = number(input), width = number(input), height = number(input);
  if (input.byte() == 255) return {x, y, width, height};
  return {x, y, x + std::abs(width), y + std::abs(height)};
}

constexpr im::Region world{0.0, 0.0, 16.0, 16.0};

/// The first ones remember nothing: what they say depends only on how things are.
constexpr std::array expressions{"region",
                                 "aura",
                                 "cone",
                                 "sight",
                                 "pvs(cell_size=0.5)",
                                 "tiles(cell_size=0.5 steps=3)",
                                 "grid(cell_size=0.7)",
                                 "hex",
                                 "hierarchical",
                                 "hybrid",
                                 "diamond",
                                 "nimbus(radius=1.5 awareness=0.25)",
                                 "strips",
                                 "none",
                                 "team or owner or always",
                                 "aura and not sight",
                                 "not (region or cone) and not team",
                                 "none with psense",
                                 "hybrid with psense(vision=0.5)",
                                 "zones(capacity=2)",
                                 "none with von(area=0.5)",
                                 "none with donnybrook(k=2 guidance=3) with priority",
                                 "region with swept(horizon=0.5 drag=0.25)",
                                 "aura with tiers(at=0.3 at=0.6) with priority",
                                 "region with hysteresis(margin=0.5)",
                                 "cone with dwell(matches=3)",
                                 "region with vfc(at=0.5 matches=2 distance=1) with priority",
                                 "hybrid with dyconits(cell_size=2 error=0.5)",
                                 "(aura or always) with swept(horizon=1 disc=1) with "
                                 "hysteresis(margin=1) with dwell(matches=2) with tiers(at=0.5)"};
constexpr std::size_t forgetful_count = 21;

im::FilterSettings settings() {
  return {.world = world,
          .cell_size = 1.0,
          .half_angle_deg = 45.0,
          .posts = {{4.0, 4.0, 1.0}, {8.0, 2.0, 0.5}, {2.0, 9.0, 2.0}}};
}

/// All that was taken, and what came of it.
class Stream {
 public:
  explicit Stream(const char* expression)
      : filter_(im::make_filter(expression, settings()), id_limit) {}

  void step(Input& input) {
    const unsigned what = input.byte() % 13;
    const std::uint32_t id = input.byte() % (id_limit + 2);
    switch (what) {
      case 0:
      case 1:
        put(filter_.add_entity(id, part_ = region(input)), entities_, id);
        break;
      case 2:
      case 3:
        put(filter_.move_entity(id, part_ = region(input)), entities_, id);
        break;
      case 4:
        add_subscriber(id, region(input));
        break;
      case 5:
        put(filter_.move_subscriber(id, part_ = region(input)), subscribers_, id);
        break;
      case 6:
        remove_entity(id);
        break;
      case 7:
        remove_subscriber(id);
        break;
      case 8:
        turn(id, {number(input), number(input)});
        break;
      case 9:
        take_role(id, {input.byte() % 4, input.byte() % 4, input.byte() % 4 == 0},
                  input.byte() % 2 == 0);
        break;
      case 10:
        fly(id, input);
        break;
      case 11:
        filter_.note_update(id);
        break;
      default:
        match();
        break;
    }
  }

  void match() {
    const auto changes = filter_.match();
    for (std::size_t i = 0; i < changes.size(); ++i) {
      const im::Change& change = changes[i];
      const Pair pair{change.subscriber, change.entity};
      require(i == 0 || Pair(changes[i - 1].subscriber, changes[i - 1].entity) < pair,
              "changes are ordered, one for each pair");
      require(entities_.contains(change.entity) && subscribers_.contains(change.subscriber),
              "changes are of those who are there");
      require(known_.contains(pair) == (change.transition != im::Transition::entered),
              "a change is news");
      if (change.transition == im::Transition::left) known_.erase(pair);
      else known_.insert(pair);
    }
    for (const im::RelevanceInterval& stay : filter_.filter().relevance_intervals())
      require(known_.contains({stay.subscriber, stay.entity}), "stays are of pairs let through");
    im::PriorityOrder* const order = filter_.filter().priority();
    if (order != nullptr)
      for (const auto& [subscriber, there] : subscribers_)
        for (const auto& item :
             order->fill(subscriber, 30, [](const auto&) { return std::size_t{10}; }))
          require(known_.contains({subscriber, item.entity}), "who is sent is relevant");
  }
  /// One that hears only how things are in the end says the same.
  void compare_with_a_fresh_one(const char* expression) {
    match();
    const auto fresh = im::make_filter(expression, settings());
    for (auto it = subscribers_.rbegin(); it != subscribers_.rend(); ++it) {
      fresh->set_subscription_region(it->first, it->second.region);
      fresh->set_heading(it->first, it->second.heading);
      fresh->set_subscriber_role(it->first, it->second.role);
    }
    for (const auto& [id, own] : entities_)
      fresh->set_update_region(id, own.region), fresh->set_entity_role(id, own.role);
    std::set<Pair> all;
    for (const im::Change& change : fresh->match()) all.insert({change.subscriber, change.entity});
    require(all == known_, "the sum of the changes is what holds now");
    require(filter_.match().empty(), "nothing more comes of nothing");
  }

 private:
  static constexpr std::uint32_t id_limit = 24;
  struct Own {
    im::Region region;
    im::Heading heading{1.0, 0.0};
    im::Role role;
  };

  bool put(const std::optional<im::Rejection>& rejection, std::map<std::uint32_t, Own>& all,
           std::uint32_t id) {
    if (rejection)
      return require(!im::describe(*rejection).empty(), "a rejection has words"), false;
    all[id].region = part_;
    return true;
  }
  void add_subscriber(im::Subscriber id, const im::Region& region) {
    part_ = region;
    if (put(filter_.add_subscriber(id, region), subscribers_, id))
      filter_.turn(id, {1.0, 0.0});  // told, so that its way does not matter
  }
  void remove_entity(im::Entity id) {
    require(filter_.remove_entity(id).has_value() != (entities_.erase(id) == 1),
            "only who is there can go");
    std::erase_if(known_, [id](const Pair& pair) { return pair.second == id; });
  }
  void remove_subscriber(im::Subscriber id) {
    require(filter_.remove_subscriber(id).has_value() != (subscribers_.erase(id) == 1),
            "only who is there can go");
    std::erase_if(known_, [id](const Pair& pair) { return pair.first == id; });
  }
  void turn(im::Subscriber id, const im::Heading& heading) {
    if (heading == im::Heading{}) return;
    if (!filter_.turn(id, heading)) subscribers_[id].heading = heading;
  }
  void take_role(std::uint32_t id, const im::Role& role, bool is_entity) {
    if (is_entity && !filter_.set_entity_role(id, role)) entities_[id].role = role;
    if (!is_entity && !filter_.set_subscriber_role(id, role)) subscribers_[id].role = role;
  }
  void fly(std::uint32_t id, Input& input) {
    im::Flight flight;
    for (double* part :
         {&flight.x, &flight.y, &flight.velocity_x, &flight.velocity_y, &flight.time})
      *part = number(input);
    if (input.byte() % 2 == 0) filter_.fly_entity(id, flight);
    else filter_.fly_subscriber(id, flight);
    filter_.set_time(number(input));
  }

  im::CheckedFilter filter_;
  im::Region part_;
  std::map<std::uint32_t, Own> entities_, subscribers_;
  std::set<Pair> known_;
};

void interest_changes(rti::Bytes bytes) {
  Input input(bytes);
  const std::size_t which = input.byte() % expressions.size();
  Stream stream(expressions[which]);
  while (!input.is_empty()) stream.step(input);
  if (which < forgetful_count) stream.compare_with_a_fresh_one(expressions[which]);
  else stream.match();
}

/// Rectangles that are none, ids beyond the limit and flights that nobody can fly.
void refuse_interest_changes(rti::Bytes bytes) {
  constexpr double infinite = std::numeric_limits<double>::infinity(),
                   none = std::numeric_limits<double>::quiet_NaN();
  Input input(bytes);
  im::CheckedFilter filter(
      im::make_filter(expressions[input.byte() % expressions.size()], settings()), 24);
  const std::uint32_t id = input.byte() % 24;
  for (const im::Region& each :
       {im::Region{none, 0.0, 1.0, 1.0}, im::Region{0.0, -infinite, 1.0, 1.0},
        im::Region{1.0, 0.0, 0.0, 1.0}, im::Region{0.0, 1.0, 1.0, 0.0}}) {
    require(filter.add_entity(id, each).has_value(), "an update region that is none is refused");
    require(filter.add_subscriber(id, each).has_value(),
            "a subscription region that is none is refused");
  }
  require(filter.add_entity(24, {0.0, 0.0, 1.0, 1.0}).has_value() &&
              filter.add_subscriber(24, {0.0, 0.0, 1.0, 1.0}).has_value(),
          "an id beyond the limit is refused");
  require(filter.move_entity(id, {0.0, 0.0, 1.0, 1.0}).has_value() &&
              filter.remove_entity(id).has_value(),
          "nobody moves or removes whoever is not there");
  require(!filter.add_entity(id, {0.0, 0.0, 1.0, 1.0}) &&
              !filter.add_subscriber(id, {0.0, 0.0, 1.0, 1.0}),
          "what is in order is taken");
  require(filter.turn(id, {none, 1.0}).has_value(), "a heading that is none is refused");
  require(filter.fly_entity(id, {.x = none}).has_value(), "a flight that is none is refused");
}

void refuse_scheme_expressions(rti::Bytes bytes) {
  const std::string text = text_of(bytes) + " with ((";
  require(im::complaint_about(text, settings()).has_value() &&
              im::make_filter(text, settings()) == nullptr,
          "an expression that breaks off is refused");
}

void scheme_expressions(rti::Bytes bytes) {
  const std::string text = text_of(bytes);
  const auto complaint = im::complaint_about(text, settings());
  const auto filter = im::make_filter(text, settings());
  require(complaint.has_value() != (filter != nullptr),
          "an expression has a filter or a complaint");
  if (!filter) return require(!complaint->empty(), "a complaint has words");
  for (std::uint32_t id = 0; id < 3; ++id) {
    filter->set_update_region(id, {1.0 * id, 1.0, 1.0 + id, 2.0});
    filter->set_subscription_region(id, {1.0 * id, 0.0, 4.0, 4.0});
  }
  require(filter->match().size() <= 9, "no pair comes twice");
  require(filter->match().empty(), "nothing comes of nothing");
}

}  // namespace

std::span<const Harness> im_harnesses() {
  static constexpr std::array<Harness, 2> list{
      {{"interest_changes", interest_changes, refuse_interest_changes},
       {"scheme_expression", scheme_expressions, refuse_scheme_expressions}}};
  return list;
}

}  // namespace rink::fuzz
