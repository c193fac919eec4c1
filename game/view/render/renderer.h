// Draws a Picture with OpenGL 3.3.
#pragma once

#include <optional>

#include "game/view/render/gl_objects.h"
#include "game/view/render/picture.h"

namespace rink::view {

/// A rectangle of pixels to draw to, in a framebuffer (0: the window's own).
struct Canvas {
  GLuint framebuffer = 0;
  int x = 0, y = 0, width = 1280, height = 720;
  friend bool operator==(const Canvas&, const Canvas&) = default;
};

/// What stands still is drawn once, with four samples a pixel and all the light, and kept while the camera, the score and the canvas stay as they are; a frame then copies it and
/// draws what moves. In software that is the difference between 15 and 200 frames per second (docs/play.md). The context that was current when it was made must be current always.
class Renderer {
 public:
  /// Throws GraphicsError.
  Renderer();

  /// All but the dimming and the texts.
  void draw(const Picture& picture, const Canvas& canvas);

 private:
  /// What the kept stage shows.
  struct Stage {
    Table table;
    Scoreboard board;
    Camera camera;
    int width = 0, height = 0;
    friend bool operator==(const Stage&, const Stage&) = default;
  };

  void set_stage(const Stage& stage, const Sight& sight);
  void draw_stage(const Stage& stage, const Sight& sight, GLuint framebuffer);
  /// `program` in use, with all that shaders share.
  void prepare(const Program& program, const Table& table, const Sight& sight, const Canvas& canvas) const;
  void draw_plain(const Picture& picture, const Sight& sight, const Canvas& canvas);
  void draw_marks(const Picture& picture, const Sight& sight, const Canvas& canvas);
  void draw_overlay(const Picture& picture, const Sight& sight, const Canvas& canvas);
  void draw_points(const Picture& picture, const Sight& sight, float pixel);
  void draw_pieces(const Picture& picture, const Sight& sight, const Canvas& canvas);
  void draw_plan(const Picture& picture, const Sight& sight, const Canvas& canvas);
  void draw_rows(FloatStream& stream);

  Program stage_program_, mark_program_, piece_program_, plan_program_, point_program_, flat_program_, overlay_program_;
  FloatStream mesh_, marks_, pieces_, plan_, points_, plain_, overlay_;
  GlName<destroy_texture> wood_, digits_;
  Target samples_, kept_;
  std::optional<Stage> stage_;
  std::optional<Table> plain_table_;  ///< of which plain_ is
  Stage last_;                        ///< of the last frame
  std::vector<float> rows_;
  std::vector<const Piece*> order_;
};

}  // namespace rink::view
