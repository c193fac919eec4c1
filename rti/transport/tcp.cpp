// TCP connections on Asio's reactor: how they come about, wait and end.
#include <sys/resource.h>

#include <cerrno>

#include "rti/transport/kernel_counters.h"
#include "rti/transport/tcp_core.h"

namespace rink::rti {

namespace {

constexpr std::size_t handlers_per_poll = 4096;  ///< connections opened, closed or read in one poll

using asio::ip::tcp;

[[noreturn]] void fail(const asio::error_code& error, const std::string& what) {
  using Kind = TransportError::Kind;
  Kind kind = Kind::failed;
  if (error == asio::error::address_in_use) kind = Kind::in_use;
  else if (error == asio::error::access_denied) kind = Kind::no_permission;
  else if (error == asio::error::no_descriptors) kind = Kind::too_many_files;
  else if (error == asio::error::host_not_found || error == asio::error::no_data || error == asio::error::service_not_found ||
           error.value() == EADDRNOTAVAIL) kind = Kind::no_such_address;
  throw TransportError(kind, what + ": " + error.message());
}

/// "address:port", with brackets around IPv6.
std::string place(const std::string& address, std::uint16_t port) {
  return (address.find(':') == std::string::npos ? address : "[" + address + "]") + ":" + std::to_string(port);
}

}  // namespace

tcp::endpoint TcpTransport::Core::resolve(const std::string& address, std::uint16_t port) {
  asio::error_code error;
  tcp::resolver resolver(context_);
  const auto found = resolver.resolve(address, std::to_string(port), error);
  if (error) fail(error, "no such address " + place(address, port));
  return found.begin()->endpoint();
}

std::uint16_t TcpTransport::Core::listen(const std::string& address, std::uint16_t port) {
  const tcp::endpoint endpoint = resolve(address, port);
  auto acceptor = std::make_unique<tcp::acceptor>(context_);
  asio::error_code error;
  acceptor->open(endpoint.protocol(), error);
  if (!error) acceptor->set_option(tcp::acceptor::reuse_address(true), error);  // past connections in TIME_WAIT don't hold the port
  if (!error) acceptor->bind(endpoint, error);
  if (!error) acceptor->listen(4096, error);
  if (error) fail(error, "can't listen at " + place(address, port));
  acceptors_.push_back(std::move(acceptor));
  accept(*acceptors_.back());
  return acceptors_.back()->local_endpoint().port();
}

ConnectionId TcpTransport::Core::connect(const std::string& address, std::uint16_t port) {
  const tcp::endpoint endpoint = resolve(address, port);
  Peer& peer = add();
  peer.place = place(address, port);
  asio::error_code error;
  peer.socket.open(endpoint.protocol(), error);
  if (error) {
    peers_.back().reset();
    fail(error, "can't connect to " + place(address, port));
  }
  peer.socket.async_connect(endpoint, [this, id = peer.id](const asio::error_code& failure) {
    Peer* connected = find(id);
    if (connected == nullptr || connected->is_leaving) return;
    if (failure) return end(*connected, close_reason_of(failure), "can't connect to " + connected->place + ": " + failure.message());
    opened(*connected);
  });
  return peer.id;
}

TcpTransport::Core::Peer& TcpTransport::Core::add() {
  peers_.push_back(std::make_unique<Peer>(context_, static_cast<ConnectionId>(peers_.size())));
  last_counters_.emplace_back();
  return *peers_.back();
}

void TcpTransport::Core::accept(tcp::acceptor& acceptor) {
  acceptor.async_accept([this, &acceptor](const asio::error_code& error, tcp::socket socket) {
    if (!error) {
      Peer& peer = add();
      peer.socket = std::move(socket);
      opened(peer);
    } else if (error == asio::error::no_descriptors) {
      return accept_later(acceptor);
    }
    if (error != asio::error::operation_aborted) accept(acceptor);
  });
}

void TcpTransport::Core::accept_later(tcp::acceptor& acceptor) {
  // The waiting connection would wake us at once and for ever: raise the limit, or let somebody leave first.
  rlimit limit{};
  if (getrlimit(RLIMIT_NOFILE, &limit) == 0 && limit.rlim_cur < limit.rlim_max) {
    limit.rlim_cur = limit.rlim_max;
    setrlimit(RLIMIT_NOFILE, &limit);
  }
  auto pause = std::make_shared<asio::steady_timer>(context_, std::chrono::milliseconds(100));
  pause->async_wait([this, &acceptor, pause](const asio::error_code& error) {
    if (!error) accept(acceptor);
  });
}

void TcpTransport::Core::opened(Peer& peer) {
  asio::error_code ignored;
  peer.socket.set_option(tcp::no_delay(true), ignored);
  peer.socket.native_non_blocking(true, ignored);
  peer.is_open = true;
  ++reported_;
  const ConnectionId id = peer.id;
  listener_->on_open(id);
  if (Peer* still = find(id); still != nullptr && !still->is_leaving) await_bytes(*still);
}

void TcpTransport::Core::end(Peer& peer, CloseReason reason, const std::string& detail) {
  peer.counters = counters(peer.id);
  peer.counters.queued_bytes = 0;
  peer.is_leaving = true;
  asio::error_code ignored;
  if (reason == CloseReason::queue_full) peer.socket.set_option(asio::socket_base::linger(true, 0), ignored);  // its unread bytes leave the kernel too
  peer.socket.close(ignored);
  peer.queue = {};
  peer.queue_from = 0;
  closed_.push_back({peer.id, reason, detail});
}

void TcpTransport::Core::report_closed() {
  while (!closed_.empty()) {
    reporting_.swap(closed_);
    for (const Closed& each : reporting_) {
      last_counters_[each.connection] = peers_[each.connection]->counters;
      peers_[each.connection].reset();
      ++reported_;
      listener_->on_close(each.connection, each.reason, each.detail);
    }
    reporting_.clear();
  }
}

void TcpTransport::Core::poll(std::chrono::nanoseconds longest_wait, TransportListener& listener) {
  listener_ = &listener;
  before_ = reported_;
  context_.restart();
  take_what_came();
  if (reported_ == before_ && longest_wait.count() > 0) wait(longest_wait);
  listener_ = nullptr;
}

void TcpTransport::Core::wait(std::chrono::nanoseconds longest_wait) {
  // Asio waits in whole milliseconds unless a timer is set, which is the kernel's timerfd and exact. Setting one costs two system calls, so only
  // the last milliseconds are waited for that way; most waits end by an event before.
  using std::chrono::milliseconds;
  timer_.expires_after(longest_wait);
  const auto coarse = std::chrono::duration_cast<milliseconds>(longest_wait) - milliseconds(1);
  if (coarse.count() > 0) {
    context_.run_one_for(coarse);
    report_closed();
  }
  if (reported_ == before_) {
    is_timer_due_ = false;
    timer_.async_wait([this](const asio::error_code& error) { is_timer_due_ = !error; });
    while (reported_ == before_ && !is_timer_due_) {
      context_.run_one();
      report_closed();
    }
    timer_.cancel();
  }
  take_what_came();
}

void TcpTransport::Core::take_what_came() {
  // Asio's own poll() goes on while anything comes, so a peer that sends without pause would never let it return: a joined one at 250 MB/s cost a
  // server three ticks in four. What is left waits in the kernel, and the next poll begins with the peers that this one did not reach.
  const std::uint64_t before = bytes_taken_;
  for (std::size_t taken = 0; taken < handlers_per_poll && bytes_taken_ - before < settings_.bytes_per_poll; ++taken)
    if (context_.poll_one() == 0) break;
  report_closed();
}

TransportCounters TcpTransport::Core::counters(ConnectionId connection) const {
  const Peer* peer = find(connection);
  if (peer == nullptr) return connection < last_counters_.size() ? last_counters_[connection] : TransportCounters{};
  TransportCounters counters = peer->counters;
  if (peer->is_leaving) return counters;
  counters.queued_bytes = peer->queue.size() - peer->queue_from;
  if (!peer->is_open) return counters;
  // The socket is const here only because asking it changes nothing.
  if (const auto kernel = kernel_counters(const_cast<tcp::socket&>(peer->socket).native_handle())) {
    counters.kernel_bytes_sent = kernel->bytes_acknowledged;
    counters.kernel_bytes_received = kernel->bytes_received;
  }
  return counters;
}

TcpTransport::TcpTransport(const TcpSettings& settings) : core_(std::make_unique<Core>(settings)) {}
TcpTransport::~TcpTransport() = default;
std::uint16_t TcpTransport::listen(const std::string& address, std::uint16_t port) { return core_->listen(address, port); }
ConnectionId TcpTransport::connect(const std::string& address, std::uint16_t port) { return core_->connect(address, port); }
void TcpTransport::poll(std::chrono::nanoseconds longest_wait, TransportListener& listener) { core_->poll(longest_wait, listener); }
void TcpTransport::send(ConnectionId connection, std::span<const Bytes> parts) { core_->send(connection, parts); }
void TcpTransport::close(ConnectionId connection) { core_->close(connection); }
TransportCounters TcpTransport::Core::totals() const {
  TransportCounters sum{.kernel_bytes_sent = 0, .kernel_bytes_received = 0};
  for (ConnectionId connection = 0; connection < last_counters_.size(); ++connection) {
    const TransportCounters one = counters(connection);
    sum.bytes_sent += one.bytes_sent;
    sum.bytes_received += one.bytes_received;
    sum.writes += one.writes;
    sum.segments_sent += one.segments_sent;
    sum.queued_bytes += one.queued_bytes;
    *sum.kernel_bytes_sent += one.kernel_bytes_sent.value_or(one.bytes_sent);
    *sum.kernel_bytes_received += one.kernel_bytes_received.value_or(one.bytes_received);
  }
  return sum;
}

TransportCounters TcpTransport::counters(ConnectionId connection) const { return core_->counters(connection); }
TransportCounters TcpTransport::totals() const { return core_->totals(); }

}  // namespace rink::rti
