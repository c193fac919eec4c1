// Draws a stage at once in few pixels, then smoothly band by band.
#include "game/view/render/kept_stages.h"

#include <algorithm>
#include <utility>

#include "game/view/render/shaders/shaders.h"
#include "game/view/render/shaders/shading.h"
#include "game/view/render/stage_mesh.h"
#include "game/view/render/textures.h"

namespace rink::view {
namespace {

constexpr int sample_count = 4;
/// Rows that are smoothed in one frame, which in software stays below a sixtieth of a second.
constexpr int band_rows = 24;
/// At first a stage is drawn in so many times fewer pixels each way.
constexpr int rough_pixels = 2;

GlName<destroy_texture> textured(const Image& image, bool repeats) {
  return make_texture(image.width, image.height, image.channels, image.pixels, repeats);
}

/// The pixels around the visible part of a box, within the window.
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

/// A board that appears or vanishes is more than a change of score.
bool differs_in_score_alone(const Stage& was, Stage is) {
  is.board.first = was.board.first, is.board.second = was.board.second;
  return was == is;
}

}  // namespace

KeptStages::KeptStages()
    : program_("stage", light_source, stage_vertex, stage_fragment),
      wood_(textured(wood_image(512), true)),
      digits_(textured(digits_image(), false)) {}

bool KeptStages::holds(const Stage& wanted) const {
  return std::ranges::any_of(kept_, [&](const Kept& each) { return each.stage == wanted; });
}

bool KeptStages::are_settled() const {
  return std::ranges::none_of(kept_, [this](const Kept& each) {
    return each.last_used + 2 >= frame_ && each.stage && each.smooth_rows < each.stage->height;
  });
}

const Target& KeptStages::show(const Stage& wanted, const Sight& sight) {
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
  return found->target;
}

/// The depth, by which marks and pieces are hidden, and colours in a quarter of the pixels: a fifth
/// of the time that the smooth stage takes. Another score is a small part of it, and smooth at
/// once.
void KeptStages::set_stage(Kept& kept, const Stage& stage, const Sight& sight) {
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
  draw_roughly(kept, sight);
}

void KeptStages::draw_roughly(Kept& kept, const Sight& sight) {
  const Stage& stage = *kept.stage;
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
void KeptStages::smooth(Kept& kept, const Sight& sight, const Part& part) {
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
void KeptStages::draw_stage(const Kept& kept, const Sight& sight, const Target& target,
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
  shade(program_, stage.table, sight, {}, 0);
  program_.set("is_plan", stage.camera.is_plan ? 1 : 0);
  program_.set("wood", 0);
  program_.set("digits", 1);
  glBindTexture(GL_TEXTURE_2D, wood_.name());
  glActiveTexture(GL_TEXTURE1);
  glBindTexture(GL_TEXTURE_2D, digits_.name());
  glActiveTexture(GL_TEXTURE0);
  kept.mesh.bind();
  glDrawArrays(GL_TRIANGLES, 0, kept.mesh.count());
  glDisable(GL_DEPTH_TEST);
  glDisable(GL_SCISSOR_TEST);
}

}  // namespace rink::view
