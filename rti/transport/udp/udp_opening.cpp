// How a way for datagrams opens beside a TCP connection: greeting, questions and answers.
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

/// What a server says first of all to a client that asks for datagrams.
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

/// Takes what is ours of the stream's beginning and returns the rest. What turns out to be nobody's
/// greeting is forwarded.
Bytes UdpTransport::take_head(ConnectionId connection, Bytes bytes) {
  Way& way = *find(connection);
  const std::size_t wanted = way.role == Way::Role::client ? greeting_size : magic_size;
  assert(way.head_size < wanted);
  const std::size_t taken = std::min(bytes.size(), wanted - way.head_size);
  std::copy_n(bytes.begin(), taken, way.head.begin() + static_cast<std::ptrdiff_t>(way.head_size));
  way.head_size += taken;
  bytes = bytes.subspan(taken);
  const std::size_t comparable = std::min(way.head_size, magic_size);
  if (std::memcmp(way.head.data(), &datagram_magic, comparable) != 0) {
    const std::array<std::byte, greeting_size> head = way.head;
    const std::size_t size = way.head_size;
    way.role = Way::Role::none;
    let_go(connection, way);
    forward(connection, Bytes(head).first(size));
    return find(connection) == nullptr ? Bytes() : bytes;
  }
  if (way.head_size < wanted) return {};
  tallies_[connection].stream_received = wanted;
  way.role == Way::Role::client ? open_socket(connection, way) : greet(connection, way);
  return bytes;
}

void UdpTransport::greet(ConnectionId connection, Way& way) {
  way.role = Way::Role::server;
  way.address = peer_of(tcp_.file(connection));
  way.up_key = secret();
  way.down_key = secret();
  way.nonce = secret();
  by_key_[way.up_key] = connection;
  std::vector<std::byte> greeting;
  Writer writer(greeting);
  DatagramGreeting said{datagram_magic, server_port_, way.up_key, way.down_key};
  exchange(writer, said);
  assert(greeting.size() == greeting_size);
  const Bytes bytes = greeting;
  tallies_[connection].stream_sent = greeting_size;
  tcp_.send(connection, std::span(&bytes, 1));
  let_go(connection, way);
}

void UdpTransport::open_socket(ConnectionId connection, Way& way) {
  assert(way.role == Way::Role::client && way.state == Way::State::closed);
  DatagramGreeting greeting;
  Reader reader(way.head);
  exchange(reader, greeting);
  way.up_key = greeting.up_key;
  way.down_key = greeting.down_key;
  way.address = peer_of(tcp_.file(connection));
  way.address.set_port(greeting.port);
  way.file =
      File(::socket(way.address.storage.ss_family, SOCK_DGRAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0));
  // Connected, it hears of nobody but the server.
  if (!way.file || ::connect(way.file.number(), way.address.get(), way.address.size) != 0) {
    ++counters_.ways_failed;
    return;
  }
  prepare_datagram_socket(way.file.number(), settings_.use_offload);
  readiness_.watch(way.file.number(), connection, false);
  way.state = Way::State::hello;
  if (asking_.empty()) set_timer();
  asking_.push_back(connection);
  ask(way);
}

void UdpTransport::set_timer() {
  const itimerspec tenth{.it_interval = {}, .it_value = {.tv_sec = 0, .tv_nsec = 100'000'000}};
  timerfd_settime(timer_.number(), 0, &tenth, nullptr);
}

/// A client's question that has not been answered yet.
void UdpTransport::ask(const Way& way) {
  if (way.state == Way::State::hello) tell(way, Kind::hello, way.up_key, 0, payload_max);
  else tell(way, Kind::confirm, way.up_key, way.nonce, prefix_size + 8);
}

void UdpTransport::ask_again() {
  std::uint64_t expirations = 0;
  if (::read(timer_.number(), &expirations, sizeof expirations) != sizeof expirations) return;
  std::erase_if(asking_, [this](ConnectionId connection) {
    Way* way = find(connection);
    if (way == nullptr || way->state == Way::State::open || way->state == Way::State::closed)
      return true;
    if (++way->tries < tries_max) return ask(*way), false;
    way->state = Way::State::closed;
    ++counters_.ways_failed;
    return true;
  });
  if (!asking_.empty()) set_timer();
}

void UdpTransport::tell(const Way& way, Kind kind, std::uint64_t key, std::uint64_t nonce,
                        std::size_t size) {
  assert(prefix_size <= size && size <= payload_max);
  std::vector<std::byte> bytes;
  bytes.reserve(payload_max);
  Writer writer(bytes);
  writer.number(key);
  writer.number(kind);
  writer.number(nonce);
  bytes.resize(size);
  const Datagram whole{bytes, {}};
  const bool is_client = way.role == Way::Role::client;
  sender_.add(is_client ? way.file.number() : server_.number(), is_client ? nullptr : &way.address,
              {}, std::span(&whole, 1));
  sender_.push();
}

}  // namespace rink::rti
