// A transport with a list of stages on top, which change what arrives, what leaves and when: a
// guard, a rate limit, a spread over time.
#pragma once

#include <cassert>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "rti/transport/transport.h"

namespace rink::rti {

/// One step between a transport, which is below, and its user, which is above. This class passes
/// calls down and events up unchanged. A stage overrides what it changes, and passes on by the
/// function of this class.
class TransportStage : public Transport, protected TransportListener {
 public:
  using Clock = std::function<double()>;  ///< [s], never decreases

  TransportStage(const TransportStage&) = delete;
  TransportStage& operator=(const TransportStage&) = delete;

  bool is_behind() const override { return below_->is_behind(); }
  void poll(std::chrono::nanoseconds longest_wait, TransportListener& listener) override {
    assert(below_ != nullptr);  // it was added to a transport
    above_ = &listener;
    below_->poll(longest_wait, *this);
  }
  void send(ConnectionId connection, std::span<const Bytes> parts) override {
    below_->send(connection, parts);
  }
  void close(ConnectionId connection) override { below_->close(connection); }
  std::size_t queued_bytes(ConnectionId connection) const override {
    return below_->queued_bytes(connection);
  }
  TransportCounters counters(ConnectionId connection) const override {
    return below_->counters(connection);
  }
  std::string peer_network(ConnectionId connection) const override {
    return below_->peer_network(connection);
  }
  std::size_t datagram_max(ConnectionId connection) const override {
    return below_->datagram_max(connection);
  }
  void send_datagrams(ConnectionId connection, std::span<const Datagram> datagrams) override {
    below_->send_datagrams(connection, datagrams);
  }
  void push() override { below_->push(); }

 protected:
  TransportStage() = default;

  // These are called only while the stage is polled.
  void on_open(ConnectionId connection) override {
    assert(above_ != nullptr);
    above_->on_open(connection);
  }
  void on_bytes(ConnectionId connection, Bytes bytes) override {
    above_->on_bytes(connection, bytes);
  }
  void on_close(ConnectionId connection, CloseReason reason, const std::string& detail) override {
    above_->on_close(connection, reason, detail);
  }
  void on_datagram(ConnectionId connection, Bytes datagram) override {
    above_->on_datagram(connection, datagram);
  }
  bool on_shortage() override { return above_->on_shortage(); }

  /// For a stage that does not change what arrives: events of the transport below go straight to
  /// the listener.
  void poll_unnotified(std::chrono::nanoseconds longest_wait, TransportListener& listener) {
    below_->poll(longest_wait, listener);
  }

 private:
  friend class StagedTransport;
  Transport* below_ = nullptr;
  TransportListener* above_ = nullptr;  ///< of the last poll
};

/// Any transport, and the stages on top of it; without stages it behaves as that transport.
class StagedTransport final : public TransportStage {
 public:
  /// `inner` must outlive it, and is polled by it alone.
  explicit StagedTransport(Transport& inner) { below_ = &inner; }

  /// Makes a stage of the arguments and puts it above the existing ones. Call it before anything is
  /// sent or polled.
  template <class Stage, class... Arguments>
  Stage& add(Arguments&&... arguments) {
    auto stage = std::make_unique<Stage>(std::forward<Arguments>(arguments)...);
    Stage& added = *stage;
    assert(static_cast<TransportStage&>(added).below_ == nullptr);
    static_cast<TransportStage&>(added).below_ = std::exchange(below_, &added);
    stages_.push_back(std::move(stage));
    return added;
  }

  void poll(std::chrono::nanoseconds longest_wait, TransportListener& listener) override {
    poll_unnotified(longest_wait, listener);
  }

 private:
  std::vector<std::unique_ptr<TransportStage>> stages_;  ///< the lowest first
};

}  // namespace rink::rti
