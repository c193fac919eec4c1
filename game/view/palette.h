// The colours of the two teams: red and blue, and pairs that colour-blind people tell apart.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "game/control/game.h"
#include "game/view/render/overlay.h"

namespace rink::view {

enum class PaletteKind : std::uint8_t { standard, no_red_green, no_blue_yellow };

/// Teams are called by the names of their colours, which the words over the picture repeat.
struct Palette {
  const char* name;   ///< in the file of settings
  const char* label;  ///< in the menu
  const char* left_name;
  const char* right_name;
  Colour left, right;
  Colour ring;  ///< of a puck
};

/// For protanopia and deuteranopia orange and blue, for tritanopia vermilion and bluish green, in
/// the manner of Okabe and Ito (Color Universal Design, 2008).
inline constexpr std::array<Palette, 3> palettes{Palette{"red-blue",
                                                         "Colours: red, blue",
                                                         "Red",
                                                         "Blue",
                                                         {1.0f, 0.36f, 0.27f, 1.0f},
                                                         {0.13f, 0.62f, 1.0f, 1.0f},
                                                         {1.0f, 0.74f, 0.12f, 1.0f}},
                                                 Palette{"orange-blue",
                                                         "Colours: orange, blue",
                                                         "Orange",
                                                         "Blue",
                                                         {1.0f, 0.58f, 0.0f, 1.0f},
                                                         {0.10f, 0.45f, 0.95f, 1.0f},
                                                         {0.95f, 0.96f, 0.98f, 1.0f}},
                                                 Palette{"red-green",
                                                         "Colours: red, green",
                                                         "Red",
                                                         "Green",
                                                         {0.95f, 0.27f, 0.10f, 1.0f},
                                                         {0.0f, 0.58f, 0.46f, 1.0f},
                                                         {0.95f, 0.96f, 0.98f, 1.0f}}};

constexpr const Palette& palette_of(PaletteKind kind) {
  return palettes[static_cast<std::size_t>(kind)];
}

/// Nothing if no palette is called so.
std::optional<PaletteKind> palette_from_name(std::string_view name);
/// All of them in quotes, as a list in a sentence.
std::string palette_names();

/// Green for who is in no team.
Colour colour_of(game::Team team, const Palette& palette);

}  // namespace rink::view
