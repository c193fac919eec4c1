// Panels and words in the window's plane, bars on the table.
#include "game/view/overlays/replay_view.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdio>

#include "game/control/bat_controller.h"

namespace rink::view {
namespace {

constexpr Colour groove{0.10f, 0.12f, 0.18f, 0.85f}, played{0.93f, 0.95f, 0.99f, 0.9f};

float part_of(double time, double end) {
  return static_cast<float>(ReplayBar::left + (ReplayBar::right - ReplayBar::left) *
                                                  (end > 0.0 ? std::min(1.0, time / end) : 0.0));
}

}  // namespace

void ReplayBar::look(const game::ReplayMatch& replay) {
  const MatchSight& sight = replay.sight();
  const bool goes_on = sight.time >= time_;
  const auto add = [&](std::uint32_t now, std::uint32_t before, game::Team team) {
    const auto is_known = [&](const Goal& goal) {
      return goal.team == team && std::abs(goal.time - sight.time) < 0.5;
    };
    if (goes_on && now == before + 1 && !replay.was_sought() &&
        std::ranges::none_of(goals_, is_known))
      goals_.push_back({sight.time, team});
  };
  add(sight.score.left, score_.left, game::Team::left);
  add(sight.score.right, score_.right, game::Team::right);
  score_ = sight.score;
  time_ = sight.time;
}

void ReplayBar::add_to(const game::ReplayMatch& replay, const Palette& palette,
                       Picture& words) const {
  constexpr auto from = static_cast<float>(left), to = static_cast<float>(right),
                 y = static_cast<float>(middle);
  const float now = part_of(replay.sight().time, replay.end());
  words.panels.push_back(
      {.x = from, .y = y - 0.008f, .width = to - from, .height = 0.016f, .fill = groove});
  words.panels.push_back(
      {.x = from, .y = y - 0.008f, .width = now - from, .height = 0.016f, .fill = played});
  for (const Goal& goal : goals_)
    words.panels.push_back({.x = part_of(goal.time, replay.end()) - 0.002f,
                            .y = y - 0.016f,
                            .width = 0.004f,
                            .height = 0.032f,
                            .fill = colour_of(goal.team, palette)});
  words.panels.push_back({.x = now - 0.004f,
                          .y = y - 0.02f,
                          .width = 0.008f,
                          .height = 0.04f,
                          .fill = {1.0f, 0.74f, 0.12f, 1.0f}});
}

std::optional<double> ReplayBar::hear(const WindowEvent& event, const WindowSize& size,
                                      double end_s) {
  using Kind = WindowEvent::Kind;
  assert(size.width > 0 && size.height > 0);
  if (event.kind == Kind::mouse_move) x_ = event.x / size.width, y_ = event.y / size.height;
  else if (event.kind == Kind::mouse_button)
    is_held_ =
        event.is_down && std::abs(y_ - middle) <= reach && x_ >= left - 0.01 && x_ <= right + 0.01;
  else if (event.kind == Kind::focus_lost) is_held_ = false;
  if (!is_held_ || (event.kind != Kind::mouse_move && event.kind != Kind::mouse_button))
    return std::nullopt;
  return end_s * std::clamp((x_ - left) / (right - left), 0.0, 1.0);
}

void add_inputs(const game::ReplayMatch& replay, const Palette& palette, Overlay& overlay) {
  std::uint32_t player = 0;
  const std::vector<game::ReplayMatch::Input>& inputs = replay.inputs();
  for (const Thing& thing : replay.sight().things) {
    if (thing.kind != physics::BodyKind::bat) continue;
    if (player >= inputs.size()) return;
    const game::ReplayMatch::Input& input = inputs[player++];
    const Vector2 thrust = game::BatController(1.0, input.keys, 0, input.push).thrust();
    const double unit = thing.half_extent.minCoeff(), gap = 0.3 * unit;
    for (int axis = 0; axis < 2; ++axis) {
      const double share = thrust[axis];
      if (share == 0.0) continue;
      const double way = share > 0.0 ? 1.0 : -1.0, near = thing.half_extent[axis] + gap,
                   far = near + std::abs(share) * unit;
      Vector2 low = thing.position - thing.half_extent, high = thing.position + thing.half_extent;
      low[axis] = thing.position[axis] + std::min(way * near, way * far);
      high[axis] = thing.position[axis] + std::max(way * near, way * far);
      Colour colour = colour_of(thing.team, palette);
      colour.alpha = 0.9f;
      overlay.rectangles.push_back(
          {low.x(), low.y(), high.x(), high.y(), colour, {0.05f, 0.06f, 0.1f, 0.6f}});
    }
  }
}

void add_speeds(const MatchSight& sight, const ViewChoice& choice, double aspect, Picture& words) {
  constexpr std::size_t pucks_max = 8;
  const Sight seen(camera_of(sight.field, choice, aspect), static_cast<float>(aspect));
  std::size_t count = 0;
  for (const Thing& thing : sight.things) {
    if (thing.kind != physics::BodyKind::puck || ++count > pucks_max) continue;
    const Eigen::Vector2f at = seen.project(
        {static_cast<float>(thing.position.x()), static_cast<float>(thing.position.y()), 0.0f});
    char text[40];
    std::snprintf(text, sizeof text, "%.1f m/s", thing.velocity.norm());
    words.texts.push_back({.words = text,
                           .x = std::clamp(0.5f + 0.5f * at.x() + 0.02f, 0.01f, 0.9f),
                           .y = std::clamp(0.5f - 0.5f * at.y() - 0.045f, 0.03f, 0.88f),
                           .size = 0.026f,
                           .align = Text::Align::left,
                           .has_plate = true});
  }
}

}  // namespace rink::view
