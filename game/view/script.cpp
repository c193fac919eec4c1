// A line-by-line reader.
#include "game/view/script.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <fstream>
#include <sstream>

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

void read_step(std::istringstream& line, const std::string& where, std::vector<ScriptStep>& steps) {
  ScriptStep step;
  std::string what, rest;
  if (!(line >> step.time >> what) || !std::isfinite(step.time) || step.time < 0.0)
    throw ScriptError(
        where +
        "expected a time in seconds, 0 or more, and one of: down, up, tap, text, picture, end");
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
    throw ScriptError(where + "'" + what +
                      "' is unknown: expected down, up, tap, text, picture or end");
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
