// The triangles of all that stands still: floor, table, surround box, goals, legs, scoreboard.
#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "game/view/render/picture.h"

namespace rink::view {

/// The material of a surface in the stage's fragment shader.
enum class Material : int { floor, table, wood, painted, glowing, metal, digit };

/// Per vertex: place, normal, texture coordinates, colour, material.
inline constexpr int stage_row[] = {3, 3, 2, 3, 1};

/// Rows of triangles. Sizes other than the field's follow its width.
std::vector<float> stage_mesh(const Table& table, const Scoreboard& board);

/// The box of the scoreboard's face.
Eigen::AlignedBox3f board_box(const Table& table, const Scoreboard& board);

/// The mesh for the view from straight above, which shows only walls and table.
std::vector<float> plan_mesh(const Table& table);

/// Rows of triangles in plain colours, from above: place, colour.
inline constexpr int plain_row[] = {2, 3};
std::vector<float> plain_mesh(const Table& table);

}  // namespace rink::view
