// The table without light, for a camera that moves.
#pragma once

#include <optional>

#include "game/view/render/camera.h"
#include "game/view/render/canvas.h"
#include "game/view/render/picture.h"

namespace rink::view {

/// Draws a flat table, whose mesh it keeps. The context that was current when it was made must be
/// current always.
class PlainTable {
 public:
  PlainTable();
  void draw(const Table& table, const Sight& sight, const Canvas& canvas);

 private:
  Program program_;
  FloatStream mesh_;
  std::optional<Table> table_;  ///< of which mesh_ is
};

}  // namespace rink::view
