// rink rti while it runs: a directory of federation executions behind one socket.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "game/net/exit_status.h"
#include "rti/federation_directory.h"
#include "rti/fom/fom.h"
#include "rti/management/federation_report.h"
#include "rti/transport/federation_host.h"
#include "rti/transport/socket_transport.h"
#include "rti/transport/staged/staged_transport.h"

namespace rink::game {

struct RtiOptions {
  std::vector<std::string> fom{}, check{}, federations{};
  std::string listen = "127.0.0.1:7000", transport = "tcp", scheme = "none", key_file{}, save{};
  double rate_limit_bytes_per_s = 0.0, frame_limit_per_s = 0.0;  ///< of each federate; 0: none
  std::optional<std::uint32_t> address_limit{};                  ///< see GateSettings
  std::uint32_t federates_max = 16'000, executions_max = 64;
  std::string status{};  ///< not empty: only query that server
  double every_s = 0.0;
};

/// Hosts federation executions of one object model until it is interrupted, and prints who comes
/// and goes.
class RtiHost {
 public:
  /// The model must outlive it. Throws std::runtime_error for a key file, a federation's name, or a
  /// flag that cannot be.
  RtiHost(const RtiOptions& options, const rti::Fom& fom);

  /// Returns the port. Throws TransportError.
  std::uint16_t listen();
  /// Serves for up to `seconds` [s], less once anything has come.
  void serve(double seconds);
  /// Tells every federate that the RTI ends, and closes their connections.
  void end();

 private:
  using Joined = std::map<std::string, std::vector<rti::FederateReport>>;  ///< by federation
  void print_changes();

  RtiOptions options_;
  rti::FederationDirectory directory_;
  rti::SocketTransport sockets_;
  rti::StagedTransport gate_;
  rti::FederationHost host_;
  Joined joined_;  ///< as last printed
  double printed_s_ = 0.0;
};

}  // namespace rink::game
