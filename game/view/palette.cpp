// Names of palettes, and whose colour is which.
#include "game/view/palette.h"

#include <algorithm>

namespace rink::view {

std::optional<PaletteKind> palette_from_name(std::string_view name) {
  const auto found = std::ranges::find(
      palettes, name, [](const Palette& palette) { return std::string_view(palette.name); });
  if (found == palettes.end()) return std::nullopt;
  return static_cast<PaletteKind>(found - palettes.begin());
}

std::string palette_names() {
  std::string names;
  for (std::size_t k = 0; k < palettes.size(); ++k)
    names += (k == 0                    ? "\""
              : k + 1 < palettes.size() ? ", \""
                                        : " or \"") +
             std::string(palettes[k].name) + '"';
  return names;
}

Colour colour_of(game::Team team, const Palette& palette) {
  if (team == game::Team::left) return palette.left;
  return team == game::Team::right ? palette.right : Colour{0.45f, 0.75f, 0.45f, 1.0f};
}

}  // namespace rink::view
