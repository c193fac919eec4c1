// The sample of docs/transports.md, a complete transport: Unix-domain sockets and ppoll.
#pragma once

#include <poll.h>
#include <sys/socket.h>
#include <sys/un.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <utility>
#include <vector>

#include "rti/transport/readiness.h"
#include "rti/transport/transport.h"

namespace rink::rti::sample {
using namespace std::chrono_literals;

/// Any number of connections between processes of one machine, by name.
class UnixTransport final : public Transport {
 public:
  explicit UnixTransport(std::size_t queue_max = 1u << 20) : queue_max_(queue_max) {}

  /// Throws TransportError in_use if somebody listens to that name.
  void listen(const std::string& name) {
    using enum TransportError::Kind;
    File file(::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0));
    if (call_with(name, ::bind, file) != 0 || ::listen(file.number(), 4096) != 0)
      throw TransportError(errno == EADDRINUSE ? in_use : failed,
                           "can't listen at '" + name + "': " + std::strerror(errno));
    listening_.push_back(std::move(file));
  }

  /// `on_open` follows in a poll, or `on_close` with `refused`.
  ConnectionId connect(const std::string& name) {
    const ConnectionId id = add(File(::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0)));
    if (call_with(name, ::connect, peers_[id].file) != 0) end(id, CloseReason::refused);
    return id;
  }

  void poll(std::chrono::nanoseconds longest_wait, TransportListener& listener) override {
    if (report(listener)) longest_wait = {};  // something has happened: don't wait
    watched_.clear();
    for (const File& file : listening_) watched_.push_back({file.number(), POLLIN, 0});
    for (const Peer& peer : peers_) {  // a closed one has file -1, which ppoll skips
      const short events = peer.queue.empty() ? POLLIN : POLLIN | POLLOUT;
      watched_.push_back({peer.file.number(), events, 0});
    }
    const timespec timeout{longest_wait / 1s, (longest_wait % 1s).count()};
    if (::ppoll(watched_.data(), watched_.size(), &timeout, nullptr) <= 0) return;
    for (std::size_t i = 0; i < watched_.size(); ++i) {
      if (watched_[i].revents == 0) continue;
      const auto peer = static_cast<ConnectionId>(i - listening_.size());
      if (i >= listening_.size()) take(peer, watched_[i].revents, listener);
      else add(File(::accept4(watched_[i].fd, nullptr, nullptr, SOCK_CLOEXEC)));
    }
    report(listener);
  }

  void send(ConnectionId connection, std::span<const Bytes> parts) override {
    if (!is_open(connection)) return;
    Peer& peer = peers_[connection];
    const std::size_t before = peer.queue.size();
    for (const Bytes part : parts) peer.queue.insert(peer.queue.end(), part.begin(), part.end());
    if (peer.queue.size() == before) return;
    peer.counters.segments_sent += (peer.queue.size() - before + 1447) / 1448;
    ++peer.counters.writes;
    drain(connection);
    if (peer.queue.size() > queue_max_) end(connection, CloseReason::queue_full);
  }

  void close(ConnectionId connection) override {
    if (!is_open(connection)) return;
    drain(connection);
    if (is_open(connection)) end(connection, CloseReason::closed_by_us);
  }

  TransportCounters counters(ConnectionId connection) const override {
    if (connection >= peers_.size()) return {};
    TransportCounters counters = peers_[connection].counters;
    counters.queued_bytes = peers_[connection].queue.size();
    return counters;
  }

 private:
  struct Peer {
    File file;                     ///< none once closed
    std::vector<std::byte> queue;  ///< accepted by `send`, not yet taken by the kernel
    TransportCounters counters;
  };
  using News = std::pair<ConnectionId, std::optional<CloseReason>>;  ///< no reason: has opened

  /// Binds or connects `file` to an abstract name, which leaves no file behind.
  static int call_with(const std::string& name, auto bind_or_connect, const File& file) {
    sockaddr_un address{.sun_family = AF_UNIX, .sun_path = {}};
    name.copy(address.sun_path + 1, sizeof address.sun_path - 1);
    return bind_or_connect(file.number(), reinterpret_cast<sockaddr*>(&address), sizeof address);
  }
  bool is_open(ConnectionId each) const { return each < peers_.size() && peers_[each].file; }
  ConnectionId add(File file) {
    peers_.emplace_back().file = std::move(file);
    return news_.emplace_back(peers_.size() - 1, std::nullopt).first;
  }
  /// Tells what was noted, and what the listener's own calls add to it; true if there was anything.
  bool report(TransportListener& listener) {
    bool has_told = false;
    for (std::vector<News> told; !news_.empty(); told.clear(), has_told = true) {
      told.swap(news_);
      for (const auto& [connection, reason] : told)
        if (reason) listener.on_close(connection, *reason, "");
        else if (is_open(connection)) listener.on_open(connection);
    }
    return has_told;
  }
  void take(ConnectionId connection, short events, TransportListener& listener) {
    if ((events & POLLOUT) != 0 && is_open(connection)) drain(connection);
    if ((events & ~POLLOUT) == 0 || !is_open(connection)) return;
    Peer& peer = peers_[connection];
    const auto size = ::recv(peer.file.number(), buffer_.data(), buffer_.size(), MSG_DONTWAIT);
    if (size < 0 && (errno == EAGAIN || errno == EINTR)) return;
    if (size <= 0) return end(connection, CloseReason::closed_by_peer);
    peer.counters.bytes_received += static_cast<std::uint64_t>(size);
    listener.on_bytes(connection, Bytes(buffer_).first(static_cast<std::size_t>(size)));
  }
  void drain(ConnectionId connection) {
    Peer& peer = peers_[connection];
    const int flags = MSG_DONTWAIT | MSG_NOSIGNAL;
    const auto size = ::send(peer.file.number(), peer.queue.data(), peer.queue.size(), flags);
    const bool is_full = errno == EAGAIN || errno == EINTR;
    if (size < 0) return is_full ? void() : end(connection, CloseReason::closed_by_peer);
    peer.counters.bytes_sent += static_cast<std::uint64_t>(size);
    peer.queue.erase(peer.queue.begin(), peer.queue.begin() + size);
  }
  void end(ConnectionId connection, CloseReason reason) {
    peers_[connection].file.close();
    peers_[connection].queue = {};
    news_.push_back({connection, reason});
  }

  std::size_t queue_max_;
  std::vector<File> listening_;
  std::vector<Peer> peers_;  ///< by connection
  std::vector<News> news_;   ///< to be told in the next poll
  std::vector<pollfd> watched_;
  std::array<std::byte, 64 * 1024> buffer_;
};

}  // namespace rink::rti::sample
