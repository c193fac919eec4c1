// Turns away who has too many connections already.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "rti/transport/staged/staged_transport.h"

namespace rink::rti {

struct AddressLimitSettings {
  std::size_t most = 0;                 ///< connections of one address at once, at least 1
  bool spares_loopback = true;          ///< programs of this machine may have any number
  std::vector<std::byte> last_words{};  ///< sent to who is turned away
};

/// Holds each address (`Transport::peer_network`) to so many open connections, so that one host
/// cannot take all files from the others. Who opens one more is told and closed; whoever is above
/// never hears of it. Connections without an address are not counted.
class AddressLimit final : public TransportStage {
 public:
  explicit AddressLimit(AddressLimitSettings settings);

  /// Connections turned away so far.
  std::uint64_t turned_away() const { return turned_away_; }

 private:
  void on_open(ConnectionId connection) override;
  void on_bytes(ConnectionId connection, Bytes bytes) override;
  void on_close(ConnectionId connection, CloseReason reason, const std::string& detail) override;
  void on_datagram(ConnectionId connection, Bytes datagram) override;
  bool is_turned_away(ConnectionId connection) const {
    return connection < known_.size() && known_[connection].is_turned_away;
  }

  using Counts = std::map<std::string, std::size_t>;
  struct Known {
    Counts::value_type* own = nullptr;  ///< the count of its address, if that is held to the limit
    bool is_turned_away = false;
  };

  AddressLimitSettings settings_;
  Counts counts_;
  std::vector<Known> known_;  ///< by connection
  std::uint64_t turned_away_ = 0;
};

/// Half of the files that the process may open: what one address may have where nothing is said.
std::size_t address_limit_default();

}  // namespace rink::rti
