// Draws a Picture with OpenGL 3.3.
#pragma once

#include <vector>

#include "game/view/render/canvas.h"
#include "game/view/render/gl_objects.h"
#include "game/view/render/kept_stages.h"
#include "game/view/render/picture.h"
#include "game/view/render/plain_table.h"

namespace rink::view {

/// The standing part is kept while the camera, the score and the canvas do not change; a frame then
/// copies it and draws the moving part. In software that is the difference between 15 and 200
/// frames per second (docs/play.md). The context that was current when it was made must be current
/// always.
class Renderer {
 public:
  /// Throws GraphicsError.
  Renderer();

  /// Draws all but the dimming and the texts.
  void draw(const Picture& picture, const Canvas& canvas);
  /// False while the next frames still smooth what the last ones showed.
  bool is_settled() const;

 private:
  const Target* find_stage(const Picture& picture, const Sight& sight, const Canvas& canvas);
  static void show_stage(const Target& stage, const Canvas& canvas);
  void draw_marks(const Picture& picture, const Sight& sight, const Canvas& canvas);
  void draw_overlay(const Picture& picture, const Sight& sight, const Canvas& canvas);
  void draw_points(const Picture& picture, const Sight& sight, float pixel);
  void draw_pieces(const Picture& picture, const Sight& sight, const Canvas& canvas);
  void draw_plan(const Picture& picture, const Sight& sight, const Canvas& canvas);
  void draw_rows(FloatStream& stream);

  Program mark_program_, piece_program_, plan_program_, point_program_, overlay_program_;
  FloatStream marks_, pieces_, plan_, points_, overlay_;
  KeptStages stages_;
  PlainTable plain_;
  GLuint depth_ = 0;        ///< of the stage that is drawn over
  Stage last_;              ///< of the last frame
  bool is_moving_ = false;  ///< it shows a camera that moves
  std::vector<float> rows_;
  std::vector<const Piece*> order_;
};

}  // namespace rink::view
