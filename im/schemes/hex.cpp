// The scheme `hex`: an entity matters to a subscriber while the hexagon that its centre is in
// touches the subscriber's region.
#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

#include "im/schemes/cells.h"
#include "im/schemes/following_cells.h"
#include "im/schemes/predicate_filter.h"

namespace rink::im {
namespace {

constexpr double sqrt3 = std::numbers::sqrt3;

/// The rectangles around both overlap already; what remains are the sides of the hexagon that slant
/// by 30 degrees: along their normals, (1, sqrt 3) / 2 and its mirror image, the region must come
/// within half a width of the middle. Lengths are quartered, for those of the largest rectangles
/// have no double.
struct TouchesHexagon {
  double width;
  /// A change of all coordinates by 1 changes the left side by (1 + sqrt 3) / 4, which is less than
  /// 0.7.
  Judgement operator()(const Party& subscriber, const Party& entity) const {
    const auto gap = [](double middle, double low, double high) {
      return std::max(0.25 * low - 0.25 * middle, 0.25 * middle - 0.25 * high);
    };
    const Region middle = centre_of(entity.region);
    const Region& region = subscriber.region;
    const double away = gap(middle.low_x, region.low_x, region.high_x) +
                        sqrt3 * gap(middle.low_y, region.low_y, region.high_y),
                 reach = 0.25 * width;
    return {away <= reach, std::abs(away - reach) / 0.7};
  }
};

/// Hexagons stand on a corner; `cell_size` is the distance of their upright sides. Their middles
/// are those of two lattices of rectangles, the second half a rectangle further along both axes;
/// the nearest middle is the nearer of one from each; an upright side belongs to the right one.
class HexFilter : public PredicateFilter<TouchesHexagon> {
 public:
  HexFilter(const Region& world, double cell_size)
      : PredicateFilter(world, {cell_size}), world_(world), width_(cell_size) {
    assert(width_ > 0.0);
  }

  void set_update_region(Entity entity, const Region& region) override {
    PredicateFilter::set_update_region(entity, hexagon_around(centre_of(region)));
  }
  /// No point is farther from its hexagon's middle than a corner is, nor from any point of the
  /// hexagon than twice that.
  void set_swept_update_region(Entity entity, const Region& from, const Region& to) override {
    if (from == to) return set_update_region(entity, from);
    const Region centres = hull_of(centre_of(from), centre_of(to));
    const double across = 2.0 * width_ / sqrt3;
    const auto bounded = [](double coordinate) {
      return std::clamp(coordinate, -largest, largest);
    };
    sweep_entity(entity, {bounded(centres.low_x - across), bounded(centres.low_y - across),
                          bounded(centres.high_x + across), bounded(centres.high_y + across)});
  }
  double cell_size() const override { return width_; }

 protected:
  /// All regions must be set anew afterwards.
  void resize_cells(double width) {
    width_ = width;
    replace({width});
  }

 private:
  struct Middle {
    double x, y, distance_squared;
  };
  Middle nearest(const Region& centre, double shift) const {
    assert(shift == 0.0 || shift == 0.5);  // every other row stands half a hexagon aside
    const auto place = [shift](double coordinate, double origin, double size) {
      return std::clamp(
          origin + (std::floor((coordinate - origin) / size - shift + 0.5) + shift) * size,
          -largest, largest);
    };
    const double x = place(centre.low_x, world_.low_x, width_),
                 y = place(centre.low_y, world_.low_y, sqrt3 * width_);
    const double offset_x = centre.low_x - x, offset_y = centre.low_y - y;
    return {x, y, offset_x * offset_x + offset_y * offset_y};
  }
  /// The rectangle around the hexagon.
  Region hexagon_around(const Region& centre) const {
    const Middle first = nearest(centre, 0.0), second = nearest(centre, 0.5),
                 middle = second.distance_squared < first.distance_squared ? second : first;
    const auto bounded = [](double coordinate) {
      return std::clamp(coordinate, -largest, largest);
    };
    const double half_width = 0.5 * width_, half_height = width_ / sqrt3;
    return {bounded(middle.x - half_width), bounded(middle.y - half_height),
            bounded(middle.x + half_width), bounded(middle.y + half_height)};
  }

  Region world_;
  double width_;
};

}  // namespace

std::unique_ptr<Filter> make_hex_filter(const FilterSettings& settings);

std::unique_ptr<Filter> make_hex_filter(const FilterSettings& settings) {
  return make_celled_filter<HexFilter>(settings);
}

}  // namespace rink::im
