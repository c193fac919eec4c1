// Every body where it is, in its own shape: a picture with it against one without it.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>

#include "game/view/picture_of.h"
#include "game/view/render/image_file.h"
#include "game/view/render/renderer.h"
#include "tests/view/offscreen_test.h"
#include "tests/view/sights.h"
#include "tests/view/tiles.h"

namespace rink::view {
namespace {

constexpr int width = 480, height = 270;
constexpr double aspect = static_cast<double>(width) / height;

class ThingsShown : public OffscreenTest {
 protected:
  static void SetUpTestSuite() {
    OffscreenTest::SetUpTestSuite();
    if (!can_draw()) return;
    renderer_ = std::make_unique<Renderer>();
    target_ = std::make_unique<Target>(width, height, 0);
  }
  static void TearDownTestSuite() {
    target_.reset();
    renderer_.reset();
    OffscreenTest::TearDownTestSuite();
  }

  Image drawn(const MatchSight& sight, const ViewChoice& choice) {
    const Picture picture = picture_of(sight, {}, choice, aspect);
    do renderer_->draw(picture, {target_->framebuffer(), 0, 0, width, height});
    while (!renderer_->is_settled());
    return read_pixels(target_->framebuffer(), width, height);
  }

  struct Shape {
    const Thing& thing;
    const ViewChoice& choice;
    const physics::Field& field;
  };
  /// The part of the points of the thing's top for which `is_so(pixel)` holds, `pixel` being the
  /// place of its first channel. A point is given in halves of the thing's sides, from -reach to
  /// reach each way.
  template <class IsWanted, class IsSo>
  static double part_of_top(const Image& image, const Shape& shape, double reach,
                            const IsWanted& is_wanted, const IsSo& is_so) {
    const Sight sight(camera_of(shape.field, shape.choice, aspect), static_cast<float>(aspect));
    MatchSight alone;
    alone.field = shape.field;
    alone.things = {shape.thing};
    const float top = shape.choice.viewpoint == Viewpoint::above
                          ? 0.0f
                          : picture_of(alone, {}, shape.choice, aspect).pieces[0].height;
    int so = 0, all = 0;
    constexpr int steps = 10;
    for (int i = -steps; i <= steps; ++i)
      for (int j = -steps; j <= steps; ++j) {
        const double u = reach * i / steps, v = reach * j / steps;
        if (!is_wanted(u, v)) continue;
        const Vector2 at =
            shape.thing.position + Vector2(u, v).cwiseProduct(shape.thing.half_extent);
        const Eigen::Vector2f window =
            sight.project({static_cast<float>(at.x()), static_cast<float>(at.y()), top});
        const int x =
            static_cast<int>(std::floor((0.5 * static_cast<double>(window.x()) + 0.5) * width));
        const int y =
            static_cast<int>(std::floor((0.5 - 0.5 * static_cast<double>(window.y())) * height));
        if (x < 0 || y < 0 || x >= width || y >= height) continue;
        so += is_so(static_cast<std::size_t>((y * width + x) * image.channels)) ? 1 : 0;
        ++all;
      }
    EXPECT_GT(all, 0);
    return static_cast<double>(so) / std::max(1, all);
  }
  template <class IsWanted>
  static double part_that_differs(const Image& a, const Image& b, const Shape& shape, double reach,
                                  const IsWanted& is_wanted) {
    return part_of_top(a, shape, reach, is_wanted, [&](std::size_t pixel) {
      int most = 0;
      for (std::size_t channel = pixel; channel < pixel + 3; ++channel)
        most = std::max(most, std::abs(int{a.pixels[channel]} - int{b.pixels[channel]}));
      return most > 4;  // a steel top on a white table is not much
    });
  }
  /// Nearly black with a yellow ring, or of the team's colour, which no shadow is.
  static bool has_own_colour(const Image& image, std::size_t pixel, const Thing& thing) {
    const int red = image.pixels[pixel], green = image.pixels[pixel + 1],
              blue = image.pixels[pixel + 2];
    if (thing.kind == physics::BodyKind::puck)
      return std::max({red, green, blue}) < 70 || red - blue > 60;
    if (thing.kind == physics::BodyKind::bat)
      return (thing.team == game::Team::left ? red - blue : blue - red) > 40;
    return true;
  }

  static MatchSight without(MatchSight sight, std::uint32_t id) {
    std::erase_if(sight.things, [id](const Thing& each) { return each.id == id; });
    return sight;
  }

  /// The whole of `thing` is seen at its place; a bat to its corners, a disc round.
  void expect_shown(const Image& all, const Image& less, const Shape& shape) {
    const bool is_bat = shape.thing.kind == physics::BodyKind::bat;
    const auto is_inside = [&](double u, double v) { return is_bat || u * u + v * v <= 0.8 * 0.8; };
    const auto has_colour = [&](std::size_t pixel) {
      return has_own_colour(all, pixel, shape.thing);
    };
    const auto which = [&] {
      return "thing " + std::to_string(shape.thing.id) + " from viewpoint " +
             std::to_string(static_cast<int>(shape.choice.viewpoint));
    };
    EXPECT_GT(part_that_differs(all, less, shape, 0.8, is_inside), 0.8) << which();
    EXPECT_GT(part_of_top(all, shape, 0.8, is_inside, has_colour), is_bat ? 0.15 : 0.5)
        << which() << ", of which most of a bat's top is a pale inlay";
  }
  /// From above and without shadows nothing is seen beside it.
  void expect_nothing_beside(const Image& all, const Image& less, const Shape& shape) {
    const bool is_bat = shape.thing.kind == physics::BodyKind::bat;
    const auto is_beside = [&](double u, double v) {
      return is_bat ? std::abs(u) > 1.6 && std::abs(v) < 1.0 : u * u + v * v > 1.6 * 1.6;
    };
    EXPECT_LT(part_that_differs(all, less, shape, 2.0, is_beside), 0.05)
        << "beside thing " << shape.thing.id;
  }

  static inline std::unique_ptr<Renderer> renderer_;
  static inline std::unique_ptr<Target> target_;
};

TEST_F(ThingsShown, StandWhereTheyAreFromEveryViewpoint) {
  const MatchSight sight = match_sight();
  for (const Viewpoint viewpoint :
       {Viewpoint::side, Viewpoint::left_end, Viewpoint::right_end, Viewpoint::above}) {
    const ViewChoice choice{.viewpoint = viewpoint};
    const Image all = drawn(sight, choice);
    for (const Thing& thing : sight.things)
      expect_shown(all, drawn(without(sight, thing.id), choice), {thing, choice, sight.field});
  }
}

/// At this zoom a bat is 7 x 21 pixels and a puck 6 across.
TEST_F(ThingsShown, OfACrowdAreBatsAndDiscs) {
  const MatchSight sight = crowd_sight();
  const ViewChoice choice{.viewpoint = Viewpoint::above, .zoom = 3.0};
  const Image all = drawn(sight, choice);
  for (const std::uint32_t id : {1012u, 1011u, 1019u, 473u, 475u, 525u}) {
    const Thing& thing = sight.things[id];
    const Image less = drawn(without(sight, id), choice);
    expect_shown(all, less, {thing, choice, sight.field});
    expect_nothing_beside(all, less, {thing, choice, sight.field});
  }
}

/// The puck is 0.09 % of this picture: too little to be missed in the whole of it, but not in its
/// tile.
TEST_F(ThingsShown, AreMissedInTheirTileIfTheyAreNotThere) {
  const MatchSight sight = match_sight();
  for (const Viewpoint viewpoint : {Viewpoint::side, Viewpoint::left_end, Viewpoint::right_end}) {
    const ViewChoice choice{.viewpoint = viewpoint};
    const Image all = drawn(sight, choice);
    for (const Thing& thing : sight.things) {
      const Tile worst = worst_tile(all, drawn(without(sight, thing.id), choice));
      EXPECT_FALSE(worst.is_alike()) << "thing " << thing.id << " from viewpoint "
                                     << static_cast<int>(viewpoint) << ": " << worst;
    }
    EXPECT_TRUE(worst_tile(all, drawn(sight, choice)).is_alike());
  }
}

}  // namespace
}  // namespace rink::view
