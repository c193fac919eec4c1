// TCP connections with channels for datagrams beside them, and traffic over both.
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
  if (error) {  // clients are sent the port's number, so any will do
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
  add(connection).role = Channel::Role::client;
  tallies_[connection].stream_sent = magic_size;
  const Bytes request = std::as_bytes(std::span(&datagram_magic, 1));
  tcp_.send(connection, std::span(&request, 1));
  return connection;
}

UdpTransport::Channel& UdpTransport::add(ConnectionId connection) {
  if (connection >= channels_.size()) {
    channels_.resize(connection + 1);
    tallies_.resize(connection + 1);
  }
  assert(channels_[connection] == nullptr);  // connections are never numbered twice
  channels_[connection] = std::make_unique<Channel>();
  return *channels_[connection];
}

void UdpTransport::on_open(ConnectionId connection) {
  has_received_ = true;
  if (find(connection) == nullptr) add(connection);
  listener_->on_open(connection);
}

void UdpTransport::on_close(ConnectionId connection, CloseReason reason,
                            const std::string& detail) {
  has_received_ = true;
  push();  // what waits names the address that goes now
  const Channel* channel = find(connection);
  const bool was_unanswered = channel != nullptr && channel->role == Channel::Role::client &&
                              channel->head_size == 0 && reason == CloseReason::closed_by_peer;
  if (channel != nullptr) by_key_.erase(channel->up_key);
  if (connection < channels_.size()) channels_[connection].reset();
  // A server without UDP rejects the request as malformed, which is all that a client sees.
  listener_->on_close(connection, reason,
                      was_unanswered ? detail +
                                           " without an answer to the request for datagrams: does "
                                           "the server use another transport than udp?"
                                     : detail);
}

void UdpTransport::on_bytes(ConnectionId connection, Bytes bytes) {
  const Channel* channel = find(connection);
  const bool is_at_head =
      channel != nullptr &&
      (channel->role == Channel::Role::undecided ||
       (channel->role == Channel::Role::client && channel->head_size < greeting_size));
  if (is_at_head) bytes = read_head(connection, bytes);
  if (!bytes.empty()) forward(connection, bytes);
}

void UdpTransport::forward(ConnectionId connection, Bytes bytes) {
  has_received_ = true;
  listener_->on_bytes(connection, bytes);
}

/// Holds the server's bytes back until the client has sent some, which show whether a greeting must
/// come first.
void UdpTransport::send(ConnectionId connection, std::span<const Bytes> parts) {
  Channel* channel = find(connection);
  if (channel == nullptr || channel->role != Channel::Role::undecided)
    return tcp_.send(connection, parts);
  std::vector<std::byte>& held = channel->held.emplace_back();
  for (const Bytes part : parts) held.insert(held.end(), part.begin(), part.end());
  channel->held_bytes += held.size();
  if (channel->held_bytes <= settings_.tcp.queue_max) return;
  channel->role = Channel::Role::none;  // it has sent nothing: its own reading decides
  let_go(connection, *channel);
}

void UdpTransport::let_go(ConnectionId connection, Channel& channel) {
  for (const std::vector<std::byte>& each : channel.held) {
    const Bytes bytes = each;
    tcp_.send(connection, std::span(&bytes, 1));
  }
  channel.held = {};
  channel.held_bytes = 0;
}

void UdpTransport::close(ConnectionId connection) {
  if (Channel* channel = find(connection)) let_go(connection, *channel);
  tcp_.close(connection);
}

void UdpTransport::poll(std::chrono::nanoseconds longest_wait, TransportListener& listener) {
  push();
  listener_ = &listener;
  has_received_ = false;
  receive_pending();
  if (!has_received_ && longest_wait.count() > 0) {
    const auto seconds = std::chrono::floor<std::chrono::seconds>(longest_wait);
    const timespec timeout{.tv_sec = static_cast<std::time_t>(seconds.count()),
                           .tv_nsec = static_cast<long>((longest_wait - seconds).count())};
    std::array<pollfd, 2> both{pollfd{.fd = tcp_.wait_file(), .events = POLLIN, .revents = 0},
                               pollfd{.fd = readiness_.file(), .events = POLLIN, .revents = 0}};
    ::ppoll(both.data(), both.size(), &timeout, nullptr);
    receive_pending();
  }
  listener_ = nullptr;
}

/// The stream comes first: datagrams name objects that it announces.
void UdpTransport::receive_pending() {
  tcp_.poll({}, *this);
  readiness_.ask({}, {});
  is_behind_ = true;
  for (std::size_t taken = 0; taken < datagram_events_per_poll; ++taken) {
    const auto event = readiness_.next();
    is_behind_ = event.has_value();
    if (!event) return;
    if (event->number == timer_mark) {
      ask_again();
    } else if (event->number == server_mark) {
      constexpr int batches_max =
          256;  // then the next poll continues: a peer that sends without pause must not block
      for (int batch = 0; batch < batches_max; ++batch)
        if (!reader_.read(server_.number(), [this](const SocketAddress& source, Bytes datagram) {
              handle_client_datagram(source, datagram);
            }))
          break;
    } else if (const auto connection = static_cast<ConnectionId>(event->number);
               Channel* channel = find(connection)) {
      reader_.read(channel->file.number(), [&](const SocketAddress&, Bytes datagram) {
        if (Channel* still = find(connection)) handle_server_datagram(connection, *still, datagram);
      });
    }
  }
}

void UdpTransport::handle_client_datagram(const SocketAddress& source, Bytes datagram) {
  Reader reader(datagram);
  std::uint64_t key = 0, nonce = 0;
  Kind kind{};
  const bool is_ours = reader.number(key) && reader.number(kind);
  const auto known = is_ours ? by_key_.find(key) : by_key_.end();
  Channel* channel = known == by_key_.end() ? nullptr : find(known->second);
  // A sender with the key but another address than the TCP connection's could make this end flood a
  // stranger.
  if (channel == nullptr || !channel->address.is_same_host(source)) {
    ++counters_.rejected_datagrams;
    return;
  }
  const bool is_from_there =
      channel->state != Channel::State::closed && channel->address.is_same(source);
  if (kind == Kind::hello && datagram.size() == payload_max &&
      channel->state != Channel::State::open) {
    channel->address = source;
    channel->state = Channel::State::hello;
    return send_control(*channel, Kind::welcome, channel->down_key, channel->nonce,
                        payload_max);  // no longer than the question
  }
  const bool is_proven =
      datagram.size() == prefix_size + 8 && reader.number(nonce) && nonce == channel->nonce;
  if (kind == Kind::confirm && is_from_there && is_proven) {
    counters_.ways_opened += channel->state == Channel::State::open ? 0u : 1u;
    channel->state = Channel::State::open;
    return send_control(*channel, Kind::open, channel->down_key, 0, prefix_size);
  }
  if (kind == Kind::data && is_from_there && channel->state == Channel::State::open)
    return handle_data(known->second, datagram);
  ++counters_.rejected_datagrams;
}

void UdpTransport::handle_server_datagram(ConnectionId connection, Channel& channel,
                                          Bytes datagram) {
  Reader reader(datagram);
  std::uint64_t key = 0;
  Kind kind{};
  if (!reader.number(key) || !reader.number(kind) || key != channel.down_key) {
    ++counters_.rejected_datagrams;
    return;
  }
  if (kind == Kind::welcome && datagram.size() == payload_max) {
    if (channel.state != Channel::State::hello) return;
    reader.number(channel.nonce);
    channel.state = Channel::State::confirm;
    return ask(channel);
  }
  if (kind != Kind::open && kind != Kind::data) {
    ++counters_.rejected_datagrams;
    return;
  }
  if (channel.state != Channel::State::open) ++counters_.ways_opened;
  channel.state = Channel::State::open;
  if (kind == Kind::data) handle_data(connection, datagram);
}

void UdpTransport::handle_data(ConnectionId connection, Bytes datagram) {
  const Bytes payload = datagram.subspan(prefix_size);
  ++tallies_[connection].datagrams_received;
  tallies_[connection].bytes_received += payload.size();
  has_received_ = true;
  listener_->on_datagram(connection, payload);
}

std::size_t UdpTransport::datagram_max(ConnectionId connection) const {
  const Channel* channel = find(connection);
  if (channel == nullptr) return 0;
  // A client expects datagrams as soon as it has proven its address; those that it sends before it
  // knows that it has are lost.
  const bool is_open =
      channel->state == Channel::State::open ||
      (channel->role == Channel::Role::client && channel->state == Channel::State::confirm);
  return is_open ? payload_max - prefix_size : 0;
}

void UdpTransport::send_datagrams(ConnectionId connection, std::span<const Datagram> datagrams) {
  if (datagram_max(connection) == 0) return;
  const Channel& channel = *find(connection);
  const bool is_client = channel.role == Channel::Role::client;
  const std::uint64_t key = is_client ? channel.up_key : channel.down_key;
  std::array<std::byte, prefix_size> prefix;
  std::memcpy(prefix.data(), &key, sizeof key);
  prefix[sizeof key] = static_cast<std::byte>(Kind::data);
  Tally& tally = tallies_[connection];
  tally.datagrams_sent += datagrams.size();
  for (const Datagram& each : datagrams) {
    assert(each.head.size() + each.body.size() <= payload_max - prefix_size);
    tally.bytes_sent += each.head.size() + each.body.size();
  }
  sender_.add(is_client ? channel.file.number() : server_.number(),
              is_client ? nullptr : &channel.address, prefix, datagrams);
}

}  // namespace rink::rti
