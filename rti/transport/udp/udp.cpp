// TCP connections with ways for datagrams beside them, and what goes over both.
#include "rti/transport/udp/udp.h"

#include <poll.h>
#include <sys/timerfd.h>

#include <asio.hpp>
#include <cassert>
#include <cstring>
#include <ctime>

#include "rti/wire/stream.h"

namespace rink::rti {

namespace {

constexpr std::uint64_t server_mark = 1ull << 32, timer_mark = server_mark + 1;
constexpr std::size_t datagram_events_per_poll = 1024;

}  // namespace

UdpTransport::UdpTransport(const UdpSettings& settings)
    : settings_(settings),
      tcp_(settings.tcp),
      timer_(timerfd_create(CLOCK_MONOTONIC, TFD_NONBLOCK | TFD_CLOEXEC)),
      sender_(settings.use_offload) {
  readiness_.watch(timer_.number(), timer_mark, false);
}

std::uint16_t UdpTransport::listen(const std::string& address, std::uint16_t port) {
  const std::uint16_t bound = tcp_.listen(address, port);
  if (server_) return bound;
  asio::io_context context;
  asio::error_code error;
  const auto found =
      asio::ip::udp::resolver(context).resolve(address, std::to_string(bound), error);
  if (error)
    throw TransportError(TransportError::Kind::no_such_address,
                         "no such address " + address + ": " + error.message());
  asio::ip::udp::endpoint endpoint = found.begin()->endpoint();
  asio::ip::udp::socket socket(context, endpoint.protocol());
  socket.bind(endpoint, error);
  if (error) {  // the port's number is told to clients, so any will do
    endpoint.port(0);
    socket.bind(endpoint, error);
  }
  if (error)
    throw TransportError(TransportError::Kind::failed,
                         "no UDP at " + address + ": " + error.message());
  server_port_ = socket.local_endpoint().port();
  server_ = File(socket.release());
  prepare_datagram_socket(server_.number(), settings_.use_offload);
  readiness_.watch(server_.number(), server_mark, false);
  return bound;
}

ConnectionId UdpTransport::connect(const std::string& address, std::uint16_t port) {
  const ConnectionId connection = tcp_.connect(address, port);
  add(connection).role = Way::Role::client;
  tallies_[connection].stream_sent = magic_size;
  const Bytes request = std::as_bytes(std::span(&datagram_magic, 1));
  tcp_.send(connection, std::span(&request, 1));
  return connection;
}

UdpTransport::Way& UdpTransport::add(ConnectionId connection) {
  if (connection >= ways_.size()) {
    ways_.resize(connection + 1);
    tallies_.resize(connection + 1);
  }
  assert(ways_[connection] == nullptr);  // connections are never numbered twice
  ways_[connection] = std::make_unique<Way>();
  return *ways_[connection];
}

void UdpTransport::on_open(ConnectionId connection) {
  has_told_ = true;
  if (find(connection) == nullptr) add(connection);
  listener_->on_open(connection);
}

void UdpTransport::on_close(ConnectionId connection, CloseReason reason,
                            const std::string& detail) {
  has_told_ = true;
  push();  // what waits names the address that goes now
  const Way* way = find(connection);
  const bool was_unanswered = way != nullptr && way->role == Way::Role::client &&
                              way->head_size == 0 && reason == CloseReason::closed_by_peer;
  if (way != nullptr) by_key_.erase(way->up_key);
  if (connection < ways_.size()) ways_[connection].reset();
  // A server without UDP takes the request for nonsense, and that is all that can be seen of it
  // from here.
  listener_->on_close(connection, reason,
                      was_unanswered ? detail +
                                           " without an answer to the request for datagrams: does "
                                           "the server use another transport than udp?"
                                     : detail);
}

void UdpTransport::on_bytes(ConnectionId connection, Bytes bytes) {
  const Way* way = find(connection);
  const bool is_at_head =
      way != nullptr && (way->role == Way::Role::undecided ||
                         (way->role == Way::Role::client && way->head_size < greeting_size));
  if (is_at_head) bytes = take_head(connection, bytes);
  if (!bytes.empty()) forward(connection, bytes);
}

void UdpTransport::forward(ConnectionId connection, Bytes bytes) {
  has_told_ = true;
  listener_->on_bytes(connection, bytes);
}

/// The greeting comes first of all, and whether there is one is known when the client has spoken.
void UdpTransport::send(ConnectionId connection, std::span<const Bytes> parts) {
  Way* way = find(connection);
  if (way == nullptr || way->role != Way::Role::undecided) return tcp_.send(connection, parts);
  std::vector<std::byte>& held = way->held.emplace_back();
  for (const Bytes part : parts) held.insert(held.end(), part.begin(), part.end());
  way->held_bytes += held.size();
  if (way->held_bytes <= settings_.tcp.queue_max) return;
  way->role = Way::Role::none;  // it has never spoken: what becomes of it is up to its own reading
  let_go(connection, *way);
}

void UdpTransport::let_go(ConnectionId connection, Way& way) {
  for (const std::vector<std::byte>& each : way.held) {
    const Bytes bytes = each;
    tcp_.send(connection, std::span(&bytes, 1));
  }
  way.held = {};
  way.held_bytes = 0;
}

void UdpTransport::close(ConnectionId connection) {
  if (Way* way = find(connection)) let_go(connection, *way);
  tcp_.close(connection);
}

void UdpTransport::poll(std::chrono::nanoseconds longest_wait, TransportListener& listener) {
  push();
  listener_ = &listener;
  has_told_ = false;
  take_what_came();
  if (!has_told_ && longest_wait.count() > 0) {
    const auto seconds = std::chrono::floor<std::chrono::seconds>(longest_wait);
    const timespec timeout{.tv_sec = static_cast<std::time_t>(seconds.count()),
                           .tv_nsec = static_cast<long>((longest_wait - seconds).count())};
    std::array<pollfd, 2> both{pollfd{.fd = tcp_.wait_file(), .events = POLLIN, .revents = 0},
                               pollfd{.fd = readiness_.file(), .events = POLLIN, .revents = 0}};
    ::ppoll(both.data(), both.size(), &timeout, nullptr);
    take_what_came();
  }
  listener_ = nullptr;
}

/// The stream first: datagrams speak of objects that it tells of.
void UdpTransport::take_what_came() {
  tcp_.poll({}, *this);
  readiness_.ask({}, {});
  for (std::size_t taken = 0; taken < datagram_events_per_poll; ++taken) {
    const auto event = readiness_.next();
    if (!event) return;
    if (event->number == timer_mark) {
      ask_again();
    } else if (event->number == server_mark) {
      constexpr int batches_max =
          256;  // then the next poll goes on: who sends without pause must not keep us
      for (int batch = 0; batch < batches_max; ++batch)
        if (!reader_.read(server_.number(), [this](const SocketAddress& source, Bytes datagram) {
              take_from_client(source, datagram);
            }))
          break;
    } else if (const auto connection = static_cast<ConnectionId>(event->number);
               Way* way = find(connection)) {
      reader_.read(way->file.number(), [&](const SocketAddress&, Bytes datagram) {
        if (Way* still = find(connection)) take_from_server(connection, *still, datagram);
      });
    }
  }
}

void UdpTransport::take_from_client(const SocketAddress& source, Bytes datagram) {
  Reader reader(datagram);
  std::uint64_t key = 0, nonce = 0;
  Kind kind{};
  const bool is_ours = reader.number(key) && reader.number(kind);
  const auto known = is_ours ? by_key_.find(key) : by_key_.end();
  Way* way = known == by_key_.end() ? nullptr : find(known->second);
  // Who knows the key but comes from elsewhere than the TCP connection would have us flood a
  // stranger.
  if (way == nullptr || !way->address.is_same_host(source)) {
    ++counters_.stranger_datagrams;
    return;
  }
  const bool is_from_there = way->state != Way::State::closed && way->address.is_same(source);
  if (kind == Kind::hello && datagram.size() == payload_max && way->state != Way::State::open) {
    way->address = source;
    way->state = Way::State::hello;
    return tell(*way, Kind::welcome, way->down_key, way->nonce,
                payload_max);  // no longer than the question
  }
  const bool is_proven =
      datagram.size() == prefix_size + 8 && reader.number(nonce) && nonce == way->nonce;
  if (kind == Kind::confirm && is_from_there && is_proven) {
    counters_.ways_opened += way->state == Way::State::open ? 0u : 1u;
    way->state = Way::State::open;
    return tell(*way, Kind::open, way->down_key, 0, prefix_size);
  }
  if (kind == Kind::data && is_from_there && way->state == Way::State::open)
    return take_data(known->second, datagram);
  ++counters_.stranger_datagrams;
}

void UdpTransport::take_from_server(ConnectionId connection, Way& way, Bytes datagram) {
  Reader reader(datagram);
  std::uint64_t key = 0;
  Kind kind{};
  if (!reader.number(key) || !reader.number(kind) || key != way.down_key) {
    ++counters_.stranger_datagrams;
    return;
  }
  if (kind == Kind::welcome && datagram.size() == payload_max) {
    if (way.state != Way::State::hello) return;
    reader.number(way.nonce);
    way.state = Way::State::confirm;
    return ask(way);
  }
  if (kind != Kind::open && kind != Kind::data) {
    ++counters_.stranger_datagrams;
    return;
  }
  if (way.state != Way::State::open) ++counters_.ways_opened;
  way.state = Way::State::open;
  if (kind == Kind::data) take_data(connection, datagram);
}

void UdpTransport::take_data(ConnectionId connection, Bytes datagram) {
  const Bytes payload = datagram.subspan(prefix_size);
  ++tallies_[connection].datagrams_received;
  tallies_[connection].bytes_received += payload.size();
  has_told_ = true;
  listener_->on_datagram(connection, payload);
}

std::size_t UdpTransport::datagram_max(ConnectionId connection) const {
  const Way* way = find(connection);
  if (way == nullptr) return 0;
  // A client expects datagrams as soon as it has proven its address; those that it sends before it
  // knows that it has are lost.
  const bool is_open = way->state == Way::State::open ||
                       (way->role == Way::Role::client && way->state == Way::State::confirm);
  return is_open ? payload_max - prefix_size : 0;
}

void UdpTransport::send_datagrams(ConnectionId connection, std::span<const Datagram> datagrams) {
  if (datagram_max(connection) == 0) return;
  const Way& way = *find(connection);
  const bool is_client = way.role == Way::Role::client;
  const std::uint64_t key = is_client ? way.up_key : way.down_key;
  std::array<std::byte, prefix_size> prefix;
  std::memcpy(prefix.data(), &key, sizeof key);
  prefix[sizeof key] = static_cast<std::byte>(Kind::data);
  Tally& tally = tallies_[connection];
  tally.datagrams_sent += datagrams.size();
  for (const Datagram& each : datagrams) {
    assert(each.head.size() + each.body.size() <= payload_max - prefix_size);
    tally.bytes_sent += each.head.size() + each.body.size();
  }
  sender_.add(is_client ? way.file.number() : server_.number(), is_client ? nullptr : &way.address,
              prefix, datagrams);
}

}  // namespace rink::rti
