// Each mark says how far it may reach, so that the shader runs on few pixels.
#include "game/view/render/marks.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace rink::view {
namespace {

/// As the shader counts them.
enum class Kind : int { disc_shadow, box_shadow, streak, glow };

constexpr float shadow_reach = 0.09f;  // m; where the contact shadow has faded

/// Lengths in metres.
struct Mark {
  float low_x, low_y, high_x, high_y;  ///< how far it may reach
  float x, y, half_x, half_y;          ///< what it belongs to
  Kind kind;
  float a = 0.0f, b = 0.0f;  ///< what the shader makes of them depends on the kind
  Colour colour;
};

void add(std::vector<float>& rows, const Mark& mark) {
  rows.insert(rows.end(),
              {mark.low_x, mark.low_y, mark.high_x, mark.high_y, mark.x, mark.y, mark.half_x,
               mark.half_y, static_cast<float>(mark.kind), mark.a, mark.b, 0.0f, mark.colour.red,
               mark.colour.green, mark.colour.blue, mark.colour.alpha});
}

void add_shadow(const Piece& piece, std::vector<float>& rows) {
  const float x = piece.half_x + shadow_reach, y = piece.half_y + shadow_reach;
  add(rows, {.low_x = piece.x - x,
             .low_y = piece.y - y,
             .high_x = piece.x + x,
             .high_y = piece.y + y,
             .x = piece.x,
             .y = piece.y,
             .half_x = piece.half_x,
             .half_y = piece.half_y,
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
  add(rows, {.low_x = std::min(piece.x, piece.x - x) - r,
             .low_y = std::min(piece.y, piece.y - y) - r,
             .high_x = std::max(piece.x, piece.x - x) + r,
             .high_y = std::max(piece.y, piece.y - y) + r,
             .x = piece.x,
             .y = piece.y,
             .half_x = r,
             .half_y = r,
             .kind = Kind::streak,
             .a = x,
             .b = y,
             .colour = colour});
}

void add_glow(const Table& table, bool is_left, float part, std::vector<float>& rows) {
  assert(part <= 1.0f);
  if (part <= 0.0f) return;
  Colour colour = is_left ? table.right : table.left;  // of who scored
  colour.alpha = 0.85f * part;
  const float reach = 0.45f * table.length, side = 0.62f * table.width,
              x = is_left ? 0.0f : table.length, y = 0.5f * table.width;
  add(rows, {.low_x = is_left ? 0.0f : table.length - reach,
             .low_y = 0.0f,
             .high_x = is_left ? reach : table.length,
             .high_y = table.width,
             .x = x,
             .y = y,
             .half_x = reach,
             .half_y = side,
             .kind = Kind::glow,
             .colour = colour});
}

}  // namespace

void add_marks(const Picture& picture, bool has_shadows, std::vector<float>& rows) {
  add_glow(picture.table, true, picture.left_glow, rows);
  add_glow(picture.table, false, picture.right_glow, rows);
  if (!has_shadows) return;
  for (const Piece& piece : picture.pieces) add_shadow(piece, rows);
  for (const Piece& piece : picture.pieces) add_streak(piece, rows);
}

}  // namespace rink::view
