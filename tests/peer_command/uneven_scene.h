// A scene in which one half of the field has nearly all events.
#pragma once

#include <cstdio>
#include <string>

namespace rink::game {

/// A wall of posts parts 66 fast pucks, with posts among them, from as many at rest; eight bats are
/// anywhere. Zones cut by the number of bodies have uneven loads, and posts change hands when cuts
/// shift.
inline std::string uneven_scene() {
  std::string text = R"(name = "uneven"
[field]
length = 3.0
width = 2.0
[drag]
bats = 3.0
[materials]
restitution = 1.0
[[population]]
name = "bat"
kind = "bat"
count = 8
mass = 5.0
)";
  char line[128];
  for (int k = 0; k < 10; ++k) {
    std::snprintf(line, sizeof line, "[[post]]\nposition = [1.5, %.1f]\nradius = 0.095\n",
                  0.1 + 0.2 * k);
    text += line;
  }
  for (int k = 0; k < 6; ++k) {
    std::snprintf(line, sizeof line, "[[post]]\nposition = [%.2f, %.2f]\nradius = 0.05\n",
                  0.76 + 0.24 * (k % 3), k < 3 ? 0.36 : 1.32);
    text += line;
  }
  for (int k = 0; k < 132; ++k) {
    const int half = k / 66, column = k % 66 / 6, row = k % 6;
    std::snprintf(line, sizeof line,
                  "[[puck]]\nposition = [%.2f, %.2f]\nvelocity = [%.1f, %.1f]\nradius = 0.02\n",
                  0.1 + 0.12 * column + 1.55 * half, 0.2 + 0.32 * row,
                  half == 0 ? 4.0 - 0.1 * column : 0.0, half == 0 ? 1.0 + 0.3 * row : 0.0);
    text += line;
  }
  return text;
}

}  // namespace rink::game
