// A port for programs that must be given the number before they listen.
#pragma once

#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <stdexcept>
#include <string>

namespace rink::test {

/// A TCP port that the kernel chose and gives to nobody who asks for any, as long as this lives.
/// Who names it may listen there: this socket is bound, but does not listen.
class ReservedPort {
 public:
  ReservedPort() {
    const int yes = 1;
    sockaddr_in place{};
    socklen_t size = sizeof place;
    place.sin_family = AF_INET;
    auto* address = reinterpret_cast<sockaddr*>(&place);
    const bool is_bound = setsockopt(socket_, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes) == 0 &&
                          bind(socket_, address, size) == 0;
    if (!is_bound || getsockname(socket_, address, &size) != 0)
      throw std::runtime_error("no port for the test");
    number_ = ntohs(place.sin_port);
  }
  ~ReservedPort() { close(socket_); }
  ReservedPort(const ReservedPort&) = delete;
  ReservedPort& operator=(const ReservedPort&) = delete;

  std::string text() const { return std::to_string(number_); }

 private:
  const int socket_ = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  int number_ = 0;
};

}  // namespace rink::test
