// A frame: the kept stage, marks under the pieces, the pieces from back to front, marks over them.
#include "game/view/render/renderer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "game/view/render/marks.h"
#include "game/view/render/overlay_triangles.h"
#include "game/view/render/shaders.h"
#include "game/view/render/stage_mesh.h"
#include "game/view/render/textures.h"

namespace rink::view {
namespace {

constexpr int sample_count = 4;
/// Rows that are smoothed in one frame: with all else it stays below a sixtieth of a second in
/// software.
constexpr int band_rows = 24;
/// At first a stage is drawn in so many times fewer pixels each way.
constexpr int rough_pixels = 2;
constexpr int piece_row[] = {4, 4, 4, 3, 3}, plan_row[] = {4, 4, 4}, point_row[] = {3, 3, 3};
/// From here on pieces throw no shadow: in a crowd each is a few pixels.
constexpr std::size_t shadowed_max = 400;
/// Discs up to this radius [pixels] are drawn as points from above, in a third of the time of
/// instanced quads; OpenGL drops a point whole when its centre leaves the window.
constexpr float point_radius_max = 20.0f;

Eigen::Vector3f rgb(const Colour& colour) { return {colour.red, colour.green, colour.blue}; }

GlName<destroy_texture> textured(const Image& image, bool repeats) {
  return make_texture(image.width, image.height, image.channels, image.pixels, repeats);
}

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

/// The pixels about what is seen of a box, within the window.
Eigen::AlignedBox2i seen_pixels(const Eigen::AlignedBox3f& box, const Sight& sight, int width,
                                int height) {
  Eigen::AlignedBox2f window;
  for (int corner = 0; corner < 8; ++corner)
    window.extend(sight.project(box.corner(static_cast<Eigen::AlignedBox3f::CornerType>(corner))));
  const Eigen::Array2f pixels(static_cast<float>(width), static_cast<float>(height));
  const Eigen::Array2i most(width, height),
      low = ((window.min().array() * 0.5f + 0.5f) * pixels).floor().cast<int>() - 2;
  const Eigen::Array2i high =
      ((window.max().array() * 0.5f + 0.5f) * pixels).ceil().cast<int>() + 2;
  return {low.max(0).min(most).matrix(), high.max(0).min(most).matrix()};
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
               piece.accent.red, piece.accent.green, piece.accent.blue});
}

/// Is any of it seen?
bool is_within(const Piece& piece, const Sight& sight) {
  return std::abs(piece.x - sight.eye().x()) <= sight.right().x() + piece.half_x &&
         std::abs(piece.y - sight.eye().y()) <= sight.up().y() + piece.half_y;
}

bool is_point(const Piece& piece, float pixel) {
  return piece.shape != Piece::Shape::bat && piece.half_x <= point_radius_max * pixel;
}

void clear_around() {
  glClearColor(0.035f, 0.04f, 0.055f, 1.0f);
  glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
}

}  // namespace

Renderer::Renderer()
    : stage_program_("stage", light_source, stage_vertex, stage_fragment),
      mark_program_("marks", light_source, mark_vertex, mark_fragment),
      piece_program_("pieces", light_source, piece_vertex, piece_fragment),
      plan_program_("plan", "", plan_vertex, plan_fragment),
      point_program_("points", "", point_vertex, point_fragment),
      flat_program_("plain table", light_source, flat_vertex, flat_fragment),
      overlay_program_("overlay", "", overlay_vertex, overlay_fragment),
      marks_(mark_row, true),
      pieces_(piece_row, true),
      plan_(plan_row, true),
      points_(point_row, false),
      plain_(plain_row, false),
      overlay_(overlay_row, false),
      wood_(textured(wood_image(512), true)),
      digits_(textured(digits_image(), false)) {}

void Renderer::prepare(const Program& program, const Table& table, const Sight& sight,
                       const Canvas& canvas) const {
  program.use();
  program.set("field", Eigen::Vector3f(table.length, table.width, table.goal_width));
  program.set("left_colour", rgb(table.left));
  program.set("right_colour", rgb(table.right));
  program.set("view", sight.matrix());
  program.set("eye", sight.eye());
  program.set("origin",
              Eigen::Vector2f(static_cast<float>(canvas.x), static_cast<float>(canvas.y)));
  program.set("stage_depth", 0);
  glActiveTexture(GL_TEXTURE0);
  glBindTexture(GL_TEXTURE_2D, depth_);
}

void Renderer::draw(const Picture& picture, const Canvas& canvas) {
  ++frame_;
  const Sight sight(picture.camera,
                    static_cast<float>(canvas.width) / static_cast<float>(canvas.height));
  const Stage wanted{picture.table,
                     picture.camera.is_plan ? Scoreboard{.is_there = false} : picture.board,
                     picture.camera, canvas.width, canvas.height};
  const bool is_kept =
      std::ranges::any_of(kept_, [&](const Kept& each) { return each.stage == wanted; });
  is_moving_ = picture.camera.is_plan && wanted != last_ &&
               !is_kept;  // a camera that moves needs no stage that is kept
  last_ = wanted;
  if (is_moving_) {
    draw_plain(picture, sight, canvas);
  } else {
    const Target& stage = kept(wanted, sight).target;
    depth_ = stage.depth();
    glBindFramebuffer(GL_READ_FRAMEBUFFER, stage.framebuffer());
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, canvas.framebuffer);
    glDisable(GL_SCISSOR_TEST);
    glBlitFramebuffer(0, 0, canvas.width, canvas.height, canvas.x, canvas.y,
                      canvas.x + canvas.width, canvas.y + canvas.height, GL_COLOR_BUFFER_BIT,
                      GL_NEAREST);
  }

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

/// A board that comes or goes is more than its face, and so no other score.
bool Renderer::differs_in_score_alone(const Stage& was, Stage is) {
  is.board.first = was.board.first, is.board.second = was.board.second;
  return was == is;
}

bool Renderer::is_settled() const {
  return !is_moving_ && std::ranges::none_of(kept_, [this](const Kept& each) {
    return each.last_used + 2 >= frame_ && each.stage && each.smooth_rows < each.stage->height;
  });
}

/// The stage as it is wanted, one band of rows smoother than before. One that shows another score
/// is changed; else the one that was not used for longest makes room.
Renderer::Kept& Renderer::kept(const Stage& wanted, const Sight& sight) {
  const auto is_same_but_score = [&](const Kept& each) {
    return each.stage && differs_in_score_alone(*each.stage, wanted);
  };
  auto found = std::ranges::find_if(kept_, [&](const Kept& each) { return each.stage == wanted; });
  if (found == kept_.end()) found = std::ranges::find_if(kept_, is_same_but_score);
  if (found == kept_.end()) found = std::ranges::min_element(kept_, {}, &Kept::last_used);
  if (found->stage != wanted) set_stage(*found, wanted, sight);
  else if (found->smooth_rows < wanted.height) {
    const int rows = std::min(band_rows, wanted.height - found->smooth_rows);
    smooth(*found, sight, {0, found->smooth_rows, wanted.width, rows});
    found->smooth_rows += rows;
  }
  found->last_used = frame_;
  return *found;
}

/// The depth, by which marks and pieces are hidden, and colours in a quarter of the pixels: a fifth
/// of the time that the smooth stage takes. Another score is a small part of it, and smooth at
/// once.
void Renderer::set_stage(Kept& kept, const Stage& stage, const Sight& sight) {
  if (kept.target.width() != stage.width || kept.target.height() != stage.height) {
    kept.target = Target(stage.width, stage.height, 0);
    kept.stage.reset();
  }
  const std::optional<Stage> was = std::exchange(kept.stage, stage);
  if (!was) kept.mesh = FloatStream(stage_row, false);
  if (!was || was->table != stage.table || was->board != stage.board ||
      was->camera.is_plan != stage.camera.is_plan)
    kept.mesh.fill(stage.camera.is_plan ? plan_mesh(stage.table)
                                        : stage_mesh(stage.table, stage.board));
  const bool is_score_alone = was && differs_in_score_alone(*was, stage);
  const Eigen::AlignedBox2i board =
      seen_pixels(board_box(stage.table, stage.board), sight, stage.width, stage.height);
  const Part part =
      is_score_alone ? Part{board.min().x(), board.min().y(), board.sizes().x(), board.sizes().y()}
                     : Part{0, 0, stage.width, stage.height};
  glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
  draw_stage(kept, sight, kept.target, {0, 0, stage.width, stage.height}, part);
  glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  if (is_score_alone) return smooth(kept, sight, part);
  kept.smooth_rows = 0;
  const int width = (stage.width + rough_pixels - 1) / rough_pixels,
            height = (stage.height + rough_pixels - 1) / rough_pixels;
  if (rough_.width() != width || rough_.height() != height) rough_ = Target(width, height, 0);
  draw_stage(kept, sight, rough_, {0, 0, width, height}, {0, 0, width, height});
  glBindFramebuffer(GL_READ_FRAMEBUFFER, rough_.framebuffer());
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, kept.target.framebuffer());
  glBlitFramebuffer(0, 0, width, height, 0, 0, stage.width, stage.height, GL_COLOR_BUFFER_BIT,
                    GL_LINEAR);
}

/// Draws `part` with samples, a band at a time.
void Renderer::smooth(Kept& kept, const Sight& sight, const Part& part) {
  if (samples_.width() < part.x + part.width)
    samples_ = Target(kept.target.width(), band_rows, sample_count);
  for (int y = part.y; y < part.y + part.height; y += band_rows) {
    const int rows = std::min(band_rows, part.y + part.height - y), right = part.x + part.width;
    draw_stage(kept, sight, samples_, {0, -y, kept.target.width(), kept.target.height()},
               {part.x, 0, part.width, rows});
    glDisable(GL_SCISSOR_TEST);
    glBindFramebuffer(GL_READ_FRAMEBUFFER, samples_.framebuffer());
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, kept.target.framebuffer());
    glBlitFramebuffer(part.x, 0, right, rows, part.x, y, right, y + rows, GL_COLOR_BUFFER_BIT,
                      GL_NEAREST);
  }
}

/// The stage fills `whole`, which may be larger than `target`, of whose pixels only `part` changes.
void Renderer::draw_stage(const Kept& kept, const Sight& sight, const Target& target,
                          const Part& whole, const Part& part) {
  const Stage& stage = *kept.stage;
  glBindFramebuffer(GL_FRAMEBUFFER, target.framebuffer());
  glViewport(whole.x, whole.y, whole.width, whole.height);
  glEnable(GL_SCISSOR_TEST);
  glScissor(part.x, part.y, part.width, part.height);
  glDisable(GL_BLEND);
  glEnable(GL_DEPTH_TEST);
  glDepthMask(GL_TRUE);
  clear_around();
  prepare(stage_program_, stage.table, sight, {});
  stage_program_.set("is_plan", stage.camera.is_plan ? 1 : 0);
  stage_program_.set("wood", 0);
  stage_program_.set("digits", 1);
  glBindTexture(GL_TEXTURE_2D, wood_.name());
  glActiveTexture(GL_TEXTURE1);
  glBindTexture(GL_TEXTURE_2D, digits_.name());
  glActiveTexture(GL_TEXTURE0);
  kept.mesh.bind();
  glDrawArrays(GL_TRIANGLES, 0, kept.mesh.count());
  glDisable(GL_DEPTH_TEST);
  glDisable(GL_SCISSOR_TEST);
}

void Renderer::draw_rows(FloatStream& stream) {
  if (rows_.empty()) return;
  stream.fill(rows_);
  stream.bind();
  glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, stream.count());
}

void Renderer::draw_plain(const Picture& picture, const Sight& sight, const Canvas& canvas) {
  if (plain_table_ != picture.table) plain_.fill(plain_mesh(picture.table));
  plain_table_ = picture.table;
  glBindFramebuffer(GL_FRAMEBUFFER, canvas.framebuffer);
  glViewport(canvas.x, canvas.y, canvas.width, canvas.height);
  glDisable(GL_BLEND);
  glDisable(GL_DEPTH_TEST);
  glEnable(GL_SCISSOR_TEST);
  glScissor(canvas.x, canvas.y, canvas.width, canvas.height);
  clear_around();
  glDisable(GL_SCISSOR_TEST);
  flat_program_.use();
  flat_program_.set("view", sight.matrix());
  plain_.bind();
  glDrawArrays(GL_TRIANGLES, 0, plain_.count());
}

void Renderer::draw_marks(const Picture& picture, const Sight& sight, const Canvas& canvas) {
  rows_.clear();
  add_marks(picture, picture.pieces.size() <= shadowed_max, rows_);
  if (rows_.empty()) return;
  prepare(mark_program_, picture.table, sight, canvas);
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
  prepare(piece_program_, picture.table, sight, canvas);
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
                               piece.accent.green, piece.accent.blue, 0.0f});
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
