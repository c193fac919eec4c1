// Queries a running server's federations, and prints them as a table.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "rti/management/federation_report.h"

namespace rink::game {

struct StatusAnswer {
  std::optional<std::vector<rti::FederationReport>> reports;
  std::string error;  ///< why there are no reports
};

/// The address and key of a server, as in its own flags.
struct StatusQuestion {
  std::string address;
  std::uint16_t port = 0;
  std::string transport = "tcp", key_file{}, federation = "rink";
};

/// Asks by a connection of its own, without joining, so any object model will do, and waits for
/// `patience_s` [s] of `now_s`. Throws what setting up a socket and reading a key file throw.
StatusAnswer ask_status(const StatusQuestion& question, const std::function<double()>& now_s,
                        double patience_s = 3.0);

/// A paragraph for each federation, a line for each of its federates.
std::string status_table(const std::vector<rti::FederationReport>& reports);

/// Prints the table of each answer to standard output, once or every `every_s` [s] until
/// interrupted. Returns the error of an answer without reports. Throws as `ask_status` does.
std::optional<std::string> print_status(const StatusQuestion& question, double every_s,
                                        const std::function<double()>& now_s);

}  // namespace rink::game
