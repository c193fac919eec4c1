// Boost.Geometry's rtree as a matcher of rectangles, static and moving.
#define BOOST_ALLOW_DEPRECATED_HEADERS  // which Boost.Geometry 1.74 itself includes
#include <boost/geometry.hpp>
#include <boost/geometry/index/rtree.hpp>
#include <boost/iterator/function_output_iterator.hpp>

#include "bench/peers/region_peers.h"

namespace rink::bench {
namespace {

namespace geometry = boost::geometry;
using Point = geometry::model::point<double, 2, geometry::cs::cartesian>;
using Box = geometry::model::box<Point>;
using Value = std::pair<Box, std::uint32_t>;
using Tree = geometry::index::rtree<Value, geometry::index::quadratic<16>>;

Box box(const im::Region& region) {
  return {{region.low_x, region.low_y}, {region.high_x, region.high_y}};
}

/// By the packing algorithm.
Tree tree_of(std::span<const im::Region> regions) {
  std::vector<Value> values;
  values.reserve(regions.size());
  for (std::uint32_t id = 0; id < regions.size(); ++id) values.emplace_back(box(regions[id]), id);
  return Tree(values);
}

template <class Take>
void ask(const Tree& tree, const Box& where, const Take& take) {
  tree.query(geometry::index::intersects(where),
             boost::make_function_output_iterator(
                 [&](const Value& value) { take(value.first, value.second); }));
}

void match_in_tree(std::span<const im::Region> updates, std::span<const im::Region> subscriptions,
                   std::vector<RegionPair>& pairs) {
  const Tree tree = tree_of(updates);
  for (std::uint32_t id = 0; id < subscriptions.size(); ++id)
    ask(tree, box(subscriptions[id]), [&](const Box&, std::uint32_t update) {
      pairs.push_back({id, update});
    });
}

class MovingTrees final : public MovingRegions {
 public:
  MovingTrees(std::span<const im::Region> updates, std::span<const im::Region> subscriptions)
      : updates_{tree_of(updates), {updates.begin(), updates.end()}},
        subscriptions_{tree_of(subscriptions), {subscriptions.begin(), subscriptions.end()}} {}

  void move_update(std::uint32_t id, const im::Region& region,
                   std::vector<im::Change>& changes) override {
    move(updates_, subscriptions_, id, region, [&](std::uint32_t other, im::Transition transition) {
      changes.push_back({other, id, transition});
    });
  }
  void move_subscription(std::uint32_t id, const im::Region& region,
                         std::vector<im::Change>& changes) override {
    move(subscriptions_, updates_, id, region, [&](std::uint32_t other, im::Transition transition) {
      changes.push_back({id, other, transition});
    });
  }

 private:
  struct Side {
    Tree tree;
    std::vector<im::Region> regions;
  };

  template <class Report>
  static void move(Side& own, const Side& other, std::uint32_t id, const im::Region& region,
                   const Report& report) {
    const Box before = box(own.regions[id]), now = box(region);
    own.tree.remove(Value{before, id});
    own.tree.insert(Value{now, id});
    own.regions[id] = region;
    Box hull = before;
    geometry::expand(hull, now);
    ask(other.tree, hull, [&](const Box& found, std::uint32_t found_id) {
      const bool was_in = geometry::intersects(found, before),
                 is_in = geometry::intersects(found, now);
      if (was_in != is_in) report(found_id, is_in ? im::Transition::entered : im::Transition::left);
    });
  }

  Side updates_, subscriptions_;
};

}  // namespace

extern const RegionMatch match_by_rtree = match_in_tree;

std::unique_ptr<MovingRegions> make_moving_rtrees(std::span<const im::Region> updates,
                                                  std::span<const im::Region> subscriptions) {
  return std::make_unique<MovingTrees>(updates, subscriptions);
}

}  // namespace rink::bench
