// Counts open connections by address.
#include "rti/transport/staged/address_limit.h"

#include <sys/resource.h>

#include <algorithm>
#include <cassert>
#include <span>
#include <utility>

namespace rink::rti {
namespace {

bool is_loopback(const std::string& network) {
  return network.starts_with("127.") || network == "::/64";
}

}  // namespace

AddressLimit::AddressLimit(AddressLimitSettings settings) : settings_(std::move(settings)) {
  assert(settings_.most > 0);
}

void AddressLimit::on_open(ConnectionId connection) {
  if (connection >= known_.size()) known_.resize(connection + std::size_t{1});
  const std::string network = peer_network(connection);
  if (network.empty() || (settings_.spares_loopback && is_loopback(network)))
    return TransportStage::on_open(connection);
  Counts::value_type& own = *counts_.try_emplace(network).first;
  if (own.second < settings_.most) {
    ++own.second;
    known_[connection].own = &own;
    return TransportStage::on_open(connection);
  }
  known_[connection].is_turned_away = true;
  ++turned_away_;
  if (const Bytes words = settings_.last_words; !words.empty())
    send(connection, std::span(&words, 1));
  close(connection);
}

void AddressLimit::on_bytes(ConnectionId connection, Bytes bytes) {
  if (!is_turned_away(connection)) TransportStage::on_bytes(connection, bytes);
}

void AddressLimit::on_datagram(ConnectionId connection, Bytes datagram) {
  if (!is_turned_away(connection)) TransportStage::on_datagram(connection, datagram);
}

void AddressLimit::on_close(ConnectionId connection, CloseReason reason,
                            const std::string& detail) {
  const Known known = connection < known_.size() ? std::exchange(known_[connection], {}) : Known{};
  if (known.own != nullptr && --known.own->second == 0) counts_.erase(known.own->first);
  if (!known.is_turned_away) TransportStage::on_close(connection, reason, detail);
}

std::size_t address_limit_default() {
  constexpr rlim_t files_max = 1u << 20;
  rlimit limit{};
  if (getrlimit(RLIMIT_NOFILE, &limit) != 0) return files_max / 2;
  return std::max<std::size_t>(1, std::min(limit.rlim_max, files_max) / 2);
}

}  // namespace rink::rti
