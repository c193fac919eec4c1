// Moves bytes in and out of a TCP peer: one gathered write per send, a bounded queue for what the
// kernel does not take.
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <sys/uio.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cerrno>
#include <system_error>

#include "rti/transport/tcp/tcp.h"

namespace rink::rti {

namespace {

constexpr std::size_t tcp_segment_size =
    1448;                              ///< payload of an Ethernet frame with TCP time stamps
constexpr std::size_t part_max = 256;  ///< of one write; more are taken in turns
constexpr std::size_t fair_read_min = 8 * 1024;  ///< bytes that a peer's turn to be read takes
constexpr std::size_t cut_off_min = 512 * 1024;  ///< sent bytes of a queue, before they are cut off

/// True if the last write failed since the peer has closed: reading comes to the end, and what the
/// peer sent before it comes first. Ended at the write, who resigned and left would be lost.
bool has_peer_closed() { return errno == EPIPE || errno == ECONNRESET; }

}  // namespace

CloseReason TcpTransport::reason_of(int error) {
  if (error == ECONNRESET || error == EPIPE) return CloseReason::closed_by_peer;
  return error == ECONNREFUSED ? CloseReason::refused : CloseReason::failed;
}

void TcpTransport::read(Peer& peer) {
  assert(peer.is_open && !peer.is_leaving && listener_ != nullptr);
  // Peers are read in turns. If each had as much read as its socket holds, the last of 5,000 who
  // have fallen behind would wait for seconds, and take its RTI for silent.
  const std::size_t fair = std::max(fair_read_min, settings_.bytes_per_poll / (open_count_ + 1));
  const ssize_t size = ::recv(peer.file.number(), read_buffer_.data(),
                              std::min(fair, read_buffer_.size()), MSG_DONTWAIT);
  if (size == 0) return end(peer, CloseReason::closed_by_peer, "closed by peer");
  if (size < 0) {
    if (errno == EAGAIN || errno == EWOULDBLOCK || errno == EINTR) return;
    const int error = errno;
    return end(peer, reason_of(error), std::generic_category().message(error));
  }
  peer.counters.bytes_received += static_cast<std::uint64_t>(size);
  bytes_taken_ += static_cast<std::uint64_t>(size);
  listener_->on_bytes(peer.id, Bytes(read_buffer_).first(static_cast<std::size_t>(size)));
}

std::size_t TcpTransport::write(Peer& peer, std::span<const Bytes> parts, bool& is_broken) {
  assert(peer.is_open && !peer.is_leaving);
  std::array<iovec, part_max> vectors;
  std::size_t taken = 0;
  while (!parts.empty()) {
    std::size_t count = 0, size = 0;
    for (; count < std::min(parts.size(), part_max); ++count) {
      vectors[count] = {const_cast<std::byte*>(parts[count].data()),
                        parts[count].size()};  // sendmsg only reads
      size += parts[count].size();
    }
    parts = parts.subspan(count);
    msghdr message{};
    message.msg_iov = vectors.data();
    message.msg_iovlen = count;
    ssize_t sent = 0;
    do
      sent = count == 1 ? ::send(peer.file.number(), vectors[0].iov_base, size,
                                 MSG_NOSIGNAL | MSG_DONTWAIT)
                        : ::sendmsg(peer.file.number(), &message, MSG_NOSIGNAL | MSG_DONTWAIT);
    while (sent < 0 && errno == EINTR);
    if (sent < 0) {
      is_broken = errno != EAGAIN && errno != EWOULDBLOCK;
      break;
    }
    taken += static_cast<std::size_t>(sent);
    if (static_cast<std::size_t>(sent) < size) break;
  }
  peer.counters.bytes_sent += taken;
  return taken;
}

void TcpTransport::send(ConnectionId connection, std::span<const Bytes> parts) {
  Peer* peer = find(connection);
  if (peer == nullptr || peer->is_leaving) return;
  std::size_t size = 0;
  for (const Bytes part : parts) size += part.size();
  if (size == 0) return;
  ++peer->counters.writes;
  peer->counters.segments_sent += (size + tcp_segment_size - 1) / tcp_segment_size;
  bool is_broken = false;
  std::size_t taken = 0;
  if (peer->is_open && peer->queue.size() == peer->queue_from)
    taken = write(*peer, parts, is_broken);
  if (is_broken && has_peer_closed()) return;
  if (is_broken) return end(*peer, CloseReason::closed_by_peer, "closed by peer");
  if (taken == size) return;
  const std::size_t waiting = peer->queue.size() - peer->queue_from;
  if (waiting + size - taken > settings_.queue_max)
    return end(*peer, CloseReason::queue_full,
               "did not read: more than " + std::to_string(settings_.queue_max) + " bytes waited");
  for (const Bytes part : parts) {
    const std::size_t skipped = std::min(taken, part.size());
    taken -= skipped;
    peer->queue.insert(peer->queue.end(), part.begin() + static_cast<std::ptrdiff_t>(skipped),
                       part.end());
  }
  if (peer->is_open) await_room(*peer);
}

void TcpTransport::await_room(Peer& peer) {
  if (peer.is_writing) return;
  peer.is_writing = true;
  readiness_.change(peer.file.number(), peer.id, true, true);
}

void TcpTransport::drain(Peer& peer) {
  assert(peer.is_writing && peer.queue_from <= peer.queue.size());
  const Bytes waiting = Bytes(peer.queue).subspan(peer.queue_from);
  bool is_broken = false;
  peer.queue_from += write(peer, std::span(&waiting, 1), is_broken);
  if (is_broken && !has_peer_closed())
    return end(peer, CloseReason::closed_by_peer, "closed by peer");
  if (!is_broken && peer.queue_from < peer.queue.size()) {
    // Bytes that were sent are cut off now and then, so that a slow but steady reader does not make
    // the queue's memory grow.
    if (peer.queue_from > std::max(cut_off_min, peer.queue.size() / 2)) {
      peer.queue.erase(peer.queue.begin(),
                       peer.queue.begin() + static_cast<std::ptrdiff_t>(peer.queue_from));
      peer.queue_from = 0;
    }
    return;  // and waits on
  }
  peer.queue = {};
  peer.queue_from = 0;
  peer.is_writing = false;
  readiness_.change(peer.file.number(), peer.id, true, false);
}

std::size_t TcpTransport::queued_bytes(ConnectionId connection) const {
  const Peer* peer = find(connection);
  return peer == nullptr ? 0 : peer->queue.size() - peer->queue_from;
}

void TcpTransport::close(ConnectionId connection) {
  Peer* peer = find(connection);
  if (peer == nullptr || peer->is_leaving) return;
  if (peer->is_open && peer->queue_from < peer->queue.size()) {
    bool is_broken = false;
    const Bytes waiting = Bytes(peer->queue).subspan(peer->queue_from);
    write(*peer, std::span(&waiting, 1), is_broken);
  }
  if (peer->is_open) {
    // Unread input would turn the close into a reset, which may overtake the last bytes that were
    // sent.
    ::shutdown(peer->file.number(), SHUT_WR);
    // Reads no more than the kernel could hold, so that a peer that sends without pause cannot keep
    // this loop running.
    int waiting = 0;
    ::ioctl(peer->file.number(), FIONREAD, &waiting);
    for (ssize_t size = 1; size > 0 && waiting > 0; waiting -= static_cast<int>(size))
      size = ::recv(peer->file.number(), read_buffer_.data(),
                    std::min(read_buffer_.size(), static_cast<std::size_t>(waiting)), MSG_DONTWAIT);
  }
  end(*peer, CloseReason::closed_by_us, "closed by us");
}

}  // namespace rink::rti
