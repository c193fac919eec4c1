// Exit statuses of networked commands, so that a script can tell one failure from another.
#pragma once

#include <exception>

#include "rti/membership.h"

namespace rink::game {

/// Exit statuses of rink-serve, rink-bots and rink-play; every command's --help lists them.
enum class ExitStatus : int {
  ok = 0,
  failed = 1,           ///< something the operating system refused
  bad_input = 2,        ///< a flag or a file
  address_in_use = 10,  ///< or not of this machine
  no_server = 11,       ///< nobody listens there
  wrong_version = 12,
  wrong_fom = 13,
  not_admitted = 14,   ///< name taken, federation full or of another name, no bat free
  too_few_files = 15,  ///< the limit of open files is too low and may not be raised
  connection_lost = 16,
  nobody_came = 17,     ///< the players that were waited for did not all join in time
  no_display = 18,      ///< and so no window, or no OpenGL 3.3
  may_have_split = 19,  ///< a peer continued alone, and the other may have done so too
  interrupted = 130
};

inline constexpr const char* exit_status_help =
    "Exit status: 0 done, 1 failed, 2 bad flag or file, 10 address in use, 11 no server there, 12 "
    "wrong protocol version, 13 wrong object model,\n"
    "14 not admitted, 15 too few file descriptors, 16 connection lost, 17 players did not come, 18 "
    "no display,\n19 a peer went on alone and the other may have too, 130 interrupted.";

constexpr ExitStatus exit_status(rti::Refusal refusal) {
  if (refusal == rti::Refusal::wrong_version) return ExitStatus::wrong_version;
  if (refusal == rti::Refusal::wrong_fom) return ExitStatus::wrong_fom;
  return ExitStatus::not_admitted;
}

/// A command's exit statuses for failures of a transport.
struct TransportStatuses {
  ExitStatus bad_address, too_many_files, otherwise;
};

/// `bad_input` if `error` is no failure of a transport. A bad address is in use, not of this
/// machine, or not allowed.
ExitStatus exit_status(const std::exception& error, const TransportStatuses& statuses);

}  // namespace rink::game
