// A man in the middle of one connection of TCP and UDP: passes on and writes down all that is said,
// and loses the datagrams that he is told to.
#pragma once

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cstring>
#include <functional>
#include <string>
#include <vector>

#include "rti/transport/readiness.h"
#include "tests/rti/rig.h"

namespace rink::rti::testing {

/// Of one connection: the client connects to `port` instead of the server's.
class UdpRelay {
 public:
  /// Writes to `record` in the second reader's form. `is_lost(is_up, bytes)` is asked of each
  /// datagram.
  UdpRelay(std::uint16_t server_port, std::uint32_t number, std::string& record,
           std::function<bool(bool, Bytes)> is_lost)
      : server_port_(server_port), number_(number), record_(record), is_lost_(std::move(is_lost)) {
    for (const File* each : {&door_, &client_facing_, &server_facing_}) bind_to_loopback(*each);
    EXPECT_EQ(::listen(door_.number(), 1), 0);
  }
  std::uint16_t port() const { return port_of(door_); }

  /// Passes on what has come, without waiting.
  void pump() {
    if (!client_) accept();
    if (!client_) return;
    carry_stream(client_, server_, 'u');
    carry_stream(server_, client_, 'd');
    carry_datagrams();
  }

 private:
  static File socket_of(int type) {
    return File(::socket(AF_INET, type | SOCK_NONBLOCK | SOCK_CLOEXEC, 0));
  }
  static sockaddr_in loopback(std::uint16_t port) {
    sockaddr_in place{};
    place.sin_family = AF_INET;
    place.sin_port = htons(port);
    place.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    return place;
  }
  static void bind_to_loopback(const File& file) {
    const sockaddr_in place = loopback(0);
    EXPECT_EQ(::bind(file.number(), reinterpret_cast<const sockaddr*>(&place), sizeof place), 0);
  }
  static std::uint16_t port_of(const File& file) {
    sockaddr_in place{};
    socklen_t size = sizeof place;
    EXPECT_EQ(::getsockname(file.number(), reinterpret_cast<sockaddr*>(&place), &size), 0);
    return ntohs(place.sin_port);
  }
  void accept() {
    client_ = File(::accept4(door_.number(), nullptr, nullptr, SOCK_NONBLOCK | SOCK_CLOEXEC));
    if (!client_) return;
    server_ = File(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0));
    const sockaddr_in place = loopback(server_port_);
    EXPECT_EQ(::connect(server_.number(), reinterpret_cast<const sockaddr*>(&place), sizeof place),
              0);
  }
  void keep(char what, Bytes bytes) {
    record_ += what;
    record_ += text_of(values_of(number_, static_cast<std::uint32_t>(bytes.size())));
    record_ += text_of(bytes);
  }
  void carry_stream(File& from, File& to, char what) {
    for (ssize_t size = 0;
         (size = ::recv(from.number(), buffer_, sizeof buffer_, MSG_DONTWAIT)) > 0;) {
      if (what == 'd' && !has_greeting_) {  // where the datagrams must go: to us
        ASSERT_GE(size, 22);
        std::memcpy(&server_datagrams_, buffer_ + 4, 2);
        const std::uint16_t ours = port_of(client_facing_);
        std::memcpy(buffer_ + 4, &ours, 2);
        has_greeting_ = true;
      }
      keep(what, Bytes(buffer_, static_cast<std::size_t>(size)));
      ASSERT_EQ(::send(to.number(), buffer_, static_cast<std::size_t>(size), MSG_NOSIGNAL), size);
    }
  }
  void carry_datagrams() {
    socklen_t length = sizeof client_place_;
    for (ssize_t size = 0;
         (size = ::recvfrom(client_facing_.number(), buffer_, sizeof buffer_, MSG_DONTWAIT,
                            reinterpret_cast<sockaddr*>(&client_place_), &length)) > 0;)
      pass(Bytes(buffer_, static_cast<std::size_t>(size)), true);
    for (ssize_t size = 0;
         (size = ::recv(server_facing_.number(), buffer_, sizeof buffer_, MSG_DONTWAIT)) > 0;)
      pass(Bytes(buffer_, static_cast<std::size_t>(size)), false);
  }
  void pass(Bytes datagram, bool is_up) {
    const bool is_lost = is_lost_(is_up, datagram);
    keep(is_lost ? (is_up ? 'X' : 'Y') : (is_up ? 'U' : 'D'), datagram);
    if (is_lost) return;
    const sockaddr_in place = is_up ? loopback(server_datagrams_) : client_place_;
    const File& from = is_up ? server_facing_ : client_facing_;
    EXPECT_EQ(::sendto(from.number(), datagram.data(), datagram.size(), 0,
                       reinterpret_cast<const sockaddr*>(&place), sizeof place),
              static_cast<ssize_t>(datagram.size()));
  }

  std::uint16_t server_port_, server_datagrams_ = 0;
  std::uint32_t number_;
  std::string& record_;
  std::function<bool(bool, Bytes)> is_lost_;
  File door_ = socket_of(SOCK_STREAM), client_facing_ = socket_of(SOCK_DGRAM),
       server_facing_ = socket_of(SOCK_DGRAM), client_, server_;
  sockaddr_in client_place_{};
  bool has_greeting_ = false;
  std::byte buffer_[65536];
};

}  // namespace rink::rti::testing
