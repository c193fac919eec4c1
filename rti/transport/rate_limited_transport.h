// Closes whoever sends faster than allowed.
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "rti/admission/token_bucket.h"
#include "rti/transport/transport.h"

namespace rink::rti {

/// Of each connection, counted as it arrives, a datagram as a frame; 0: as much as it likes. A
/// second's worth may come at once.
struct RateLimit {
  double bytes_per_s = 0.0;
  double frames_per_s = 0.0;  ///< a federate sends one with each of its flushes (docs/wire.md)
  std::vector<std::byte> last_words{};  ///< sent to whoever exceeds it before its connection closes
};

/// Any transport whose connections are held to a limit. Who exceeds it is closed, and its end
/// reported with `too_fast`; what it sent too much is not passed on.
class RateLimitedTransport final : public Transport {
 public:
  using Clock = std::function<double()>;  ///< [s], never decreases
  /// `inner` must outlive it.
  RateLimitedTransport(Transport& inner, const RateLimit& limit, Clock now_s);
  ~RateLimitedTransport() override;

  void poll(std::chrono::nanoseconds longest_wait, TransportListener& listener) override;
  void send(ConnectionId connection, std::span<const Bytes> parts) override {
    inner_.send(connection, parts);
  }
  void close(ConnectionId connection) override { inner_.close(connection); }
  std::size_t queued_bytes(ConnectionId connection) const override {
    return inner_.queued_bytes(connection);
  }
  TransportCounters counters(ConnectionId connection) const override {
    return inner_.counters(connection);
  }
  std::size_t datagram_max(ConnectionId connection) const override {
    return inner_.datagram_max(connection);
  }
  void send_datagrams(ConnectionId connection, std::span<const Datagram> datagrams) override {
    inner_.send_datagrams(connection, datagrams);
  }
  void push() override { inner_.push(); }
  /// Connections closed for being too fast so far.
  std::uint64_t closed() const { return closed_; }

 private:
  class Relay;
  struct Meter;
  bool allows(ConnectionId connection, Bytes bytes, bool is_datagram);

  Transport& inner_;
  RateLimit limit_;
  Clock now_s_;
  std::vector<std::unique_ptr<Meter>> meters_;  ///< by connection; null once closed
  std::uint64_t closed_ = 0;
};

}  // namespace rink::rti
