// Opens a channel for datagrams beside a TCP connection: greeting, questions and answers.
#include <sys/random.h>
#include <sys/socket.h>
#include <sys/timerfd.h>
#include <unistd.h>

#include <algorithm>
#include <cassert>
#include <cstring>
#include <vector>

#include "rti/transport/udp/udp.h"
#include "rti/wire/stream.h"

namespace rink::rti {

namespace {

constexpr int tries_max = 30;  ///< ten a second

/// The first message of a server to a client that asks for datagrams.
struct DatagramGreeting {
  std::uint32_t magic = 0;
  std::uint16_t port = 0;
  std::uint64_t up_key = 0, down_key = 0;
};
template <class Stream>
bool exchange(Stream& stream, DatagramGreeting& greeting) {
  return stream.number(greeting.magic) && stream.number(greeting.port) &&
         stream.number(greeting.up_key) && stream.number(greeting.down_key);
}

std::uint64_t secret() {
  std::uint64_t key = 0;
  while (key == 0)
    if (::getrandom(&key, sizeof key, 0) != sizeof key) key = 0;
  return key;
}

SocketAddress peer_of(int socket) {
  SocketAddress address;
  address.size = sizeof address.storage;
  if (::getpeername(socket, reinterpret_cast<sockaddr*>(&address.storage), &address.size) != 0)
    address.size = 0;
  return address;
}

}  // namespace

/// Takes the request or greeting from the stream's beginning and returns the rest. Bytes that turn
/// out to be neither are forwarded.
Bytes UdpTransport::read_head(ConnectionId connection, Bytes bytes) {
  Channel& channel = *find(connection);
  const std::size_t wanted = channel.role == Channel::Role::client ? greeting_size : magic_size;
  assert(channel.head_size < wanted);
  const std::size_t taken = std::min(bytes.size(), wanted - channel.head_size);
  std::copy_n(bytes.begin(), taken,
              channel.head.begin() + static_cast<std::ptrdiff_t>(channel.head_size));
  channel.head_size += taken;
  bytes = bytes.subspan(taken);
  const std::size_t comparable = std::min(channel.head_size, magic_size);
  if (std::memcmp(channel.head.data(), &datagram_magic, comparable) != 0) {
    const std::array<std::byte, greeting_size> head = channel.head;
    const std::size_t size = channel.head_size;
    channel.role = Channel::Role::none;
    let_go(connection, channel);
    forward(connection, Bytes(head).first(size));
    return find(connection) == nullptr ? Bytes() : bytes;
  }
  if (channel.head_size < wanted) return {};
  tallies_[connection].stream_received = wanted;
  channel.role == Channel::Role::client ? open_socket(connection, channel)
                                        : greet(connection, channel);
  return bytes;
}

void UdpTransport::greet(ConnectionId connection, Channel& channel) {
  channel.role = Channel::Role::server;
  channel.address = peer_of(tcp_.file(connection));
  channel.up_key = secret();
  channel.down_key = secret();
  channel.nonce = secret();
  by_key_[channel.up_key] = connection;
  std::vector<std::byte> greeting;
  Writer writer(greeting);
  DatagramGreeting message{datagram_magic, server_port_, channel.up_key, channel.down_key};
  exchange(writer, message);
  assert(greeting.size() == greeting_size);
  const Bytes bytes = greeting;
  tallies_[connection].stream_sent = greeting_size;
  tcp_.send(connection, std::span(&bytes, 1));
  let_go(connection, channel);
}

void UdpTransport::open_socket(ConnectionId connection, Channel& channel) {
  assert(channel.role == Channel::Role::client && channel.state == Channel::State::closed);
  DatagramGreeting greeting;
  Reader reader(channel.head);
  exchange(reader, greeting);
  channel.up_key = greeting.up_key;
  channel.down_key = greeting.down_key;
  channel.address = peer_of(tcp_.file(connection));
  channel.address.set_port(greeting.port);
  channel.file = File(
      ::socket(channel.address.storage.ss_family, SOCK_DGRAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0));
  // A connected socket receives from the server alone.
  if (!channel.file ||
      ::connect(channel.file.number(), channel.address.get(), channel.address.size) != 0) {
    ++counters_.ways_failed;
    return;
  }
  prepare_datagram_socket(channel.file.number(), settings_.use_offload);
  readiness_.watch(channel.file.number(), connection, false);
  channel.state = Channel::State::hello;
  if (asking_.empty()) set_timer();
  asking_.push_back(connection);
  ask(channel);
}

void UdpTransport::set_timer() {
  const itimerspec tenth{.it_interval = {}, .it_value = {.tv_sec = 0, .tv_nsec = 100'000'000}};
  timerfd_settime(timer_.number(), 0, &tenth, nullptr);
}

/// A client's question that has not been answered yet.
void UdpTransport::ask(const Channel& channel) {
  if (channel.state == Channel::State::hello)
    send_control(channel, Kind::hello, channel.up_key, 0, payload_max);
  else send_control(channel, Kind::confirm, channel.up_key, channel.nonce, prefix_size + 8);
}

void UdpTransport::ask_again() {
  std::uint64_t expirations = 0;
  if (::read(timer_.number(), &expirations, sizeof expirations) != sizeof expirations) return;
  std::erase_if(asking_, [this](ConnectionId connection) {
    Channel* channel = find(connection);
    if (channel == nullptr || channel->state == Channel::State::open ||
        channel->state == Channel::State::closed)
      return true;
    if (++channel->tries < tries_max) return ask(*channel), false;
    channel->state = Channel::State::closed;
    ++counters_.ways_failed;
    return true;
  });
  if (!asking_.empty()) set_timer();
}

void UdpTransport::send_control(const Channel& channel, Kind kind, std::uint64_t key,
                                std::uint64_t nonce, std::size_t size) {
  assert(prefix_size <= size && size <= payload_max);
  std::vector<std::byte> bytes;
  bytes.reserve(payload_max);
  Writer writer(bytes);
  writer.number(key);
  writer.number(kind);
  writer.number(nonce);
  bytes.resize(size);
  const Datagram whole{bytes, {}};
  const bool is_client = channel.role == Channel::Role::client;
  sender_.add(is_client ? channel.file.number() : server_.number(),
              is_client ? nullptr : &channel.address, {}, std::span(&whole, 1));
  sender_.push();
}

}  // namespace rink::rti
