// Closes connections that send faster than allowed.
#pragma once

#include <memory>
#include <vector>

#include "rti/admission/token_bucket.h"
#include "rti/transport/staged/staged_transport.h"

namespace rink::rti {

/// The limit of each connection, counted as bytes arrive, a datagram as a frame; 0 is unlimited. A
/// second's worth may come at once.
struct RateLimit {
  double bytes_per_s = 0.0;
  double frames_per_s = 0.0;  ///< a federate sends one with each of its flushes (docs/wire.md)
  std::vector<std::byte> last_words{};  ///< sent to a connection that exceeds it before that closes
};

/// Holds each connection to a limit. One that exceeds it is closed, its end reported with
/// `too_fast`, and the excess is dropped.
class RateLimiter final : public TransportStage {
 public:
  RateLimiter(const RateLimit& limit, Clock now_s);
  ~RateLimiter() override;

  /// Connections closed for being too fast so far.
  std::uint64_t closed() const { return closed_; }

 private:
  void on_open(ConnectionId connection) override;
  void on_bytes(ConnectionId connection, Bytes bytes) override {
    if (allows(connection, bytes, false)) TransportStage::on_bytes(connection, bytes);
  }
  void on_datagram(ConnectionId connection, Bytes datagram) override {
    if (allows(connection, datagram, true)) TransportStage::on_datagram(connection, datagram);
  }
  void on_close(ConnectionId connection, CloseReason reason, const std::string& detail) override;

  struct Meter;
  bool allows(ConnectionId connection, Bytes bytes, bool is_datagram);

  RateLimit limit_;
  Clock now_s_;
  std::vector<std::unique_ptr<Meter>> meters_;  ///< by connection; null once closed
  std::uint64_t closed_ = 0;
};

}  // namespace rink::rti
