// Sets the uniforms that these shaders share.
#include "game/view/render/shaders/shading.h"

namespace rink::view {
namespace {

Eigen::Vector3f rgb(const Colour& colour) { return {colour.red, colour.green, colour.blue}; }

}  // namespace

void shade(const Program& program, const Table& table, const Sight& sight, const Canvas& canvas,
           GLuint depth) {
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
  glBindTexture(GL_TEXTURE_2D, depth);
}

void clear_around() {
  glClearColor(0.035f, 0.04f, 0.055f, 1.0f);
  glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
}

}  // namespace rink::view
