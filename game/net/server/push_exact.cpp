// Adds to a tick whose bat each federate plays.
#include "game/net/server/push_exact.h"

namespace rink::game {

void push_exact(const Server& server, ExactFeed& feed, const rti::Stamp& stamp,
                rti::FederationExecution& execution) {
  const auto player_of = [&server](rti::FederateHandle federate) -> std::optional<std::uint32_t> {
    const Seats::Seat* const seat = server.seats().find(federate);
    return seat != nullptr ? std::optional(seat->player) : std::nullopt;
  };
  feed.send({server.publisher(), stamp, server.keys().felt(), player_of}, execution);
}

}  // namespace rink::game
