// What all commands do the same way: the clock they read, how they speak of what went wrong, and
// the way from their flags to their exit status.
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

/// From now on complaints go to the standard error as "command: complaint".
void speak_as(const std::string& command);
void complain_of(const std::string& text);
void warn_of(const std::string& text);
/// What went wrong; the parts as a stream prints them.
template <class... Parts>
void complain(const Parts&... parts) {
  std::ostringstream text;
  (text << ... << parts);
  complain_of(text.str());
}
/// What may go wrong.
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
  /// The exit status for what `run` threw, whose what() is complained of.
  std::function<int(const std::exception&)> status_of;
  int bad_flags = 2;             ///< exit status
  bool hears_interrupts = true;  ///< else they end it at once
};

/// Reads the flags, hears interrupts from then on (game/net/interrupt.h), runs the command, and
/// says what it threw; the exit status.
int run_command(Flags& flags, int count, char** words, const Command& command);

}  // namespace rink::game
