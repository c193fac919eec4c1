// Overlays as triangles, which are rows for the shaders.
#pragma once

#include <vector>

#include "game/view/render/picture.h"

namespace rink::view {

/// Floats of a corner of an overlay's triangle: see the shader.
inline constexpr int overlay_row[] = {4, 2, 4};

/// Triangles over the pieces; a pixel is `pixel` wide [m].
void add_overlay(const Picture& picture, float pixel, std::vector<float>& rows);

}  // namespace rink::view
