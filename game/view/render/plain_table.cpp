// A mesh of one table, made anew when another one is drawn.
#include "game/view/render/plain_table.h"

#include "game/view/render/shaders/shaders.h"
#include "game/view/render/shaders/shading.h"
#include "game/view/render/stage_mesh.h"

namespace rink::view {

PlainTable::PlainTable()
    : program_("plain table", light_source, flat_vertex, flat_fragment), mesh_(plain_row, false) {}

void PlainTable::draw(const Table& table, const Sight& sight, const Canvas& canvas) {
  if (table_ != table) mesh_.fill(plain_mesh(table));
  table_ = table;
  glBindFramebuffer(GL_FRAMEBUFFER, canvas.framebuffer);
  glViewport(canvas.x, canvas.y, canvas.width, canvas.height);
  glDisable(GL_BLEND);
  glDisable(GL_DEPTH_TEST);
  glEnable(GL_SCISSOR_TEST);
  glScissor(canvas.x, canvas.y, canvas.width, canvas.height);
  clear_around();
  glDisable(GL_SCISSOR_TEST);
  program_.use();
  program_.set("view", sight.matrix());
  mesh_.bind();
  glDrawArrays(GL_TRIANGLES, 0, mesh_.count());
}

}  // namespace rink::view
