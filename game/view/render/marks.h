// Marks on the table, as rows for the shaders: shadows, streaks, the glow of a goal.
#pragma once

#include <vector>

#include "game/view/render/picture.h"

namespace rink::view {

/// Floats of a mark: the box that it may cover, its form, its manner, its colour.
inline constexpr int mark_row[] = {4, 4, 4, 4};

/// `has_shadows` is false if so many pieces are visible that each is a few pixels.
void add_marks(const Picture& picture, bool has_shadows, std::vector<float>& rows);

}  // namespace rink::view
