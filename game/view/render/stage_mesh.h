// The triangles of all that stands still: floor, table, surround box, goals, legs, scoreboard.
#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "game/view/render/picture.h"

namespace rink::view {

/// What the stage's fragment shader does with a surface.
enum class Material : int { floor, table, wood, painted, glowing, metal, digit };

/// Per vertex: place, normal, texture coordinates, colour, material.
inline constexpr int stage_row[] = {3, 3, 2, 3, 1};

/// Rows of triangles. Sizes other than the field's follow its width.
std::vector<float> stage_mesh(const Table& table, const Scoreboard& board);

/// What the scoreboard's face fills.
Eigen::AlignedBox3f board_box(const Table& table, const Scoreboard& board);

/// The same from straight above, where walls and table are all there is to see.
std::vector<float> plan_mesh(const Table& table);

/// Rows of triangles in plain colours, from above: place, colour.
inline constexpr int plain_row[] = {2, 3};
std::vector<float> plain_mesh(const Table& table);

}  // namespace rink::view
