// Opens, polls and closes TCP connections.
#include "rti/transport/tcp/tcp.h"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/timerfd.h>
#include <unistd.h>

#include <algorithm>
#include <asio.hpp>
#include <cassert>
#include <cerrno>
#include <iterator>

#include "rti/transport/tcp/kernel_counters.h"

namespace rink::rti {

namespace {

constexpr std::size_t events_per_poll =
    4096;  ///< connections opened, closed or read in one poll, more where many are accepted
/// Whoever waits to be accepted hears nothing: thousands who connect at once wait few polls.
constexpr std::size_t accepted_per_event = 512;
/// Limit of a peer's unsent bytes in the kernel [bytes]. Its own limit grows to megabytes for a
/// peer that does not read, where newer state can no longer replace them.
constexpr int unsent_max = 64 * 1024;
constexpr std::uint64_t pause_mark = ~0ull;
constexpr std::size_t counters_kept = 1024;  ///< of closed connections

void add_to(TransportCounters& sum, const TransportCounters& one) {
  sum.bytes_sent += one.bytes_sent;
  sum.bytes_received += one.bytes_received;
  sum.writes += one.writes;
  sum.segments_sent += one.segments_sent;
  sum.acknowledgements_sent += one.acknowledgements_sent;
  sum.queued_bytes += one.queued_bytes;
  *sum.kernel_bytes_sent += one.kernel_bytes_sent.value_or(one.bytes_sent);
  *sum.kernel_bytes_received += one.kernel_bytes_received.value_or(one.bytes_received);
  *sum.kernel_segments_sent += one.kernel_segments_sent.value_or(one.segments_sent);
}

asio::error_code last_error() { return {errno, asio::system_category()}; }

using asio::ip::tcp;

[[noreturn]] void fail(const asio::error_code& error, const std::string& what) {
  using Kind = TransportError::Kind;
  Kind kind = Kind::failed;
  if (error == asio::error::address_in_use) kind = Kind::in_use;
  else if (error == asio::error::access_denied) kind = Kind::no_permission;
  else if (error == asio::error::no_descriptors) kind = Kind::too_many_files;
  else if (error == asio::error::host_not_found || error == asio::error::no_data ||
           error == asio::error::service_not_found || error.value() == EADDRNOTAVAIL)
    kind = Kind::no_such_address;
  throw TransportError(kind, what + ": " + error.message());
}

/// "address:port", with brackets around IPv6.
std::string place(const std::string& address, std::uint16_t port) {
  return (address.find(':') == std::string::npos ? address : "[" + address + "]") + ":" +
         std::to_string(port);
}

tcp::endpoint resolve(const std::string& address, std::uint16_t port) {
  asio::error_code error;
  asio::io_context context;
  tcp::resolver resolver(context);
  const auto found = resolver.resolve(address, std::to_string(port), error);
  if (error) fail(error, "no such address " + place(address, port));
  return found.begin()->endpoint();
}

/// As far as this process may. False if it is there.
bool raise_file_limit() {
  rlimit limit{};
  if (getrlimit(RLIMIT_NOFILE, &limit) != 0 || limit.rlim_cur >= limit.rlim_max) return false;
  limit.rlim_cur = limit.rlim_max;
  return setrlimit(RLIMIT_NOFILE, &limit) == 0;
}

}  // namespace

TcpTransport::TcpTransport(const TcpSettings& settings)
    : settings_(settings),
      pause_(timerfd_create(CLOCK_MONOTONIC, TFD_NONBLOCK | TFD_CLOEXEC)),
      read_buffer_(settings.read_buffer) {
  assert(settings_.read_buffer > 0 && settings_.bytes_per_poll > 0);
  readiness_.watch(pause_.number(), pause_mark, false);
}

std::uint16_t TcpTransport::listen(const std::string& address, std::uint16_t port) {
  const tcp::endpoint endpoint = resolve(address, port);
  asio::io_context context;
  tcp::acceptor acceptor(context);
  asio::error_code error;
  acceptor.open(endpoint.protocol(), error);
  if (!error)
    acceptor.set_option(tcp::acceptor::reuse_address(true),
                        error);  // past connections in TIME_WAIT don't hold the port
  if (!error) acceptor.bind(endpoint, error);
  if (!error) acceptor.listen(4096, error);
  if (!error) acceptor.native_non_blocking(true, error);
  if (error) fail(error, "can't listen at " + place(address, port));
  const std::uint16_t bound = acceptor.local_endpoint().port();
  listening_.emplace_back(acceptor.release());
  readiness_.watch(listening_.back().number(), listener_mark + listening_.size() - 1, false);
  return bound;
}

ConnectionId TcpTransport::connect(const std::string& address, std::uint16_t port) {
  const tcp::endpoint endpoint = resolve(address, port);
  File file(::socket(endpoint.protocol().family(), SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC,
                     IPPROTO_TCP));
  const asio::error_code no_socket = last_error();
  if (!file) fail(no_socket, "can't connect to " + place(address, port));
  Peer& peer = add(std::move(file));
  peer.place = place(address, port);
  int result = 0;
  do
    result =
        ::connect(peer.file.number(), endpoint.data(), static_cast<socklen_t>(endpoint.size()));
  while (result < 0 && errno == EINTR);
  const asio::error_code error = last_error();
  // The socket is watched only from here on: an unconnected one would be reported as ended.
  if (result < 0 && error.value() != EINPROGRESS && error.value() != EISCONN &&
      error.value() != EALREADY)
    end(peer, reason_of(error.value()), "can't connect to " + peer.place + ": " + error.message());
  else readiness_.watch(peer.file.number(), peer.id, true);
  return peer.id;
}

TcpTransport::Peer& TcpTransport::add(File file) {
  peers_.push_back(std::make_unique<Peer>(static_cast<ConnectionId>(peers_.size())));
  peers_.back()->file = std::move(file);
  return *peers_.back();
}

void TcpTransport::accept(std::size_t listening) {
  assert(listening < listening_.size());
  for (std::size_t accepted = 0; accepted < accepted_per_event; ++accepted) {
    File file(
        ::accept4(listening_[listening].number(), nullptr, nullptr, SOCK_NONBLOCK | SOCK_CLOEXEC));
    if (!file && (errno == EMFILE || errno == ENFILE)) {
      if (raise_file_limit() || listener_->on_shortage()) continue;
      return accept_later();
    }
    if (!file) return;  // none is left, or the peer gave up before the accept
    Peer& peer = add(std::move(file));
    readiness_.watch(peer.file.number(), peer.id, false);
    opened(peer);
  }
}

/// The waiting connection would wake every poll at once: pauses until another closes.
void TcpTransport::accept_later() {
  for (std::size_t i = 0; i < listening_.size(); ++i)
    readiness_.change(listening_[i].number(), listener_mark + i, false, false);
  const itimerspec pause{.it_interval = {}, .it_value = {.tv_sec = 0, .tv_nsec = 100'000'000}};
  timerfd_settime(pause_.number(), 0, &pause, nullptr);
}

void TcpTransport::accept_again() {
  std::uint64_t expirations = 0;
  if (::read(pause_.number(), &expirations, sizeof expirations) != sizeof expirations) return;
  for (std::size_t i = 0; i < listening_.size(); ++i)
    readiness_.change(listening_[i].number(), listener_mark + i, true, false);
}

void TcpTransport::finish_connecting(Peer& peer) {
  int failure = 0;
  socklen_t size = sizeof failure;
  ::getsockopt(peer.file.number(), SOL_SOCKET, SO_ERROR, &failure, &size);
  const asio::error_code error(failure, asio::system_category());
  if (error)
    return end(peer, reason_of(error.value()),
               "can't connect to " + peer.place + ": " + error.message());
  readiness_.change(peer.file.number(), peer.id, true, false);
  opened(peer);
}

void TcpTransport::opened(Peer& peer) {
  assert(!peer.is_open && !peer.is_leaving);
  const int yes = 1;
  ::setsockopt(peer.file.number(), IPPROTO_TCP, TCP_NODELAY, &yes, sizeof yes);
  ::setsockopt(peer.file.number(), IPPROTO_TCP, TCP_NOTSENT_LOWAT, &unsent_max, sizeof unsent_max);
  peer.is_open = true;
  ++open_count_;
  newest_open_ = peer.id;
  const ConnectionId id = peer.id;
  if (!peer.queue.empty()) await_room(peer), drain(peer);  // sent before it was open
  listener_->on_open(id);
}

void TcpTransport::end(Peer& peer, CloseReason reason, const std::string& detail) {
  assert(!peer.is_leaving);  // it is reported once
  assert(!peer.is_open || open_count_ > 0);
  peer.counters = counters(peer.id);
  peer.counters.queued_bytes = 0;
  if (peer.is_open) --open_count_;
  peer.is_leaving = true;
  const linger at_once{.l_onoff = 1, .l_linger = 0};
  if (reason == CloseReason::queue_full)
    ::setsockopt(peer.file.number(), SOL_SOCKET, SO_LINGER, &at_once,
                 sizeof at_once);  // its unread bytes leave the kernel too
  peer.file.close();
  peer.queue = {};
  peer.queue_from = 0;
  ended_.add({peer.id, reason, detail});
}

void TcpTransport::report_closed() {
  while (!ended_.is_empty()) {
    ended_.report_all([this](const Closed& each) {
      assert(find(each.connection) != nullptr);
      add_to(closed_, peers_[each.connection]->counters);
      last_counters_.emplace_back(each.connection, peers_[each.connection]->counters);
      if (last_counters_.size() > counters_kept) last_counters_.pop_front();
      peers_[each.connection].reset();
      listener_->on_close(each.connection, each.reason, each.detail);
    });
  }
}

void TcpTransport::poll(std::chrono::nanoseconds longest_wait, TransportListener& listener) {
  listener_ = &listener;
  is_behind_ = false;
  if (read_only_peer(longest_wait)) {
    report_closed();
    listener_ = nullptr;
    return;
  }
  // The kernel is asked once per poll, since each system call here is one more in every round trip.
  // Events that come meanwhile are the next poll's.
  readiness_.ask(ended_.is_empty() ? longest_wait : std::chrono::nanoseconds(0), settings_.spin);
  receive_pending();
  listener_ = nullptr;
}

/// A poll that spins with one connection reads that without asking which files are ready: one
/// system call less in every round trip. True if the poll is done.
bool TcpTransport::read_only_peer(std::chrono::nanoseconds longest_wait) {
  using Clock = std::chrono::steady_clock;
  constexpr std::uint32_t reads_per_look = 32;  // so that new connections are accepted
  const auto spin = std::min(settings_.spin, longest_wait);
  if (open_count_ != 1 || !ended_.is_empty() || readiness_.has_left() ||
      (longest_wait.count() > 0 && spin.count() <= 0))
    return false;
  Peer* peer = find(newest_open_);
  if (peer == nullptr || !peer->is_open || peer->is_leaving || peer->is_writing) return false;
  const std::uint64_t before = bytes_taken_;
  const Clock::time_point until = spin.count() > 0 ? Clock::now() + spin : Clock::time_point();
  do {
    if (++reads_ % reads_per_look == 0) return false;
    read(*peer);
    if (bytes_taken_ != before || peer->is_leaving) return true;
  } while (spin.count() > 0 && Clock::now() < until);
  return longest_wait.count() <= 0;
}

void TcpTransport::receive_pending() {
  // A peer that sends without pause must not keep a poll from returning: a joined one at 250 MB/s
  // cost a server three ticks in four. What is left waits in the kernel, and the next poll begins
  // with the peers that this one did not reach.
  const std::uint64_t before = bytes_taken_;
  is_behind_ = true;
  for (std::size_t taken = 0;
       taken < events_per_poll && bytes_taken_ - before < settings_.bytes_per_poll; ++taken) {
    const auto event = readiness_.next();
    is_behind_ = event.has_value();
    if (!event) break;
    take(*event);
  }
  report_closed();
}

void TcpTransport::take(const Readiness::Event& event) {
  if (event.number == pause_mark) return accept_again();
  if (event.number >= listener_mark)
    return accept(static_cast<std::size_t>(event.number - listener_mark));
  const auto id = static_cast<ConnectionId>(event.number);
  Peer* peer = find(id);
  if (peer == nullptr || peer->is_leaving) return;
  if (!peer->is_open) return finish_connecting(*peer);
  if (event.is_writable && peer->is_writing) drain(*peer);
  if (event.is_readable && !peer->is_leaving) read(*peer);
}

TransportCounters TcpTransport::counters(ConnectionId connection) const {
  const Peer* peer = find(connection);
  if (peer == nullptr) {
    const auto last = std::ranges::find(last_counters_, connection,
                                        &std::pair<ConnectionId, TransportCounters>::first);
    return last != last_counters_.end() ? last->second : TransportCounters{};
  }
  TransportCounters counters = peer->counters;
  if (peer->is_leaving) return counters;
  counters.queued_bytes = peer->queue.size() - peer->queue_from;
  if (!peer->is_open) return counters;
  if (const auto kernel = kernel_counters(peer->file.number())) {
    counters.kernel_bytes_sent = kernel->bytes_acknowledged;
    counters.kernel_bytes_received = kernel->bytes_received;
    counters.kernel_segments_sent = kernel->data_segments_sent;
    counters.acknowledgements_sent =
        kernel->segments_sent - std::min(kernel->segments_sent, kernel->data_segments_sent);
  }
  return counters;
}

TransportCounters TcpTransport::totals() const {
  TransportCounters sum = closed_;
  for (const auto& peer : peers_)
    if (peer) add_to(sum, counters(peer->id));
  return sum;
}

int TcpTransport::file(ConnectionId connection) const {
  const Peer* peer = find(connection);
  return peer != nullptr && peer->is_open && !peer->is_leaving ? peer->file.number() : -1;
}

std::string TcpTransport::peer_network(ConnectionId connection) const {
  sockaddr_in6 peer{};  // the larger one
  socklen_t size = sizeof peer;
  if (::getpeername(file(connection), reinterpret_cast<sockaddr*>(&peer), &size) != 0) return {};
  char text[INET6_ADDRSTRLEN] = {};
  if (peer.sin6_family == AF_INET) {
    const auto& plain = reinterpret_cast<const sockaddr_in&>(peer);
    return ::inet_ntop(AF_INET, &plain.sin_addr, text, sizeof text);
  }
  if (peer.sin6_family != AF_INET6) return {};
  if (IN6_IS_ADDR_V4MAPPED(&peer.sin6_addr))
    return ::inet_ntop(AF_INET, peer.sin6_addr.s6_addr + 12, text, sizeof text);
  constexpr std::size_t prefix = 8;
  std::fill(peer.sin6_addr.s6_addr + prefix, std::end(peer.sin6_addr.s6_addr), std::uint8_t{0});
  return std::string(::inet_ntop(AF_INET6, &peer.sin6_addr, text, sizeof text)) + "/64";
}

}  // namespace rink::rti
