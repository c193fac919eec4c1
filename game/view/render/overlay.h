// The overlay of an experiment over the field, as plain data: grid cells, subscription regions, and
// in colour which player receives what.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace rink::view {

/// Each component from 0 to 1; `alpha` 0 is invisible.
struct Colour {
  float red = 0.0f, green = 0.0f, blue = 0.0f, alpha = 1.0f;
  friend bool operator==(const Colour&, const Colour&) = default;
};

inline constexpr Colour clear{0.0f, 0.0f, 0.0f, 0.0f};

/// The same colour with another alpha.
inline Colour faded(Colour colour, float alpha) {
  colour.alpha = alpha;
  return colour;
}

/// Places and sizes are those of the field [m].
struct OverlayRectangle {
  double low_x = 0.0, low_y = 0.0, high_x = 0.0, high_y = 0.0;
  Colour fill{}, outline{};
};

/// A ring about a body, or a colour over it where `is_filled`.
struct OverlayDisc {
  double x = 0.0, y = 0.0, radius = 0.0;
  Colour colour{};
  bool is_filled = false;
};

struct Overlay {
  double cell_size = 0.0;  ///< side of the grid's cells [m]; 0 draws none
  Colour cell_colour{0.35f, 0.6f, 1.0f, 0.25f};
  std::vector<OverlayRectangle> rectangles;
  std::vector<OverlayDisc> discs;
  std::vector<std::string> lines;  ///< of text, shown in a corner
  struct Meaning {
    Colour colour{};
    std::string words{};
  };
  std::vector<Meaning> legend{};  ///< what its colours mean, shown below the lines
};

}  // namespace rink::view
