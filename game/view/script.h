// Keys pressed and pointers moved by a file instead of a person, and pictures taken at given times:
// how tests and demonstrations drive the window.
#pragma once

#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "game/view/window/window_event.h"

namespace rink::view {

/// A script that cannot be used; what() names file, line and what was expected.
class ScriptError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// An action `time` seconds after the first frame.
struct ScriptStep {
  double time = 0.0;
  std::vector<WindowEvent> events;
  std::string picture;  ///< file to write the window's content to, or empty
  bool is_end = false;  ///< the window is to be closed
};

/// One step a line: `TIME down KEY`, `TIME up KEY`, `TIME tap KEY` (down, and up 0.05 s later),
/// `TIME text WORDS`, `TIME pointer X Y` (a place on the field [m]), `TIME stick X Y` (-1 to 1,
/// right and up), `TIME gamepad on` or `off`, `TIME picture FILE.png`, `TIME end`; a # starts a
/// comment. Ordered by time. Throws ScriptError; `file` is named in errors.
std::vector<ScriptStep> parse_script(std::string_view text, const std::string& file);
std::vector<ScriptStep> read_script(const std::string& file);

/// The steps from `next` on that are due at `now` [s]; moves `next` past them.
std::span<const ScriptStep> due_steps(const std::vector<ScriptStep>& steps, std::size_t& next,
                                      double now);

}  // namespace rink::view
