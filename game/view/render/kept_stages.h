// The standing part of a picture, drawn once and kept.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "game/view/render/camera.h"
#include "game/view/render/gl_objects.h"
#include "game/view/render/picture.h"

namespace rink::view {

/// All that the picture of the standing part depends on.
struct Stage {
  Table table;
  Scoreboard board;
  Camera camera;
  int width = 0, height = 0;
  friend bool operator==(const Stage&, const Stage&) = default;
};

/// Draws a stage roughly at first. Four samples a pixel smooth it over the following frames, a band
/// of rows in each. The last few stages are kept, so that views beside each other, and a camera
/// that comes back, cost nothing anew. The context that was current when it was made must be
/// current always.
class KeptStages {
 public:
  KeptStages();

  void begin_frame() { ++frame_; }
  bool holds(const Stage& wanted) const;
  /// The wanted stage, one band of rows smoother than before. One that differs in the score is
  /// changed; else the least recently used one is replaced. Valid until the next call.
  const Target& show(const Stage& wanted, const Sight& sight);
  /// False while the next frames still smooth what the last ones showed.
  bool are_settled() const;

 private:
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

  void set_stage(Kept& kept, const Stage& stage, const Sight& sight);
  void draw_roughly(Kept& kept, const Sight& sight);
  void smooth(Kept& kept, const Sight& sight, const Part& part);
  void draw_stage(const Kept& kept, const Sight& sight, const Target& target, const Part& whole,
                  const Part& part);

  Program program_;
  GlName<destroy_texture> wood_, digits_;
  std::array<Kept, 4> kept_;
  Target rough_, samples_;  ///< the latter of one band of rows
  std::uint64_t frame_ = 0;
};

}  // namespace rink::view
