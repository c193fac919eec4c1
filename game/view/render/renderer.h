// Draws a Picture with OpenGL 3.3.
#pragma once

#include <array>
#include <cstdint>
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

/// What stands still is drawn once, roughly, and kept while the camera, the score and the canvas
/// stay as they are; a frame then copies it and draws what moves. In software that is the
/// difference between 15 and 200 frames per second (docs/play.md). Four samples a pixel smooth it
/// over the following frames, a band of rows in each. The last few stages are kept, so that views
/// beside each other, and a camera that comes back, cost nothing anew. The context that was current
/// when it was made must be current always.
class Renderer {
 public:
  /// Throws GraphicsError.
  Renderer();

  /// All but the dimming and the texts.
  void draw(const Picture& picture, const Canvas& canvas);
  /// False while the next frames still smooth what the last ones showed.
  bool is_settled() const;

 private:
  /// What a kept stage shows.
  struct Stage {
    Table table;
    Scoreboard board;
    Camera camera;
    int width = 0, height = 0;
    friend bool operator==(const Stage&, const Stage&) = default;
  };

  struct Kept {
    FloatStream mesh;
    Target target;
    std::optional<Stage> stage;
    int smooth_rows = 0;          ///< from the bottom up
    std::uint64_t last_used = 0;  ///< frame
  };
  /// A rectangle of the stage's pixels.
  struct Part {
    int x = 0, y = 0, width = 0, height = 0;
  };

  static bool differs_in_score_alone(const Stage& was, Stage is);
  Kept& kept(const Stage& wanted, const Sight& sight);
  void set_stage(Kept& kept, const Stage& stage, const Sight& sight);
  void smooth(Kept& kept, const Sight& sight, const Part& part);
  void draw_stage(const Kept& kept, const Sight& sight, const Target& target, const Part& whole,
                  const Part& part);
  /// `program` in use, with all that shaders share.
  void prepare(const Program& program, const Table& table, const Sight& sight,
               const Canvas& canvas) const;
  void draw_plain(const Picture& picture, const Sight& sight, const Canvas& canvas);
  void draw_marks(const Picture& picture, const Sight& sight, const Canvas& canvas);
  void draw_overlay(const Picture& picture, const Sight& sight, const Canvas& canvas);
  void draw_points(const Picture& picture, const Sight& sight, float pixel);
  void draw_pieces(const Picture& picture, const Sight& sight, const Canvas& canvas);
  void draw_plan(const Picture& picture, const Sight& sight, const Canvas& canvas);
  void draw_rows(FloatStream& stream);

  Program stage_program_, mark_program_, piece_program_, plan_program_, point_program_,
      flat_program_, overlay_program_;
  FloatStream marks_, pieces_, plan_, points_, plain_, overlay_;
  GlName<destroy_texture> wood_, digits_;
  std::array<Kept, 4> kept_;
  Target rough_, samples_;  ///< the latter of one band of rows
  GLuint depth_ = 0;        ///< of the stage that is drawn over
  std::uint64_t frame_ = 0;
  std::optional<Table> plain_table_;  ///< of which plain_ is
  Stage last_;                        ///< of the last frame
  bool is_moving_ = false;            ///< it shows a camera that moves
  std::vector<float> rows_;
  std::vector<const Piece*> order_;
};

}  // namespace rink::view
