// A complete transport in one file, the sample of docs/transports.md: Unix-domain sockets and ppoll.
#pragma once

#include <poll.h>
#include <sys/socket.h>
#include <sys/un.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <utility>
#include <vector>

#include "rti/transport/readiness.h"
#include "rti/transport/transport.h"

namespace rink::rti::sample {

/// Any number of connections between processes of one machine, by name.
class UnixTransport final : public Transport {
 public:
  explicit UnixTransport(std::size_t queue_max = 1u << 20) : queue_max_(queue_max), buffer_(64 * 1024) {}

  /// Throws TransportError in_use if somebody listens to that name.
  void listen(const std::string& name) {
    File file(::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0));
    const sockaddr_un address = address_of(name);
    if (::bind(file.number(), reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0 || ::listen(file.number(), 4096) != 0)
      throw TransportError(errno == EADDRINUSE ? TransportError::Kind::in_use : TransportError::Kind::failed, "can't listen at '" + name + "': " + std::strerror(errno));
    listening_.push_back(std::move(file));
  }

  /// `on_open` follows in a poll, or `on_close` with `refused`.
  ConnectionId connect(const std::string& name) {
    const sockaddr_un address = address_of(name);
    const ConnectionId id = add(File(::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0)));
    if (::connect(peers_[id].file.number(), reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0) end(id, CloseReason::refused);
    return id;
  }

  void poll(std::chrono::nanoseconds longest_wait, TransportListener& listener) override {
    if (report(listener)) longest_wait = {};  // something has happened: don't wait
    watched_.clear();
    for (const File& file : listening_) watched_.push_back({file.number(), POLLIN, 0});
    for (const Peer& peer : peers_)  // a closed one has file -1, which ppoll skips
      watched_.push_back({peer.file.number(), static_cast<short>(peer.queue.empty() ? POLLIN : POLLIN | POLLOUT), 0});
    const timespec timeout{longest_wait.count() / 1'000'000'000, longest_wait.count() % 1'000'000'000};
    if (::ppoll(watched_.data(), watched_.size(), &timeout, nullptr) <= 0) return;
    const std::size_t listening = listening_.size();
    for (std::size_t i = 0; i < watched_.size(); ++i) {
      if (watched_[i].revents == 0) continue;
      if (i < listening) add(File(::accept4(watched_[i].fd, nullptr, nullptr, SOCK_CLOEXEC)));
      else take(static_cast<ConnectionId>(i - listening), watched_[i].revents, listener);
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
  struct News {
    ConnectionId connection;
    std::optional<CloseReason> closed;  ///< nothing: it has opened
  };

  /// An abstract name, which leaves no file behind.
  static sockaddr_un address_of(const std::string& name) {
    sockaddr_un address{.sun_family = AF_UNIX, .sun_path = {}};
    std::memcpy(address.sun_path + 1, name.data(), std::min(name.size(), sizeof address.sun_path - 1));
    return address;
  }
  bool is_open(ConnectionId connection) const { return connection < peers_.size() && peers_[connection].file; }
  ConnectionId add(File file) {
    peers_.emplace_back().file = std::move(file);
    news_.push_back({static_cast<ConnectionId>(peers_.size() - 1), {}});
    return news_.back().connection;
  }
  /// Tells what was noted, and what the listener's own calls add to it; true if there was anything.
  bool report(TransportListener& listener) {
    bool has_told = false;
    for (std::vector<News> told; !news_.empty(); told.clear(), has_told = true) {
      told.swap(news_);
      for (const News& each : told) {
        if (each.closed) listener.on_close(each.connection, *each.closed, "");
        else if (is_open(each.connection)) listener.on_open(each.connection);
      }
    }
    return has_told;
  }
  void take(ConnectionId connection, short events, TransportListener& listener) {
    if ((events & POLLOUT) != 0 && is_open(connection)) drain(connection);
    if ((events & ~POLLOUT) == 0 || !is_open(connection)) return;
    const ssize_t size = ::recv(peers_[connection].file.number(), buffer_.data(), buffer_.size(), MSG_DONTWAIT);
    if (size < 0 && (errno == EAGAIN || errno == EINTR)) return;
    if (size <= 0) return end(connection, CloseReason::closed_by_peer);
    peers_[connection].counters.bytes_received += static_cast<std::uint64_t>(size);
    listener.on_bytes(connection, Bytes(buffer_).first(static_cast<std::size_t>(size)));
  }
  void drain(ConnectionId connection) {
    Peer& peer = peers_[connection];
    const ssize_t size = ::send(peer.file.number(), peer.queue.data(), peer.queue.size(), MSG_DONTWAIT | MSG_NOSIGNAL);
    if (size < 0 && errno != EAGAIN && errno != EINTR) return end(connection, CloseReason::closed_by_peer);
    if (size <= 0) return;
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
  std::vector<std::byte> buffer_;
};

}  // namespace rink::rti::sample
