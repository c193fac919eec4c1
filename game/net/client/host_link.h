// The connection of a match that is played elsewhere to its host.
#pragma once

#include <optional>
#include <string>

#include "game/match/server_clock.h"
#include "game/net/client/client.h"
#include "rti/transport/federate_link.h"

namespace rink::game {

/// Carries the client's bytes, measures the host's clock, and notices when the host refuses, is
/// gone, or plays no match. From then on it only reports the reason. Reads no clock.
class HostLink {
 public:
  /// `connection` was opened by `transport`, which is polled here and has no other listener; it and
  /// the client must outlive this. `is_player`: a host without a match is refused.
  HostLink(Client& client, rti::Transport& transport, rti::ConnectionId connection, bool is_player);
  HostLink(const HostLink&) = delete;
  HostLink& operator=(const HostLink&) = delete;

  /// Handles what has come by the real time `now_s`.
  void converse(double now_s);
  void flush(double now_s) { link_.flush(now_s); }
  /// Resigns; nothing may follow.
  void leave(double now_s);
  void lose(const std::string& why);

  bool is_lost() const { return !error_.empty(); }
  /// Why the host is lost; empty while it is not.
  const std::string& error() const { return error_; }
  bool has_joined() const { return joined_s_.has_value(); }
  const ServerClock& clock() const { return clock_; }

 private:
  void look_for_errors(double now_s);

  Client& client_;
  rti::Transport& transport_;
  rti::FederateLink link_;
  rti::FederateLinks links_;
  bool is_player_;
  ServerClock clock_;
  std::optional<double> joined_s_;  ///< real time
  std::string error_;
};

}  // namespace rink::game
