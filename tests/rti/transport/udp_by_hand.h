// What speaks UDP beside TCP by hand: sockets of somebody's own, and control datagrams byte by
// byte.
#pragma once

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <unistd.h>

#include <chrono>
#include <cstring>
#include <vector>

#include "rti/transport/readiness.h"
#include "rti/transport/udp/udp.h"
#include "tests/rti/rig.h"

namespace rink::rti::testing {

struct DatagramEar final : TransportListener {
  std::vector<ConnectionId> open;
  std::vector<std::vector<std::byte>> datagrams;
  std::vector<std::byte> stream;
  int closed = 0;
  void on_open(ConnectionId connection) override { open.push_back(connection); }
  void on_bytes(ConnectionId, Bytes bytes) override {
    stream.insert(stream.end(), bytes.begin(), bytes.end());
  }
  void on_close(ConnectionId, CloseReason, const std::string&) override { ++closed; }
  void on_datagram(ConnectionId, Bytes datagram) override {
    datagrams.emplace_back(datagram.begin(), datagram.end());
  }
};

template <class Condition>
bool pump(UdpTransport& server, DatagramEar& here, Transport& client, DatagramEar& there,
          Condition is_done) {
  for (const auto start = std::chrono::steady_clock::now(); !is_done();) {
    if (std::chrono::steady_clock::now() - start > std::chrono::seconds(10)) return false;
    server.poll(std::chrono::microseconds(200), here);
    client.poll(std::chrono::microseconds(200), there);
  }
  return true;
}

/// A UDP socket of somebody's own.
struct RawSocket {
  explicit RawSocket(const char* address) : file(::socket(AF_INET, SOCK_DGRAM, 0)) {
    sockaddr_in from = place(address, 0);
    EXPECT_EQ(::bind(file.number(), reinterpret_cast<sockaddr*>(&from), sizeof from), 0);
  }
  static sockaddr_in place(const char* address, std::uint16_t port) {
    sockaddr_in to{};
    to.sin_family = AF_INET;
    to.sin_port = htons(port);
    inet_pton(AF_INET, address, &to.sin_addr);
    return to;
  }
  void send(std::uint16_t port, Bytes bytes) {
    const sockaddr_in to = place("127.0.0.1", port);
    ::sendto(file.number(), bytes.data(), bytes.size(), 0, reinterpret_cast<const sockaddr*>(&to),
             sizeof to);
  }
  std::vector<std::byte> receive() {
    std::vector<std::byte> bytes(2000);
    const ssize_t size = ::recv(file.number(), bytes.data(), bytes.size(), MSG_DONTWAIT);
    bytes.resize(size < 0 ? 0 : static_cast<std::size_t>(size));
    return bytes;
  }
  File file;
};

inline std::vector<std::byte> control(std::uint64_t key, std::uint8_t kind, std::uint64_t nonce,
                                      std::size_t size) {
  std::vector<std::byte> bytes = values_of(key, kind, nonce);
  bytes.resize(size);
  return bytes;
}

}  // namespace rink::rti::testing
