// Words over the picture, and the count of matches that were won.
#include "game/view/first_minute.h"

#include <algorithm>
#include <cctype>
#include <utility>

#include "game/view/picture_of.h"

namespace rink::view {
namespace {

std::string keys_of(const KeySet& keys) {
  if (keys == default_keys()[1]) return "the arrows";
  std::string words;
  for (const game::Key key : {game::Key::up, game::Key::left, game::Key::down, game::Key::right}) {
    std::string name = key_code_name(keys[static_cast<std::size_t>(key)]).value_or("?");
    if (name.size() == 1)
      name.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(name.front())));
    words += (words.empty() ? "" : " ") + name;
  }
  return words;
}

bool is_seen(const Settings& settings, Hint hint) {
  return settings.hints_seen[static_cast<std::size_t>(hint)];
}

/// How the bats are moved.
std::string ways_to_move(const Settings& settings, bool is_alone) {
  const std::string left = keys_of(settings.keys[0]), right = keys_of(settings.keys[1]);
  if (settings.control == Control::pointer && is_alone) return "Your bat follows the pointer";
  if (settings.control == Control::gamepad && is_alone) return "The left stick moves your bat";
  return is_alone ? left + " or " + right + " move your bat"
                  : left + " move the left bat, " + right + " the right one";
}

}  // namespace

bool FirstMinute::use(Hint hint, Settings& settings) {
  return !std::exchange(settings.hints_seen[static_cast<std::size_t>(hint)], true);
}

bool FirstMinute::look(const MatchSight& sight, double now_s, Settings& settings) {
  if (sight.phase != Phase::playing) {
    playing_since_s_.reset();
    return false;
  }
  if (!playing_since_s_) playing_since_s_ = now_s;
  return now_s > *playing_since_s_ + rules_s && use(Hint::how_to_play, settings);
}

void FirstMinute::add_to(const MatchSight& sight, const Settings& settings, bool is_alone,
                         Picture& words) const {
  const bool is_running = sight.phase == Phase::playing,
             is_before = sight.phase == Phase::countdown || sight.phase == Phase::waiting;
  if ((is_before || is_running) && !is_seen(settings, Hint::how_to_play) && sight.goals_to_win) {
    float y = 0.68f;
    for (const std::string& line :
         {std::string("Shoot the puck into the goal across, and guard your own"),
          ways_to_move(settings, is_alone) + "; each stays in its half",
          "Who scores " + std::to_string(*sight.goals_to_win) + " goals first wins"}) {
      words.texts.push_back({.words = line, .y = y, .size = 0.036f, .has_plate = true});
      y += 0.058f;
    }
  }
  if (!is_running || !sight.notice.empty()) return;
  std::string hints;
  const auto hint = [&](Hint which, const std::string& text) {
    if (!is_seen(settings, which)) hints += (hints.empty() ? "" : "      ") + text;
  };
  if (is_seen(settings, Hint::how_to_play)) hint(Hint::move, ways_to_move(settings, is_alone));
  hint(Hint::pause, "Esc: pause");
  hint(Hint::camera, "C: camera");
  hint(Hint::help, "F1: all keys");
  if (!hints.empty())
    words.texts.push_back({.words = hints, .y = 0.955f, .size = 0.027f, .has_plate = true});
}

std::vector<std::pair<std::string, std::string>> all_keys(const Settings& settings) {
  const Palette& palette = palette_of(settings.palette);
  return {{keys_of(settings.keys[0]), std::string(palette.left_name) + " bat"},
          {keys_of(settings.keys[1]), std::string(palette.right_name) + " bat"},
          {"Esc, P", "pause"},
          {"C", "next camera"},
          {"V", "split the screen for two"},
          {"+, -, wheel", "zoom, from above"},
          {"F", "follow, from above"},
          {"Space", "skip a goal that is shown again"},
          {"M", "sound"},
          {"F3", "figures"},
          {"F11", "full screen"},
          {"Tab, I, click", "in a crowd: who receives what"},
          {"Space, arrows, Home", "replay: stop, seek and speed, start"}};
}

void Series::look(const MatchSight& sight) {
  const bool is_over = sight.phase == Phase::over;
  if (is_over && phase_ != Phase::over && sight.winner)
    ++(*sight.winner == game::Team::left ? left_ : right_);
  if (!is_over && phase_ == Phase::over && winner()) left_ = right_ = 0;
  phase_ = sight.phase;
}

std::optional<game::Team> Series::winner() const {
  if (left_ >= wins_needed) return game::Team::left;
  if (right_ >= wins_needed) return game::Team::right;
  return std::nullopt;
}

void Series::add_to(const MatchSight& sight, const Palette& palette, Picture& words) const {
  const bool is_over = sight.phase == Phase::over,
             is_between = sight.phase == Phase::countdown && left_ + right_ > 0;
  if (!is_over && !is_between) return;
  const std::string count = std::to_string(left_) + " : " + std::to_string(right_);
  std::string line = "Best of three: " + count;
  if (const auto team = winner()) {
    const std::string name = name_of(sight, *team, palette);
    line = name + (name == "You" ? " win" : " wins") + " the best of three " + count;
  }
  words.texts.push_back({.words = line, .y = 0.605f, .size = 0.042f, .has_plate = true});
}

}  // namespace rink::view
