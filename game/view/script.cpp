// A line-by-line reader.
#include "game/view/script.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <fstream>
#include <optional>
#include <sstream>
#include <utility>

namespace rink::view {
namespace {

constexpr double tap_s = 0.05;

WindowEvent key_event(KeyCode code, bool is_down) {
  return {.kind = WindowEvent::Kind::key, .key = code, .is_down = is_down};
}

std::string trimmed(const std::string& text) {
  const auto first = text.find_first_not_of(" \t\r"), last = text.find_last_not_of(" \t\r");
  return first == std::string::npos ? "" : text.substr(first, last - first + 1);
}

/// Two numbers within `most` each way.
std::optional<std::pair<double, double>> numbers_of(const std::string& text, double most) {
  std::istringstream words(text);
  double x = 0.0, y = 0.0;
  std::string rest;
  if (!(words >> x >> y) || words >> rest || !(std::abs(x) <= most && std::abs(y) <= most))
    return std::nullopt;
  return std::pair(x, y);
}

WindowEvent hand_event(const std::string& what, const std::string& rest, const std::string& where) {
  using Kind = WindowEvent::Kind;
  if (what == "gamepad") {
    if (rest != "on" && rest != "off") throw ScriptError(where + "gamepad must be on or off");
    return {.kind = Kind::gamepad, .is_down = rest == "on"};
  }
  const bool is_stick = what == "stick";
  const auto place = numbers_of(rest, is_stick ? 1.0 : 1e3);
  if (!place)
    throw ScriptError(where + what +
                      (is_stick ? " needs two numbers from -1 to 1: right and up"
                                : " needs a place on the field: two numbers of metres"));
  return {.kind = is_stick ? Kind::stick : Kind::pointer, .x = place->first, .y = place->second};
}

void read_step(std::istringstream& line, const std::string& where, std::vector<ScriptStep>& steps) {
  ScriptStep step;
  std::string what, rest;
  if (!(line >> step.time >> what) || !std::isfinite(step.time) || step.time < 0.0)
    throw ScriptError(
        where +
        "expected a time in seconds, 0 or more, and one of: down, up, tap, text, pointer, stick, "
        "gamepad, picture, end");
  std::getline(line, rest);
  rest = trimmed(rest);
  if (what == "text") {
    for (const char letter : rest)
      step.events.push_back(
          {.kind = WindowEvent::Kind::text, .character = static_cast<unsigned char>(letter)});
  } else if (what == "picture") {
    if (rest.empty()) throw ScriptError(where + "picture needs the name of a file");
    step.picture = rest;
  } else if (what == "end") {
    step.is_end = true;
  } else if (what == "pointer" || what == "stick" || what == "gamepad") {
    step.events.push_back(hand_event(what, rest, where));
  } else if (what == "down" || what == "up" || what == "tap") {
    const auto code = key_code_from_name(rest);
    if (!code)
      throw ScriptError(
          where + "there is no key '" + rest +
          "'; keys are called: a, 7, up, left shift, space, f1, keypad 4, comma, ...");
    step.events.push_back(key_event(*code, what != "up"));
    if (what == "tap")
      steps.push_back(
          {.time = step.time + tap_s, .events = {key_event(*code, false)}, .picture = {}});
  } else {
    throw ScriptError(
        where + "'" + what +
        "' is unknown: expected down, up, tap, text, pointer, stick, gamepad, picture or end");
  }
  steps.push_back(step);
}

}  // namespace

std::vector<ScriptStep> parse_script(std::string_view text, const std::string& file) {
  std::vector<ScriptStep> steps;
  std::istringstream stream{std::string(text)};
  std::string words;
  for (int number = 1; std::getline(stream, words); ++number) {
    words = trimmed(words.substr(0, words.find('#')));
    if (words.empty()) continue;
    std::istringstream line(words);
    read_step(line, file + ":" + std::to_string(number) + ": ", steps);
  }
  std::ranges::stable_sort(steps, {}, &ScriptStep::time);
  return steps;
}

std::vector<ScriptStep> read_script(const std::string& file) {
  std::ifstream stream(file);
  if (!stream) throw ScriptError("cannot read the script '" + file + "'");
  std::ostringstream text;
  text << stream.rdbuf();
  return parse_script(text.str(), file);
}

std::span<const ScriptStep> due_steps(const std::vector<ScriptStep>& steps, std::size_t& next,
                                      double now) {
  assert(next <= steps.size() && std::ranges::is_sorted(steps, {}, &ScriptStep::time));
  const std::size_t first = next;
  while (next < steps.size() && steps[next].time <= now) ++next;
  return std::span(steps).subspan(first, next - first);
}

}  // namespace rink::view
