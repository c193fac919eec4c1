// The connection of a match that is played elsewhere to its host.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "game/match/server_clock.h"
#include "game/net/client/client.h"
#include "rti/transport/federate_link.h"

namespace rink::game {

/// A host that says nothing for so long is interrupted [s]: it beats every 0.2 s at least.
inline constexpr double interrupted_after_s = 0.5;
/// A match that was interrupted for so long is lost [s].
inline constexpr double interruption_max_s = 30.0;

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
  /// How long the host has said nothing, once joined [s]; as of the last converse().
  double silent_s() const { return silent_s_; }
  bool is_interrupted() const { return silent_s_ > interrupted_after_s; }

 private:
  void look_for_errors(double now_s);
  void listen(double now_s);

  Client& client_;
  rti::Transport& transport_;
  rti::FederateLink link_;
  rti::FederateLinks links_;
  bool is_player_;
  ServerClock clock_;
  std::optional<double> begun_s_, joined_s_;  ///< real time
  double heard_s_ = 0.0;                      ///< real time of the host's last word
  double silent_s_ = 0.0;
  std::uint64_t heard_frames_ = 0;
  std::string error_;
};

}  // namespace rink::game
