// CGAL's box_intersection_d as a matcher of rectangles.
#include <CGAL/Box_intersection_d/Box_d.h>
#include <CGAL/box_intersection_d.h>

#include "bench/peers/region_peers.h"

namespace rink::bench {
namespace {

/// A closed box that knows its id.
struct NumberedBox
    : CGAL::Box_intersection_d::Box_d<double, 2, CGAL::Box_intersection_d::ID_EXPLICIT> {
  using Base = CGAL::Box_intersection_d::Box_d<double, 2, CGAL::Box_intersection_d::ID_EXPLICIT>;
  NumberedBox(double* low, double* high, std::uint32_t region) : Base(low, high), region(region) {}
  std::uint32_t region;
};

std::vector<NumberedBox> boxes_of(std::span<const im::Region> regions) {
  std::vector<NumberedBox> boxes;
  boxes.reserve(regions.size());
  for (std::uint32_t id = 0; id < regions.size(); ++id) {
    double low[] = {regions[id].low_x, regions[id].low_y},
           high[] = {regions[id].high_x, regions[id].high_y};
    boxes.emplace_back(low, high, id);
  }
  return boxes;
}

void match_boxes(std::span<const im::Region> updates, std::span<const im::Region> subscriptions,
                 std::vector<RegionPair>& pairs) {
  std::vector<NumberedBox> a = boxes_of(updates), b = boxes_of(subscriptions);
  CGAL::box_intersection_d(a.begin(), a.end(), b.begin(), b.end(),
                           [&](const NumberedBox& update, const NumberedBox& subscription) {
                             pairs.push_back({subscription.region, update.region});
                           });
}

}  // namespace

extern const RegionMatch match_by_box_intersection = match_boxes;

}  // namespace rink::bench
