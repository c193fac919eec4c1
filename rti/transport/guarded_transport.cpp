// Strangers and what becomes of them.
#include "rti/transport/guarded_transport.h"

#include <algorithm>
#include <array>
#include <utility>

namespace rink::rti {

/// Hears the inner transport in the listener's place.
class GuardedTransport::Relay final : public TransportListener {
 public:
  Relay(GuardedTransport& guard, TransportListener& listener)
      : guard_(guard), listener_(listener) {}
  void on_open(ConnectionId connection) override {
    Stranger& stranger = guard_.meet(connection);
    stranger.is_open = true;
    guard_.speak(stranger);
  }
  void on_bytes(ConnectionId connection, Bytes bytes) override {
    guard_.hear(connection, bytes, listener_);
  }
  void on_datagram(ConnectionId connection, Bytes datagram) override {
    if (guard_.is_known(connection)) listener_.on_datagram(connection, datagram);
  }
  void on_close(ConnectionId connection, CloseReason reason, const std::string& detail) override {
    Stranger* stranger = guard_.find(connection);
    if (stranger == nullptr) return listener_.on_close(connection, reason, detail);
    const std::string why = stranger->handshake.why();
    const bool was_open = stranger->is_open, was_refused = stranger->is_refused;
    guard_.forget(connection);
    if (guard_.settings_.role == Role::rti) return;
    if (!was_open) return listener_.on_close(connection, reason, detail);
    if (was_refused) return listener_.on_close(connection, CloseReason::failed, why);
    listener_.on_close(connection, reason,
                       reason == CloseReason::closed_by_us
                           ? detail
                           : "closed before it proved that it has our key: does it ask for one?");
  }

 private:
  GuardedTransport& guard_;
  TransportListener& listener_;
};

GuardedTransport::GuardedTransport(Transport& inner, const SharedKey& key, GuardSettings settings,
                                   Clock now_s)
    : inner_(inner), key_(key), settings_(std::move(settings)), now_s_(std::move(now_s)) {}

GuardedTransport::Stranger* GuardedTransport::find(ConnectionId connection) {
  if (is_known(connection)) return nullptr;
  for (const auto& each : strangers_)
    if (each->connection == connection) return each.get();
  return nullptr;
}

GuardedTransport::Stranger& GuardedTransport::meet(ConnectionId connection) {
  if (Stranger* stranger = find(connection)) return *stranger;
  strangers_.push_back(std::make_unique<Stranger>(
      Stranger{connection,
               now_s_(),
               Handshake(key_, settings_.role, settings_.federation, draw_nonce()),
               {}}));
  return *strangers_.back();
}

void GuardedTransport::forget(ConnectionId connection) {
  std::erase_if(strangers_,
                [connection](const auto& each) { return each->connection == connection; });
}

void GuardedTransport::speak(Stranger& stranger) {
  const Bytes said = stranger.handshake.outgoing();
  if (!said.empty()) inner_.send(stranger.connection, std::span(&said, 1));
  stranger.handshake.clear_outgoing();
}

void GuardedTransport::refuse(Stranger& stranger) {
  if (stranger.is_refused) return;
  stranger.is_refused = true;
  ++refused_;
  inner_.close(stranger.connection);
}

void GuardedTransport::hear(ConnectionId connection, Bytes bytes, TransportListener& listener) {
  Stranger* stranger = find(connection);
  if (stranger == nullptr) return listener.on_bytes(connection, bytes);
  if (stranger->is_refused) return;
  const Handshake::State state = stranger->handshake.receive(bytes);
  speak(*stranger);
  if (state == Handshake::State::failed) return refuse(*stranger);
  if (state != Handshake::State::proven) return;
  const std::vector<std::byte> pending = std::move(stranger->pending);
  forget(connection);
  if (connection >= is_known_.size()) is_known_.resize(connection + 1);
  is_known_[connection] = true;
  if (const Bytes waiting = pending; !waiting.empty())
    inner_.send(connection, std::span(&waiting, 1));
  listener.on_open(connection);
  if (!bytes.empty()) listener.on_bytes(connection, bytes);
}

void GuardedTransport::poll(std::chrono::nanoseconds longest_wait, TransportListener& listener) {
  if (!strangers_.empty()) {
    const double now = now_s_();
    for (const auto& each : strangers_)
      if (each->is_open && now - each->since > settings_.patience_s) refuse(*each);
    longest_wait = std::min<std::chrono::nanoseconds>(
        longest_wait,
        std::chrono::milliseconds(100));  // or a silent stranger would outstay a long wait
  }
  Relay relay(*this, listener);
  inner_.poll(longest_wait, relay);
}

void GuardedTransport::send(ConnectionId connection, std::span<const Bytes> parts) {
  if (is_known(connection)) return inner_.send(connection, parts);
  if (settings_.role == Role::rti) return;  // nobody knows it
  Stranger& stranger = meet(connection);
  for (const Bytes part : parts)
    stranger.pending.insert(stranger.pending.end(), part.begin(), part.end());
}

}  // namespace rink::rti
