// A federate that is a whole program: its ambassador, its connection over TCP, and the loop that
// moves bytes between them.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "rti/ambassador.h"
#include "rti/transport/federate_link.h"
#include "rti/transport/staged/staged_transport.h"
#include "rti/transport/tcp/tcp.h"

namespace rink::rti {

/// Where the RTI is.
struct RtiPlace {
  std::string host = "127.0.0.1";
  std::uint16_t port = 7000;
  std::string key_file{};    ///< empty: the RTI asks for no key
  std::string federation{};  ///< that the proof of the key names
};

/// Programs that have a loop of their own, or many federates, use `FederateLink` instead.
class TcpFederate {
 public:
  /// The model and the callbacks must outlive it. Throws `TransportError` if the host has no such
  /// address, std::runtime_error for a key file.
  TcpFederate(const Fom& model, FederateAmbassador& callbacks, const RtiPlace& place);

  Ambassador& ambassador() { return ambassador_; }

  /// Sends what services have asked for and calls back what arrives, until `is_done()` is true,
  /// which is asked before each wait. False if the connection has ended first: `connection_lost`
  /// or `join_refused` has said why.
  bool run(const std::function<bool()>& is_done);
  /// The same for so long [s], whatever arrives.
  bool run_for(double seconds);
  /// Leaves the federation, and returns once that is on its way, after `longest_s` [s] at most.
  void resign(double longest_s = 1.0);

 private:
  void exchange();

  TcpTransport tcp_;
  StagedTransport gate_;
  Ambassador ambassador_;
  std::optional<FederateLink> link_;
  FederateLinks links_;
};

}  // namespace rink::rti
