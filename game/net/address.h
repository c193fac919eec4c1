// Reads the address of a server as players write it.
#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>
#include <utility>

namespace rink::game {

/// "127.0.0.1:4711" or "[::1]:4711" in two; the port is at least `port_min`, 0 where any free one
/// will do. Throws std::invalid_argument that names `flag`.
inline std::pair<std::string, std::uint16_t> address_and_port(const std::string& flag,
                                                              const std::string& text,
                                                              unsigned long port_min = 1) {
  const std::size_t colon = text.rfind(':');
  const bool has_port = colon != std::string::npos && colon + 1 < text.size() &&
                        text.find_first_not_of("0123456789", colon + 1) == std::string::npos &&
                        text.size() - colon <= 6;
  const unsigned long port = has_port ? std::stoul(text.substr(colon + 1)) : 0;
  if (!has_port || port < port_min || port > 65535 || colon == 0)
    throw std::invalid_argument(flag + ": '" + text + "' is not ADDRESS:PORT with a port from " +
                                std::to_string(port_min) + " to 65535");
  std::string address = text.substr(0, colon);
  if (address.size() > 2 && address.front() == '[' && address.back() == ']')
    address = address.substr(1, address.size() - 2);
  return {address, static_cast<std::uint16_t>(port)};
}

}  // namespace rink::game
