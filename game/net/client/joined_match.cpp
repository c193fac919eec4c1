// Opens the connection and resigns at the end.
#include "game/net/client/joined_match.h"

#include "game/net/address.h"
#include "game/net/fom_file.h"
#include "game/net/gate.h"
#include "game/replication/trajectory_codec.h"

namespace rink::game {

JoinedMatch::JoinedMatch(const std::string& place, const NetworkMatchSettings& settings,
                         const std::string& key_file)
    : fom_(load_rink_fom(fom_file())),
      model_(fom_),
      gate_(transport_),
      match_(fom_, model_,
             add_gate(gate_,
                      {.key_file = key_file,
                       .role = rti::Role::federate,
                       .federation = settings.federation},
                      [this] { return now_s_; }),
             connect(transport_, place), settings) {}

JoinedMatch::~JoinedMatch() { match_.leave(now_s_); }

rti::ConnectionId JoinedMatch::connect(rti::TcpTransport& transport, const std::string& place) {
  const auto [address, port] = address_and_port("HOST:PORT", place);
  return transport.connect(address, port);
}

}  // namespace rink::game
