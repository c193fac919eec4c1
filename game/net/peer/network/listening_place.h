// The place where a peer listens, by its command line.
#pragma once

#include <stdexcept>
#include <string>

#include "game/net/address.h"
#include "game/net/peer/network/greetings.h"

namespace rink::game {

/// The names of a command's flags for places.
struct PlaceFlags {
  std::string listen = "--listen", join = "--join";
};

/// Others are sent the address, so it must be one that they can use. `has_addresses`: it is an
/// address of a machine, not a name within this one. Throws std::invalid_argument.
inline Place listening_place(const std::string& listen, const std::string& join, bool has_addresses,
                             const PlaceFlags& flags = {}) {
  const auto is_here = [](const std::string& address) {
    return address.starts_with("127.") || address == "::1" || address == "localhost";
  };
  if (listen.empty()) {
    if (join.empty())
      throw std::invalid_argument(flags.listen +
                                  " ADDRESS:PORT is missing, for the first peer; all others give " +
                                  flags.join + " HOST:PORT");
    if (has_addresses && !is_here(address_and_port(flags.join, join).first))
      throw std::invalid_argument(flags.listen +
                                  " ADDRESS:0 is missing: with peers on other machines, the "
                                  "address at which they reach this one");
    return {"127.0.0.1", 0};
  }
  const auto [address, port] = address_and_port(flags.listen, listen, 0);
  if (address == "0.0.0.0" || address == "::")
    throw std::invalid_argument(flags.listen +
                                ": others are sent this address, and none can connect to " +
                                address + ": expected one of this machine's own");
  return {address, port};
}

}  // namespace rink::game
