// A frame: the kept stage, marks under the pieces, the pieces from back to front, marks over them.
#include "game/view/render/renderer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "game/view/render/marks.h"
#include "game/view/render/overlay_triangles.h"
#include "game/view/render/shaders/shaders.h"
#include "game/view/render/shaders/shading.h"

namespace rink::view {
namespace {

constexpr int piece_row[] = {4, 4, 4, 4, 3}, plan_row[] = {4, 4, 4}, point_row[] = {3, 3, 3};
/// With more pieces none has a shadow: in a crowd each is a few pixels.
constexpr std::size_t shadowed_max = 400;
/// Discs up to this radius [pixels] are drawn as points from above, in a third of the time of
/// instanced quads; OpenGL drops a point whole when its centre leaves the window.
constexpr float point_radius_max = 20.0f;

/// Half the piece's size; half its height as z.
Vector3 half_size(const Piece& piece) { return {piece.half_x, piece.half_y, 0.5f * piece.height}; }

float rounding(const Piece& piece) {
  return piece.shape == Piece::Shape::puck  ? 0.22f * piece.height
         : piece.shape == Piece::Shape::bat ? 0.007f
                                            : 0.005f;
}

/// The window's rectangle that the piece or its mirrored image may cover; a pixel's room around it.
Eigen::Vector4f covered(const Piece& piece, const Sight& sight, bool is_image,
                        const Canvas& canvas) {
  const Vector3 half = half_size(piece);
  Eigen::Vector2f low(1.0f, 1.0f), high(-1.0f, -1.0f);
  for (int corner = 0; corner < 8; ++corner) {
    const float up = (corner & 4) != 0 ? 2.0f * half.z() : 0.0f;
    const Vector3 place(piece.x + ((corner & 1) != 0 ? half.x() : -half.x()),
                        piece.y + ((corner & 2) != 0 ? half.y() : -half.y()), is_image ? -up : up);
    const Eigen::Vector2f at = sight.project(place);
    low = low.cwiseMin(at);
    high = high.cwiseMax(at);
  }
  const Eigen::Vector2f room(3.0f / static_cast<float>(canvas.width),
                             3.0f / static_cast<float>(canvas.height));
  low = (low - room).cwiseMax(-1.0f);
  high = (high + room).cwiseMin(1.0f);
  return {low.x(), low.y(), high.x(), high.y()};
}

void add_piece(const Piece& piece, const Sight& sight, bool is_image, const Canvas& canvas,
               std::vector<float>& rows) {
  const Eigen::Vector4f window = covered(piece, sight, is_image, canvas);
  if (window[0] >= window[2] || window[1] >= window[3]) return;
  const Vector3 half = half_size(piece);
  rows.insert(rows.end(),
              {window[0], window[1], window[2], window[3], piece.x, piece.y,
               static_cast<float>(piece.shape), is_image ? 1.0f : 0.0f, half.x(), half.y(),
               half.z(), rounding(piece), piece.colour.red, piece.colour.green, piece.colour.blue,
               piece.angle, piece.accent.red, piece.accent.green, piece.accent.blue});
}

/// True if any of the piece is visible.
bool is_within(const Piece& piece, const Sight& sight) {
  return std::abs(piece.x - sight.eye().x()) <= sight.right().x() + piece.half_x &&
         std::abs(piece.y - sight.eye().y()) <= sight.up().y() + piece.half_y;
}

bool is_point(const Piece& piece, float pixel) {
  return piece.shape != Piece::Shape::bat && piece.angle == Piece::even &&
         piece.half_x <= point_radius_max * pixel;
}

/// The canvas shifted as the picture is nudged: the stage that is kept is drawn elsewhere, not
/// anew.
Canvas nudged(const Picture& picture, const Canvas& canvas) {
  if (picture.camera.is_plan) return canvas;
  const auto pixels = [&](float part) {
    return static_cast<int>(std::lround(part * static_cast<float>(canvas.height)));
  };
  Canvas there = canvas;
  there.x += pixels(picture.nudge_x), there.y += pixels(picture.nudge_y);
  return there;
}

/// Nothing is drawn beyond `canvas` until the end.
class Clip {
 public:
  explicit Clip(const Canvas& canvas) {
    glEnable(GL_SCISSOR_TEST);
    glScissor(canvas.x, canvas.y, canvas.width, canvas.height);
  }
  ~Clip() { glDisable(GL_SCISSOR_TEST); }
  Clip(const Clip&) = delete;
  Clip& operator=(const Clip&) = delete;
};

}  // namespace

Renderer::Renderer()
    : mark_program_("marks", light_source, mark_vertex, mark_fragment),
      piece_program_("pieces", light_source, piece_vertex, piece_fragment),
      plan_program_("plan", "", plan_vertex, plan_fragment),
      point_program_("points", "", point_vertex, point_fragment),
      overlay_program_("overlay", "", overlay_vertex, overlay_fragment),
      marks_(mark_row, true),
      pieces_(piece_row, true),
      plan_(plan_row, true),
      points_(point_row, false),
      overlay_(overlay_row, false) {}

void Renderer::draw(const Picture& picture, const Canvas& whole) {
  const Canvas canvas = nudged(picture, whole);
  const Sight sight(picture.camera,
                    static_cast<float>(canvas.width) / static_cast<float>(canvas.height));
  const Target* stage = find_stage(picture, sight, canvas);
  std::optional<Clip> clip;
  if (canvas.x != whole.x || canvas.y != whole.y) {
    glBindFramebuffer(GL_FRAMEBUFFER, canvas.framebuffer);
    clip.emplace(whole);
    clear_around();
  }
  if (stage != nullptr) show_stage(*stage, canvas);
  glBindFramebuffer(GL_FRAMEBUFFER, canvas.framebuffer);
  glViewport(canvas.x, canvas.y, canvas.width, canvas.height);
  glDisable(GL_DEPTH_TEST);
  glDisable(GL_CULL_FACE);
  glEnable(GL_BLEND);
  glBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  draw_marks(picture, sight, canvas);
  if (picture.camera.is_plan) draw_plan(picture, sight, canvas);
  else draw_pieces(picture, sight, canvas);
  draw_overlay(picture, sight, canvas);
  glDisable(GL_BLEND);
  glBindVertexArray(0);
}

/// The stage to show; nothing if the table is drawn already, for a camera that moves.
const Target* Renderer::find_stage(const Picture& picture, const Sight& sight,
                                   const Canvas& canvas) {
  stages_.begin_frame();
  const Stage wanted{picture.table,
                     picture.camera.is_plan ? Scoreboard{.is_there = false} : picture.board,
                     picture.camera, canvas.width, canvas.height};
  is_moving_ = picture.camera.is_plan && wanted != last_ &&
               !stages_.holds(wanted);  // a camera that moves needs no stage that is kept
  last_ = wanted;
  if (is_moving_) {
    plain_.draw(picture.table, sight, canvas);
    return nullptr;
  }
  const Target& stage = stages_.show(wanted, sight);
  depth_ = stage.depth();
  glDisable(GL_SCISSOR_TEST);
  return &stage;
}

void Renderer::show_stage(const Target& stage, const Canvas& canvas) {
  glBindFramebuffer(GL_READ_FRAMEBUFFER, stage.framebuffer());
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, canvas.framebuffer);
  glBlitFramebuffer(0, 0, canvas.width, canvas.height, canvas.x, canvas.y, canvas.x + canvas.width,
                    canvas.y + canvas.height, GL_COLOR_BUFFER_BIT, GL_NEAREST);
}

bool Renderer::is_settled() const { return !is_moving_ && stages_.are_settled(); }

void Renderer::draw_rows(FloatStream& stream) {
  if (rows_.empty()) return;
  stream.fill(rows_);
  stream.bind();
  glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, stream.count());
}

void Renderer::draw_marks(const Picture& picture, const Sight& sight, const Canvas& canvas) {
  rows_.clear();
  add_marks(picture, picture.pieces.size() <= shadowed_max, rows_);
  if (rows_.empty()) return;
  shade(mark_program_, picture.table, sight, canvas, depth_);
  mark_program_.set("is_plan", picture.camera.is_plan ? 1 : 0);
  draw_rows(marks_);
}

void Renderer::draw_overlay(const Picture& picture, const Sight& sight, const Canvas& canvas) {
  rows_.clear();
  const Eigen::Vector2f middle = sight.on_table({0.0f, 0.0f}),
                        beside = sight.on_table({2.0f / static_cast<float>(canvas.width), 0.0f});
  add_overlay(picture, (beside - middle).norm(), rows_);
  if (rows_.empty()) return;
  overlay_program_.use();
  overlay_program_.set("view", sight.matrix());
  overlay_.fill(rows_);
  overlay_.bind();
  glDrawArrays(GL_TRIANGLES, 0, overlay_.count());
}

/// From back to front; images in the table before all, for they lie under everything.
void Renderer::draw_pieces(const Picture& picture, const Sight& sight, const Canvas& canvas) {
  order_.clear();
  for (const Piece& piece : picture.pieces) order_.push_back(&piece);
  const auto depth = [&](const Piece* piece) {
    return (Vector3(piece->x, piece->y, 0.0f) - sight.eye()).dot(sight.forward());
  };
  std::ranges::stable_sort(order_, std::greater<>{}, depth);
  rows_.clear();
  for (const bool is_image : {true, false})
    for (const Piece* piece : order_) add_piece(*piece, sight, is_image, canvas, rows_);
  if (rows_.empty()) return;
  shade(piece_program_, picture.table, sight, canvas, depth_);
  piece_program_.set("right", sight.right());
  piece_program_.set("up", sight.up());
  piece_program_.set("forward", sight.forward());
  piece_program_.set("pixel", 2.0f * sight.up().norm() / static_cast<float>(canvas.height));
  draw_rows(pieces_);
}

/// Small discs as points, large ones and boxes over them as quads.
void Renderer::draw_plan(const Picture& picture, const Sight& sight, const Canvas& canvas) {
  const float pixel = 2.0f * sight.up().y() / static_cast<float>(canvas.height);
  draw_points(picture, sight, pixel);
  rows_.clear();
  for (const Piece& piece : picture.pieces) {
    if (is_point(piece, pixel) || !is_within(piece, sight)) continue;
    rows_.insert(rows_.end(), {piece.x, piece.y, piece.half_x, piece.half_y, piece.colour.red,
                               piece.colour.green, piece.colour.blue,
                               piece.shape == Piece::Shape::bat ? 1.0f : 0.0f, piece.accent.red,
                               piece.accent.green, piece.accent.blue, piece.angle});
  }
  if (rows_.empty()) return;
  plan_program_.use();
  plan_program_.set("view", sight.matrix());
  plan_program_.set("pixel", pixel);
  draw_rows(plan_);
}

void Renderer::draw_points(const Picture& picture, const Sight& sight, float pixel) {
  rows_.clear();
  for (const Piece& piece : picture.pieces) {
    if (!is_point(piece, pixel) || !is_within(piece, sight)) continue;
    rows_.insert(rows_.end(),
                 {piece.x, piece.y, piece.half_x, piece.colour.red, piece.colour.green,
                  piece.colour.blue, piece.accent.red, piece.accent.green, piece.accent.blue});
  }
  if (rows_.empty()) return;
  point_program_.use();
  point_program_.set("view", sight.matrix());
  point_program_.set("pixel", pixel);
  points_.fill(rows_);
  points_.bind();
  glEnable(GL_PROGRAM_POINT_SIZE);
  glDrawArrays(GL_POINTS, 0, points_.count());
}

}  // namespace rink::view
