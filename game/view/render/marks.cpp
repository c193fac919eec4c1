// Makes marks; each has its reach, so that the shader runs on few pixels.
#include "game/view/render/marks.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace rink::view {
namespace {

/// Numbered as in the shader.
enum class Kind : int { disc_shadow, box_shadow, streak, glow, line };

constexpr float shadow_reach = 0.09f;  // m; where the contact shadow has faded

/// Lengths in metres.
struct Mark {
  struct {
    float low_x, low_y, high_x, high_y;
  } reach;
  struct {
    float x, y, half_x, half_y;
  } of;  ///< the thing that it belongs to
  Kind kind;
  float a = 0.0f, b = 0.0f, c = 0.0f;  ///< what the shader makes of them depends on the kind
  Colour colour;
};

void add(std::vector<float>& rows, const Mark& mark) {
  rows.insert(rows.end(), {mark.reach.low_x, mark.reach.low_y, mark.reach.high_x, mark.reach.high_y,
                           mark.of.x, mark.of.y, mark.of.half_x, mark.of.half_y,
                           static_cast<float>(mark.kind), mark.a, mark.b, mark.c, mark.colour.red,
                           mark.colour.green, mark.colour.blue, mark.colour.alpha});
}

void add_shadow(const Piece& piece, std::vector<float>& rows) {
  const float x = piece.half_x + shadow_reach, y = piece.half_y + shadow_reach;
  add(rows, {.reach = {piece.x - x, piece.y - y, piece.x + x, piece.y + y},
             .of = {piece.x, piece.y, piece.half_x, piece.half_y},
             .kind = piece.shape == Piece::Shape::bat ? Kind::box_shadow : Kind::disc_shadow,
             .a = piece.height,
             .colour = {0.02f, 0.03f, 0.07f, 1.0f}});
}

/// As long as the way of 0.07 s, from 0.6 m/s on.
void add_streak(const Piece& piece, std::vector<float>& rows) {
  const float speed = std::hypot(piece.velocity_x, piece.velocity_y);
  if (piece.shape != Piece::Shape::puck || speed < 0.6f) return;
  const float x = 0.07f * piece.velocity_x, y = 0.07f * piece.velocity_y, r = piece.half_x;
  Colour colour = piece.accent;
  colour.alpha = std::min(0.55f, 0.16f * (speed - 0.6f));
  add(rows, {.reach = {std::min(piece.x, piece.x - x) - r, std::min(piece.y, piece.y - y) - r,
                       std::max(piece.x, piece.x - x) + r, std::max(piece.y, piece.y - y) + r},
             .of = {piece.x, piece.y, r, r},
             .kind = Kind::streak,
             .a = x,
             .b = y,
             .colour = colour});
}

void add_glow(const Table& table, bool is_left, float part, std::vector<float>& rows) {
  assert(part <= 1.0f);
  if (part <= 0.0f) return;
  Colour colour = is_left ? table.right : table.left;  // of the scorer
  colour.alpha = 0.85f * part;
  const float reach = 0.45f * table.length, side = 0.62f * table.width,
              x = is_left ? 0.0f : table.length, y = 0.5f * table.width;
  add(rows, {.reach = {is_left ? 0.0f : table.length - reach, 0.0f, is_left ? reach : table.length,
                       table.width},
             .of = {x, y, reach, side},
             .kind = Kind::glow,
             .colour = colour});
}

/// In pieces, since the shader runs in the whole box around one, which is large if it is aslant.
void add_line(const Streak& streak, std::vector<float>& rows) {
  constexpr float piece = 0.12f;  // m
  const float x = streak.end_x - streak.x, y = streak.end_y - streak.y, length = std::hypot(x, y);
  if (length <= 0.0f) return;
  const int count = static_cast<int>(std::ceil(length / piece));
  const auto n = static_cast<float>(count);
  for (int k = 0; k < count; ++k) {
    const float from = static_cast<float>(k) / n, to = static_cast<float>(k + 1) / n;
    const auto width = [&](float part) {
      return std::lerp(streak.half_width, streak.end_half_width, part);
    };
    const auto alpha = [&](float part) { return std::lerp(1.0f, streak.fading, part); };
    const float x0 = streak.x + from * x, y0 = streak.y + from * y, x1 = streak.x + to * x,
                y1 = streak.y + to * y, room = std::max(width(from), width(to));
    Colour colour = streak.colour;
    colour.alpha *= alpha(from);
    add(rows, {.reach = {std::min(x0, x1) - room, std::min(y0, y1) - room, std::max(x0, x1) + room,
                         std::max(y0, y1) + room},
               .of = {x0, y0, width(from), width(to)},
               .kind = Kind::line,
               .a = x1 - x0,
               .b = y1 - y0,
               .c = alpha(to) / std::max(1e-6f, alpha(from)),
               .colour = colour});
  }
}

}  // namespace

void add_marks(const Picture& picture, bool has_shadows, std::vector<float>& rows) {
  add_glow(picture.table, true, picture.left_glow, rows);
  add_glow(picture.table, false, picture.right_glow, rows);
  if (!has_shadows) return;
  for (const Piece& piece : picture.pieces) add_shadow(piece, rows);
  for (const Streak& streak : picture.streaks) add_line(streak, rows);
  for (const Piece& piece : picture.pieces) add_streak(piece, rows);
}

}  // namespace rink::view
