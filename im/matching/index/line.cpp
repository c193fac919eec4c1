// Chooses how finely edges are rounded within a cell.
#include "im/matching/index/line.h"

namespace rink::im {

EdgeCoding::EdgeCoding(float cells_per_metre_x, float cells_per_metre_y, float widest_x,
                       float widest_y) {
  assert(cells_per_metre_x >= 0.0f && cells_per_metre_y >= 0.0f);
  assert(widest_x >= 0.0f && widest_y >= 0.0f);
  // The high edges of the boxes in a cell range over the cell and the widest of them.
  const auto high_steps = [](float cells_per_metre, float widest) {
    const float cells = cells_per_metre * widest;
    return cells < steps ? std::max(1, static_cast<std::int32_t>(steps / (1.0f + cells))) : 1;
  };
  high_steps_x_ = high_steps(cells_per_metre_x, widest_x),
  high_steps_y_ = high_steps(cells_per_metre_y, widest_y);
  assert(1 <= high_steps_x_ && high_steps_x_ <= steps && 1 <= high_steps_y_ &&
         high_steps_y_ <= steps);
  scale_ = FourFloats{cells_per_metre_x * steps, cells_per_metre_y * steps,
                      cells_per_metre_x * static_cast<float>(high_steps_x_),
                      cells_per_metre_y * static_cast<float>(high_steps_y_)};
}

}  // namespace rink::im
