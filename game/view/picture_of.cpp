// Cameras, colours and heights of the match, and the texts over it.
#include "game/view/picture_of.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdio>

namespace rink::view {
namespace {

constexpr Colour bright{0.96f, 0.97f, 1.0f, 1.0f}, pale{0.72f, 0.77f, 0.86f, 1.0f};

/// Mixes towards white (part above 0) or black (below).
Colour toned(const Colour& colour, float part) {
  const float to = part > 0.0f ? 1.0f : 0.0f, weight = std::abs(part);
  return {std::lerp(colour.red, to, weight), std::lerp(colour.green, to, weight),
          std::lerp(colour.blue, to, weight), colour.alpha};
}

Piece piece_of(const Thing& thing, const ViewChoice& choice) {
  const Palette& palette = palette_of(choice.palette);
  Piece piece;
  piece.x = static_cast<float>(thing.position.x());
  piece.y = static_cast<float>(thing.position.y());
  piece.half_x = static_cast<float>(thing.half_extent.x());
  piece.half_y = static_cast<float>(thing.half_extent.y());
  if (choice.has_effects) {
    piece.velocity_x = static_cast<float>(thing.velocity.x());
    piece.velocity_y = static_cast<float>(thing.velocity.y());
  }
  if (thing.kind == physics::BodyKind::puck) {
    piece.shape = Piece::Shape::puck;
    piece.height = 0.6f * piece.half_x;
    piece.colour = {0.11f, 0.12f, 0.15f, 1.0f};
    piece.accent = palette.ring;
  } else if (thing.kind == physics::BodyKind::bat) {
    piece.shape = Piece::Shape::bat;
    piece.height = std::min(0.05f, 0.5f * piece.half_y);
    piece.colour = colour_of(thing.team, palette);
    piece.accent = toned(piece.colour, 0.72f);
  } else {
    piece.shape = Piece::Shape::post;
    piece.height = 1.5f * piece.half_x;
    piece.colour = {0.47f, 0.50f, 0.56f, 1.0f};
    piece.accent = {0.98f, 0.70f, 0.20f, 1.0f};
  }
  return piece;
}

Scoreboard board_of(const MatchSight& sight, Viewpoint viewpoint) {
  const auto length = static_cast<float>(sight.field.length),
             width = static_cast<float>(sight.field.width), behind = 0.16f * width;
  Scoreboard board{.first = sight.score.left, .second = sight.score.right};
  if (viewpoint == Viewpoint::left_end)
    board.x = length + behind, board.y = 0.5f * width, board.ahead_x = 1.0f, board.ahead_y = 0.0f;
  else if (viewpoint == Viewpoint::right_end)
    board.x = -behind, board.y = 0.5f * width, board.ahead_x = -1.0f, board.ahead_y = 0.0f;
  else board.x = 0.5f * length, board.y = width + behind;
  if (viewpoint == Viewpoint::right_end)
    std::swap(board.first, board.second), board.is_left_first = false;
  return board;
}

/// "RED WINS", "YOU WIN".
std::string victory(std::string name) {
  const bool is_you = name == "You";
  std::ranges::transform(name, name.begin(), [](unsigned char letter) {
    return static_cast<char>(std::toupper(letter));
  });
  return name + (is_you ? " WIN" : " WINS");
}

void add_countdown(const MatchSight& sight, std::vector<Text>& texts) {
  const double whole = std::ceil(sight.remaining_s - 0.05),
               part = whole - sight.remaining_s;  // part of the second that is over
  Colour colour{1.0f, 0.76f, 0.18f, 1.0f};
  colour.alpha = static_cast<float>(1.0 - 0.85 * part * part);
  char words[8];
  std::snprintf(words, sizeof words, "%d", static_cast<int>(whole));
  texts.push_back({.words = words,
                   .y = 0.44f,
                   .size = static_cast<float>(0.34 - 0.10 * part),
                   .colour = colour});
}

void add_interruption(double seconds, std::vector<Text>& texts) {
  texts.push_back(
      {.words = "CONNECTION INTERRUPTED", .y = 0.42f, .size = 0.085f, .colour = bright});
  texts.push_back({.words = "for " + std::to_string(static_cast<int>(seconds)) +
                            " s   the match goes on if it is back within 30 s",
                   .y = 0.51f,
                   .size = 0.042f,
                   .colour = bright});
}

void add_headlines(const MatchSight& sight, const Palette& palette, std::vector<Text>& texts) {
  const auto headline = [&](const std::string& words, const std::string& below,
                            const Colour& colour) {
    texts.push_back({.words = words, .y = 0.42f, .size = 0.17f, .colour = colour});
    if (!below.empty())
      texts.push_back({.words = below, .y = 0.545f, .size = 0.045f, .colour = bright});
  };
  const std::string score =
      std::to_string(sight.score.left) + " : " + std::to_string(sight.score.right);
  if (sight.interrupted_s) add_interruption(*sight.interrupted_s, texts);
  else if (sight.phase == Phase::countdown) add_countdown(sight, texts);
  else if (sight.phase == Phase::playing && sight.scorer)
    headline("GOAL", score, toned(colour_of(*sight.scorer, palette), 0.15f));
  else if (sight.phase == Phase::paused) headline("PAUSED", "", bright);
  else if (sight.phase == Phase::waiting) headline("WAITING", "for the other player", bright);
  else if (sight.phase == Phase::away)
    headline("OPPONENT LEFT",
             "the other player has " +
                 std::to_string(static_cast<int>(std::ceil(sight.remaining_s - 0.3))) +
                 " s to come back",
             bright);
  else if (sight.phase == Phase::lost) headline("CONNECTION LOST", "", bright);
  else if (sight.phase == Phase::over && sight.winner)
    headline(victory(name_of(sight, *sight.winner, palette)), score,
             toned(colour_of(*sight.winner, palette), 0.15f));
}

/// Whose time with the puck runs out, or has run out.
void add_possession(const MatchSight& sight, const Palette& palette, std::vector<Text>& texts) {
  if (sight.phase != Phase::playing || sight.scorer || sight.interrupted_s) return;
  const auto line = [&](const std::string& words, game::Team team) {
    texts.push_back({.words = words,
                     .y = 0.2f,
                     .size = 0.055f,
                     .colour = toned(colour_of(team, palette), 0.35f)});
  };
  if (sight.served) {
    const std::string name = name_of(sight, *sight.served, palette);
    line("Time is up: " + (name == "You" ? "your puck" : "puck to " + name), *sight.served);
  } else if (sight.holder) {
    const std::string name = name_of(sight, *sight.holder, palette),
                      left = std::to_string(
                          std::clamp(static_cast<int>(std::ceil(sight.possession_s)), 1, 3));
    line((name == "You" ? "Shoot: " : name + " must shoot: ") + left, *sight.holder);
  }
}

void add_link(const MatchSight& sight, const ViewChoice& choice, std::vector<Text>& texts) {
  float y = 0.035f;
  const auto line = [&](const char* words) {
    texts.push_back({.words = words,
                     .x = 0.985f,
                     .y = y,
                     .size = 0.026f,
                     .align = Text::Align::right,
                     .colour = pale});
    y += 0.03f;
  };
  char words[100];
  std::snprintf(words, sizeof words, "%.0f frames/s", choice.frames_per_s);
  line(words);
  if (!sight.link) return;
  const LinkFigures& link = *sight.link;
  std::snprintf(words, sizeof words, "ping %.0f ms   jitter %.1f ms   loss %.1f %%", link.ping_ms,
                link.jitter_ms, 100.0 * link.loss);
  line(words);
  std::snprintf(words, sizeof words, "tick %llu   %.0f bytes/s",
                static_cast<unsigned long long>(link.tick), link.payload_bytes_per_s);
  line(words);
  if (!sight.own_team && !sight.own_thing) return;  // who watches has no bat
  std::snprintf(words, sizeof words, "own bat %.0f ms ahead   %llu corrections, the last %.1f mm",
                link.lead_ms, static_cast<unsigned long long>(link.corrections),
                link.last_correction_mm);
  line(words);
}

/// Names beside the score at the top; in perspective the board shows the score already.
void add_names(const MatchSight& sight, const ViewChoice& choice, std::vector<Text>& texts) {
  if (!sight.goals_to_win) return;  // a crowd
  const Palette& palette = palette_of(choice.palette);
  const bool is_turned = choice.viewpoint == Viewpoint::right_end;
  const game::Team first = is_turned ? game::Team::right : game::Team::left,
                   second = is_turned ? game::Team::left : game::Team::right;
  texts.push_back({.words = name_of(sight, first, palette),
                   .x = 0.02f,
                   .y = 0.045f,
                   .size = 0.042f,
                   .align = Text::Align::left,
                   .colour = toned(colour_of(first, palette), 0.2f)});
  const bool has_corner = !choice.shows_link;
  if (has_corner)
    texts.push_back({.words = name_of(sight, second, palette),
                     .x = 0.98f,
                     .y = 0.045f,
                     .size = 0.042f,
                     .align = Text::Align::right,
                     .colour = toned(colour_of(second, palette), 0.2f)});
  if (choice.viewpoint != Viewpoint::above) return;
  texts.push_back(
      {.words = std::to_string(sight.score.left) + " : " + std::to_string(sight.score.right),
       .y = 0.05f,
       .size = 0.06f,
       .colour = bright});
}

}  // namespace

std::string name_of(const MatchSight& sight, game::Team team, const Palette& palette) {
  if (sight.link && sight.own_team) return team == *sight.own_team ? "You" : "Opponent";
  const std::string& name = team == game::Team::left ? sight.left_name : sight.right_name;
  return name == "left" ? palette.left_name : name == "right" ? palette.right_name : name;
}

Camera camera_of(const physics::Field& field, const ViewChoice& choice, double aspect) {
  const auto length = static_cast<float>(field.length), width = static_cast<float>(field.width);
  Camera camera;
  if (choice.viewpoint == Viewpoint::above) {
    const double margin = 1.0 + 0.16 * field.width / std::max(field.width, field.length / aspect);
    camera.is_plan = true;
    camera.half_height = static_cast<float>(0.5 * std::max(field.width, field.length / aspect) *
                                            margin / choice.zoom);
    camera.centre_x = static_cast<float>(choice.centre.x() * field.length);
    camera.centre_y = static_cast<float>(choice.centre.y() * field.width);
    return camera;
  }
  // Narrow windows show the table from further away; from an end it takes less of their width.
  const float away = std::max(
      1.0f, static_cast<float>((choice.viewpoint == Viewpoint::side ? 1.6 : 1.12) / aspect));
  if (choice.viewpoint == Viewpoint::side) {
    camera.target = {0.5f * length, 0.53f * width, 0.0f};
    camera.eye = camera.target + Vector3(0.0f, -1.30f * width, 1.52f * width) *
                                     (away * std::max(1.0f, length / (2.0f * width)));
    camera.opening = 0.72f;
    return camera;
  }
  const float way = choice.viewpoint == Viewpoint::left_end ? 1.0f : -1.0f,
              own = choice.viewpoint == Viewpoint::left_end ? 0.0f : length;
  camera.target = {own + way * 0.445f * length, 0.5f * width, 0.0f};
  camera.eye = camera.target + Vector3(-way * 0.90f * length, 0.0f, 0.74f * length) * away;
  camera.opening = 0.70f;
  return camera;
}

game::Key seen_from(Viewpoint viewpoint, game::Key key) {
  using game::Key;
  if (viewpoint == Viewpoint::side || viewpoint == Viewpoint::above) return key;
  constexpr std::array<Key, 4> from_left{Key::up, Key::down, Key::right, Key::left},
      from_right{Key::down, Key::up, Key::left, Key::right};  // of left, right, up, down
  return (viewpoint == Viewpoint::left_end ? from_left : from_right)[static_cast<std::size_t>(key)];
}

Picture picture_of(const MatchSight& sight, const Overlay& overlay, const ViewChoice& choice,
                   double aspect) {
  const Palette& palette = palette_of(choice.palette);
  Picture picture;
  picture.table = {static_cast<float>(sight.field.length), static_cast<float>(sight.field.width),
                   static_cast<float>(sight.field.goal_width), palette.left, palette.right};
  picture.camera = camera_of(sight.field, choice, aspect);
  picture.board = board_of(sight, choice.viewpoint);
  picture.overlay = overlay;
  picture.pieces.reserve(sight.things.size());
  for (const Thing& thing : sight.things) picture.pieces.push_back(piece_of(thing, choice));
  if (sight.scorer)
    (*sight.scorer == game::Team::right ? picture.left_glow : picture.right_glow) =
        static_cast<float>(std::exp(-1.6 * sight.since_goal_s));
  const bool is_stopped =
      sight.interrupted_s || (sight.phase != Phase::playing && sight.phase != Phase::countdown);
  picture.dimming = is_stopped ? 0.55f : sight.phase == Phase::countdown ? 0.25f : 0.0f;
  add_names(sight, choice, picture.texts);
  add_headlines(sight, palette, picture.texts);
  add_possession(sight, palette, picture.texts);
  if (!sight.notice.empty())
    picture.texts.push_back({.words = sight.notice, .y = 0.955f, .size = 0.032f, .colour = bright});
  if (choice.shows_link) add_link(sight, choice, picture.texts);
  float y = 0.12f;
  for (const std::string& line : overlay.lines) {
    picture.texts.push_back({.words = line,
                             .x = 0.02f,
                             .y = y,
                             .size = 0.028f,
                             .align = Text::Align::left,
                             .colour = bright});
    y += 0.042f;
  }
  for (const Overlay::Meaning& each : overlay.legend) {
    picture.panels.push_back({.x = 0.022f,
                              .y = y - 0.012f,
                              .width = 0.022f,
                              .height = 0.024f,
                              .fill = faded(each.colour, 1.0f),
                              .outline = bright});
    picture.texts.push_back({.words = each.words,
                             .x = 0.054f,
                             .y = y,
                             .size = 0.026f,
                             .align = Text::Align::left,
                             .colour = bright});
    y += 0.038f;
  }
  if (choice.viewpoint == Viewpoint::above)
    for (Text& text : picture.texts) text.has_plate = text.size < 0.1f;
  return picture;
}

}  // namespace rink::view
