// A picture to draw, as plain data: no game, no window, no OpenGL.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "game/view/render/camera.h"
#include "game/view/render/overlay.h"

namespace rink::view {

/// A piece on the table.
struct Piece {
  enum class Shape : std::uint8_t { puck, bat, post };
  Shape shape = Shape::puck;
  float x = 0.0f, y = 0.0f;                    ///< of its centre [m]
  float half_x = 0.04f, half_y = 0.04f;        ///< both the radius for discs [m]
  float height = 0.02f;                        ///< m
  float velocity_x = 0.0f, velocity_y = 0.0f;  ///< m/s; a fast piece has a streak
  Colour colour{}, accent{};                   ///< the body, and its ring or inlay
  static constexpr float even = -1000.0f;
  float angle = even;  ///< to which a puck is turned [rad], which its broken ring shows; or `even`
};

/// What glows along a line on the table: a trail, a spark.
struct Streak {
  float x = 0.0f, y = 0.0f, end_x = 0.0f, end_y = 0.0f;  ///< m
  float half_width = 0.0f, end_half_width = 0.0f;        ///< m
  float fading = 0.0f;  ///< alpha at its end, as a part of that at its beginning
  Colour colour{};
};

/// The table's sizes and colours.
struct Table {
  float length = 2.4f, width = 1.2f, goal_width = 0.4f;  ///< m
  Colour left{}, right{};                                ///< of the two teams
  friend bool operator==(const Table&, const Table&) = default;
};

/// The board with the score. It stands upright with its middle over (x, y), facing a viewer that
/// looks along (`ahead_x`, `ahead_y`).
struct Scoreboard {
  bool is_there = true;
  float x = 0.0f, y = 0.0f, ahead_x = 0.0f, ahead_y = 1.0f;
  std::uint32_t first = 0, second = 0;  ///< as read from left to right, each at most 99
  bool is_left_first = true;            ///< the first number has the left team's colour
  friend bool operator==(const Scoreboard&, const Scoreboard&) = default;
};

/// Text in the window's plane.
struct Text {
  std::string words;
  float x = 0.5f, y = 0.5f;  ///< of the window, from the upper left; the place of the text's
                             ///< middle, or its left or right end
  float size = 0.05f;        ///< height of its letters' line, as a part of the window's height
  enum class Align : std::uint8_t { left, middle, right };
  Align align = Align::middle;
  Colour colour{1.0f, 1.0f, 1.0f, 1.0f};
  bool has_plate = false;  ///< a dark plate behind it, where the picture is bright
};

/// A rectangle in the window's plane, over the picture and under its words; parts of the window.
struct Panel {
  float x = 0.0f, y = 0.0f, width = 0.0f, height = 0.0f;  ///< from the upper left
  Colour fill{0.0f, 0.0f, 0.0f, 0.0f}, outline{0.0f, 0.0f, 0.0f, 0.0f};
};

struct Picture {
  Table table;
  Camera camera;
  Scoreboard board;
  std::vector<Piece> pieces;
  float left_glow = 0.0f,
        right_glow = 0.0f;  ///< 0 to 1: the light that a goal throws on that end of the table
  std::vector<Streak> streaks;
  float nudge_x = 0.0f,
        nudge_y = 0.0f;   ///< how far the picture is shifted right and up, in perspective: parts of
                          ///< the window's height
  float dimming = 0.0f;   ///< 0 to 1: how far everything but the texts is darkened
  bool is_split = false;  ///< another picture is beside it, in the same window
  Overlay overlay;
  std::vector<Panel> panels;
  std::vector<Text> texts;
};

}  // namespace rink::view
