// Moves bytes in and out of the rings; a poll looks, sleeps and wakes.
#include <sys/socket.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cerrno>

#include "rti/transport/shared_memory/shared_memory.h"

namespace rink::rti {

namespace {

constexpr std::uint32_t polls_per_look =
    4;  ///< polls between two looks at the sockets while the rings are busy
constexpr const char* impossible = "its positions in shared memory are impossible";

}  // namespace

void SharedMemoryTransport::poll(std::chrono::nanoseconds longest_wait,
                                 TransportListener& listener) {
  listener_ = &listener;
  const std::uint64_t before = callbacks_;
  // A busy connection costs no system call; connections that open or close are noticed all the
  // same.
  if (open_.empty() || ++polls_ % polls_per_look == 0) handle_events();
  report();
  look_at_rings();
  if (callbacks_ == before && longest_wait.count() > 0) spin_and_sleep(longest_wait);
  report();
  listener_ = nullptr;
}

void SharedMemoryTransport::spin_and_sleep(std::chrono::nanoseconds longest_wait) {
  // The time is counted in looks: a look costs about 10 ns for each connection.
  const std::int64_t looks =
      settings_.spin.count() / static_cast<std::int64_t>(10 * (open_.size() + 1));
  for (std::int64_t i = 0; i < looks && !has_something(); ++i) {
#if defined(__x86_64__)
    __builtin_ia32_pause();
#endif
  }
  if (!has_something()) {
    for (const ConnectionId connection : open_) peers_[connection]->in.set_sleeping(true);
    // A peer that writes from now on sees that this end sleeps; what was written before is seen by
    // this look.
    if (!has_something()) {
      ++sleeps_;
      readiness_.ask(longest_wait, {});
    }
    for (const ConnectionId connection : open_) peers_[connection]->in.set_sleeping(false);
  }
  handle_events();
  report();
  look_at_rings();
}

bool SharedMemoryTransport::has_something() const {
  if (!news_.empty()) return true;
  return std::ranges::any_of(open_, [this](ConnectionId connection) {
    const Peer& peer = *peers_[connection];
    return peer.in.waiting() != 0 || (peer.queue_from < peer.queue.size() && peer.out.room() != 0);
  });
}

void SharedMemoryTransport::handle_events() {
  readiness_.ask({}, {});
  while (const auto event = readiness_.next()) {
    if (event->number >= listener_mark)
      accept(static_cast<std::size_t>(event->number - listener_mark));
    else handle_socket(static_cast<ConnectionId>(event->number));
  }
}

/// The socket brings the memory first, then nothing but wake-ups and its end.
void SharedMemoryTransport::handle_socket(ConnectionId connection) {
  Peer* peer = find(connection);
  if (peer == nullptr) return;
  if (!peer->is_open) return adopt_memory(connection);
  std::array<std::byte, 256> wakes_of_peer;
  const ssize_t size =
      ::recv(peer->socket.number(), wakes_of_peer.data(), wakes_of_peer.size(), MSG_DONTWAIT);
  if (size > 0 || (size < 0 && (errno == EAGAIN || errno == EINTR))) return;
  report();                                 // that it opened, if it opened and closed since
  if (find(connection) == nullptr) return;  // a callback closed it
  read(connection);
  if (find(connection) != nullptr) end(connection, CloseReason::closed_by_peer, "closed by peer");
}

void SharedMemoryTransport::report() {
  for (std::vector<News> telling; !news_.empty(); telling.clear()) {
    telling.swap(news_);
    for (const News& each : telling) {
      ++callbacks_;
      if (each.closed) listener_->on_close(each.connection, *each.closed, each.detail);
      else if (find(each.connection) != nullptr) listener_->on_open(each.connection);
    }
  }
}

void SharedMemoryTransport::look_at_rings() {
  // Callbacks may close connections, which leaves this list.
  for (std::size_t i = 0; i < open_.size();) {
    const ConnectionId connection = open_[i];
    drain(connection);
    if (find(connection) != nullptr) read(connection);
    if (i < open_.size() && open_[i] == connection) ++i;
  }
}

void SharedMemoryTransport::read(ConnectionId connection) {
  assert(find(connection) != nullptr && find(connection)->is_open);
  Peer& peer = *peers_[connection];
  const std::optional<std::size_t> waiting = peer.in.waiting();
  if (!waiting) return end(connection, CloseReason::failed, impossible);
  if (*waiting == 0) return;
  buffer_.resize(std::max(buffer_.size(), *waiting));
  if (peer.in.take(buffer_.data(), *waiting)) wake(peer);
  counters_[connection].bytes_received += *waiting;
  acknowledgements_[connection].received(*waiting, now_ns());
  ++callbacks_;
  listener_->on_bytes(connection, Bytes(buffer_).first(*waiting));
}

void SharedMemoryTransport::wake(const Peer& peer) {
  const std::byte anything{1};
  ++wakes_;
  // If it has no room for one more, the peer is about to be woken anyway.
  [[maybe_unused]] const ssize_t sent =
      ::send(peer.socket.number(), &anything, 1, MSG_DONTWAIT | MSG_NOSIGNAL);
}

/// Writes what fits and returns how much that was.
std::size_t SharedMemoryTransport::put(ConnectionId connection, Bytes bytes) {
  assert(find(connection) != nullptr && find(connection)->is_open);
  Peer& peer = *peers_[connection];
  const std::optional<std::size_t> room = peer.out.room();
  if (!room) {
    end(connection, CloseReason::failed, impossible);
    return 0;
  }
  const std::size_t size = std::min(*room, bytes.size());
  peer.out.put(bytes.first(size));
  counters_[connection].bytes_sent += size;
  return size;
}

void SharedMemoryTransport::send(ConnectionId connection, std::span<const Bytes> parts) {
  Peer* peer = find(connection);
  std::size_t size = 0;
  for (const Bytes part : parts) size += part.size();
  if (peer == nullptr || size == 0) return;
  TransportCounters& counters = counters_[connection];
  ++counters.writes;
  counters.segments_sent += (size + 1447) / 1448;
  acknowledgements_[connection].sent(now_ns());
  bool is_queueing = !peer->is_open || peer->queue_from < peer->queue.size();
  for (Bytes part : parts) {
    if (!is_queueing) {
      const std::size_t taken = put(connection, part);
      if (find(connection) == nullptr) return;
      part = part.subspan(taken);
      is_queueing = !part.empty();
    }
    peer->queue.insert(peer->queue.end(), part.begin(), part.end());
  }
  if (peer->is_open && peer->out.publish()) wake(*peer);
  if (is_queueing) drain(connection);
  if (find(connection) == nullptr) return;
  if (peer->queue.size() - peer->queue_from > settings_.queue_max)
    end(connection, CloseReason::queue_full,
        "did not read: more than " + std::to_string(settings_.queue_max) + " bytes waited");
}

void SharedMemoryTransport::drain(ConnectionId connection) {
  Peer* peer = find(connection);
  if (peer == nullptr || !peer->is_open || peer->queue_from == peer->queue.size()) return;
  const std::size_t taken = put(connection, Bytes(peer->queue).subspan(peer->queue_from));
  if (find(connection) == nullptr) return;
  peer->queue_from += taken;
  assert(peer->queue_from <= peer->queue.size());
  if (taken > 0 && peer->out.publish()) wake(*peer);
  if (peer->queue_from < peer->queue.size()) {
    peer->out.set_waiting();
    if (peer->queue_from < settings_.queue_max / 2) return;
    peer->queue.erase(peer->queue.begin(),
                      peer->queue.begin() + static_cast<std::ptrdiff_t>(peer->queue_from));
  } else {
    peer->queue.clear();
  }
  peer->queue_from = 0;
}

}  // namespace rink::rti
