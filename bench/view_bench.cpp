// Frames of the window, drawn offscreen at 1280x720: the lit match, and crowds from above; alone,
// and with menus, words and overlay as `rink play` draws them. In software these run on the calling
// thread alone.
#include <benchmark/benchmark.h>

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <memory>

#include "game/model/random_stream.h"
#include "game/view/application.h"
#include "game/view/picture_of.h"
#include "game/view/render/offscreen.h"
#include "game/view/render/renderer.h"

namespace rink::bench::view_bench {
namespace {

using namespace rink;
using namespace rink::view;

constexpr int width = 1280, height = 720;
constexpr double aspect = 16.0 / 9.0;

/// A context, or why there is none.
class Stage {
 public:
  explicit Stage(benchmark::State& state) {
    setenv("LP_NUM_THREADS", "0", 0);  // llvmpipe: no threads but ours
    try {
      context_ = std::make_unique<OffscreenContext>();
      renderer_ = std::make_unique<Renderer>();
      target_ = Target(width, height, 0);
    } catch (const GraphicsError& error) {
      state.SkipWithError(error.what());
    }
  }
  bool is_there() const { return renderer_ != nullptr; }
  void draw(Application& application, double now_s) {
    if (!interface_) interface_ = std::make_unique<Interface>();
    application.draw(*interface_, renderer_.get(), {width, height, 1.0},
                     {target_.framebuffer(), 0, 0, width, height}, now_s);
    glFinish();
  }
  bool is_settled() const { return renderer_->is_settled(); }
  void draw(const MatchSight& sight, const ViewChoice& choice, const Overlay& overlay = {}) {
    renderer_->draw(picture_of(sight, overlay, choice, aspect),
                    {target_.framebuffer(), 0, 0, width, height});
    glFinish();
  }

 private:
  std::unique_ptr<OffscreenContext> context_;
  std::unique_ptr<Interface> interface_;
  std::unique_ptr<Renderer> renderer_;
  Target target_;
};

MatchSight match_sight() {
  MatchSight sight;
  sight.field = {.length = 2.4, .width = 1.2, .goal_width = 0.4};
  sight.goals_to_win = 5;
  sight.phase = Phase::playing;
  using physics::BodyKind;
  sight.things = {{0, BodyKind::post, game::Team::none, {0.6, 0.85}, {0.0, 0.0}, {0.06, 0.06}},
                  {1, BodyKind::post, game::Team::none, {1.8, 0.35}, {0.0, 0.0}, {0.06, 0.06}},
                  {2, BodyKind::bat, game::Team::left, {0.42, 0.52}, {0.3, 0.1}, {0.03, 0.1}},
                  {3, BodyKind::bat, game::Team::right, {2.0, 0.7}, {0.0, 0.0}, {0.03, 0.1}},
                  {4, BodyKind::puck, game::Team::none, {1.35, 0.75}, {2.4, 0.9}, {0.04, 0.04}}};
  return sight;
}

/// Pucks that cover a quarter of a field twice as long as wide, and one bat for each hundred of
/// them.
MatchSight crowd_sight(std::uint32_t count) {
  MatchSight sight;
  const double side = std::sqrt(count * 3.14159 * 0.04 * 0.04 / 0.25 / 2.0);
  sight.field = {.length = 2.0 * side, .width = side, .goal_width = 0.6};
  sight.phase = Phase::playing;
  game::RandomStream random(1);
  for (std::uint32_t i = 0; i < count + count / 100; ++i) {
    const bool is_bat = i >= count;
    const Vector2 place(random.uniform(0.0, 2.0 * side), random.uniform(0.0, side));
    const Vector2 half_extent = is_bat ? Vector2(0.05, 0.15) : Vector2(0.04, 0.04);
    sight.things.push_back({i, is_bat ? physics::BodyKind::bat : physics::BodyKind::puck,
                            is_bat ? game::Team::left : game::Team::none, place, random.in_disc(),
                            half_extent});
  }
  return sight;
}

void move(MatchSight& sight) {
  for (Thing& thing : sight.things) {
    if (thing.kind == physics::BodyKind::post) continue;
    thing.position += thing.velocity / 120.0;
    if (thing.position.x() < 0.05 || thing.position.x() > sight.field.length - 0.05)
      thing.velocity.x() = -thing.velocity.x();
    if (thing.position.y() < 0.05 || thing.position.y() > sight.field.width - 0.05)
      thing.velocity.y() = -thing.velocity.y();
  }
}

void frames(benchmark::State& state, MatchSight sight, ViewChoice choice, double centre_step = 0.0,
            const Overlay& overlay = {}) {
  Stage stage(state);
  if (!stage.is_there()) return;
  do stage.draw(sight, choice, overlay);
  while (!stage.is_settled());
  for (auto _ : state) {
    move(sight);
    choice.centre.x() += centre_step;
    if (choice.centre.x() > 0.7 || choice.centre.x() < 0.3) centre_step = -centre_step;
    stage.draw(sight, choice, overlay);
  }
  state.counters["frames_per_s"] =
      benchmark::Counter(static_cast<double>(state.iterations()), benchmark::Counter::kIsRate);
  state.SetLabel(graphics_name());
}

void view_match(benchmark::State& state) {
  constexpr Viewpoint viewpoints[] = {Viewpoint::side, Viewpoint::left_end, Viewpoint::right_end,
                                      Viewpoint::above};
  frames(state, match_sight(), {.viewpoint = viewpoints[state.range(0)]});
}
BENCHMARK(view_match)
    ->Name("view/match")
    ->DenseRange(0, 3)
    ->ArgName("viewpoint")
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);

void view_crowd(benchmark::State& state) {
  frames(state, crowd_sight(static_cast<std::uint32_t>(state.range(0))),
         {.viewpoint = Viewpoint::above});
}
BENCHMARK(view_crowd)
    ->Name("view/crowd")
    ->Arg(1'000)
    ->Arg(10'000)
    ->Arg(50'000)
    ->ArgName("discs")
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);

/// The camera moves with every frame, so nothing of the table can be kept.
void view_follow(benchmark::State& state) {
  frames(state, crowd_sight(static_cast<std::uint32_t>(state.range(0))),
         {.viewpoint = Viewpoint::above, .zoom = 2.0}, 0.001);
}
BENCHMARK(view_follow)
    ->Name("view/crowd_followed")
    ->Arg(10'000)
    ->ArgName("discs")
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);

/// With a grid, a subscription region, and a ring around every disc in it.
void view_overlay(benchmark::State& state) {
  const MatchSight sight = crowd_sight(static_cast<std::uint32_t>(state.range(0)));
  Overlay overlay{.cell_size = 1.0, .rectangles = {}, .discs = {}, .lines = {}};
  const double middle = 0.5 * sight.field.width;
  overlay.rectangles.push_back({middle,
                                0.3 * middle,
                                2.0 * middle,
                                1.3 * middle,
                                {0.2f, 0.8f, 0.4f, 0.2f},
                                {0.1f, 0.6f, 0.2f, 1.0f}});
  for (const Thing& thing : sight.things)
    if (thing.position.x() > middle && thing.position.x() < 2.0 * middle &&
        thing.position.y() > 0.3 * middle && thing.position.y() < 1.3 * middle)
      overlay.discs.push_back(
          {thing.position.x(), thing.position.y(), 0.05, {0.1f, 0.7f, 0.25f, 1.0f}, false});
  frames(state, sight, {.viewpoint = Viewpoint::above}, 0.0, overlay);
}
BENCHMARK(view_overlay)
    ->Name("view/crowd_overlay")
    ->Arg(10'000)
    ->ArgName("discs")
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);

/// Moves by itself.
class MovingMatch final : public MatchSource {
 public:
  explicit MovingMatch(const MatchSight& sight) : sight_(sight) {}
  void advance(double) override { move(sight_); }
  const MatchSight& sight() const override { return sight_; }
  std::uint32_t hand_count() const override { return sight_.goals_to_win ? 2 : 0; }
  void press(std::uint32_t, game::Key, bool) override {}
  void pause(bool) override {}
  void rematch() override {}

 private:
  MatchSight sight_;
};

/// What a filter with regions of a twentieth of the field would tell of the bat in the middle.
game::InterestSeen decided(const MatchSight& sight) {
  const double half = 0.5 * std::sqrt(0.05 * sight.field.length * sight.field.width);
  const Vector2 middle(0.5 * sight.field.length, 0.5 * sight.field.width);
  game::InterestSeen seen{.cell_size = 1.0f, .views = {}, .heard = {}};
  const Thing* asked = nullptr;
  for (const Thing& thing : sight.things)
    if (thing.kind == physics::BodyKind::bat &&
        (asked == nullptr || (thing.position - middle).norm() < (asked->position - middle).norm()))
      asked = &thing;
  seen.asked = asked->id;
  for (const Thing& thing : sight.things) {
    const bool is_near = (thing.position - asked->position).cwiseAbs().maxCoeff() < half;
    if (is_near) seen.heard.push_back(thing.id);
    const Eigen::Array2f low = (thing.position.array() - half).cast<float>(),
                         high = (thing.position.array() + half).cast<float>();
    if (thing.kind == physics::BodyKind::bat)
      seen.views.push_back({thing.id, is_near, low.x(), low.y(), high.x(), high.y()});
  }
  return seen;
}

/// All of it: `rink play --figures` at a match, split or with one camera, and at a crowd, with and
/// without the overlay of interest.
void view_played(benchmark::State& state, const MatchSight& sight, bool is_split) {
  Stage stage(state);
  if (!stage.is_there()) return;
  Settings settings;
  settings.is_split = is_split;
  Application application(
      {.make_match = [&](const MatchWish&) { return std::make_unique<MovingMatch>(sight); }},
      settings);
  application.play({.kind = MatchWish::Kind::two, .address = {}});
  application.show_figures();
  double now_s = 0.0;
  for (int i = 0; i < 3 || !stage.is_settled(); ++i) stage.draw(application, now_s += 1.0 / 120.0);
  for (auto _ : state) stage.draw(application, now_s += 1.0 / 120.0);
  state.counters["frames_per_s"] =
      benchmark::Counter(static_cast<double>(state.iterations()), benchmark::Counter::kIsRate);
  state.SetLabel(graphics_name());
}

void view_played_match(benchmark::State& state) {
  view_played(state, match_sight(), state.range(0) != 0);
}
BENCHMARK(view_played_match)
    ->Name("view/played_match")
    ->Arg(0)
    ->Arg(1)
    ->ArgName("split")
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);

void view_played_crowd(benchmark::State& state) {
  MatchSight sight = crowd_sight(10'000);
  if (state.range(0) != 0) sight.interest = decided(sight);
  view_played(state, sight, false);
}
BENCHMARK(view_played_crowd)
    ->Name("view/played_crowd")
    ->Arg(0)
    ->Arg(1)
    ->ArgName("interest")
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);

/// The longest of the frames after the camera changed to one that nothing was kept of: each time
/// the table is a little longer.
void view_cut(benchmark::State& state) {
  Stage stage(state);
  if (!stage.is_there()) return;
  MatchSight sight = match_sight();
  stage.draw(sight, {});
  for (auto _ : state) {
    sight.field.length += 1e-4;
    stage.draw(sight, {});
  }
}
BENCHMARK(view_cut)->Name("view/cut")->UseRealTime()->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace rink::bench::view_bench
