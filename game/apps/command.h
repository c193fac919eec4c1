// The common parts of all commands: the clock, error messages, and the way from flags to the exit
// status.
#pragma once

#include <cstdint>
#include <exception>
#include <functional>
#include <sstream>
#include <string>

#include "game/apps/flags.h"

namespace rink::game {

/// The clock of this machine, the same for all its processes [s].
double now_s();

/// Sends errors to the standard error as "command: error" from now on.
void speak_as(const std::string& command);
void complain_of(const std::string& text);
void warn_of(const std::string& text);
/// Prints an error; the parts as a stream prints them.
template <class... Parts>
void complain(const Parts&... parts) {
  std::ostringstream text;
  (text << ... << parts);
  complain_of(text.str());
}
/// Prints a warning.
template <class... Parts>
void warn(const Parts&... parts) {
  std::ostringstream text;
  (text << ... << parts);
  warn_of(text.str());
}

/// Resident memory of this process [bytes].
std::uint64_t resident_bytes();

/// A command as run_command runs it.
struct Command {
  std::function<int()> run;
  /// The exit status for an exception of `run`, whose what() is printed as an error.
  std::function<int(const std::exception&)> status_of;
  int bad_flags = 2;             ///< exit status
  bool hears_interrupts = true;  ///< else they end it at once
};

/// Reads the flags, handles interrupts from then on (game/net/interrupt.h), runs the command, and
/// prints what it threw. Returns the exit status.
int run_command(Flags& flags, int count, char** words, const Command& command);

}  // namespace rink::game
