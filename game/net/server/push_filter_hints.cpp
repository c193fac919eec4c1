// Teams are the sides of the table, owners the players by number; a player with held keys looks in
// their direction.
#include "game/net/server/push_filter_hints.h"

namespace rink::game {
namespace {

std::uint32_t team_number(Team team) {
  return team == Team::none ? im::Role::none : static_cast<std::uint32_t>(team);
}

}  // namespace

void push_filter_hints(const Server& server, rti::FederationExecution& federation) {
  for (const auto& [object, entity] : server.publisher().registered())
    federation.set_object_role(object,
                               {.team = team_number(entity.team),
                                .owner = entity.player.value_or(im::Role::none),
                                .is_always_relevant = server.is_always_relevant(entity.kind)});
  for (const auto& [federate, player] : server.seats().offered())
    federation.set_federate_role(
        federate, {.team = team_number(server.game().entity(*server.game().bat(player)).team),
                   .owner = player});
  const im::Traits traits = federation.filter().traits();
  if (traits.uses_headings)
    server.seats().for_each([&](rti::FederateHandle federate, const Seats::Seat& seat) {
      if (!seat.is_offered) return;
      const Vector2 to = direction(server.game().keys_held(seat.player));
      federation.set_federate_heading(federate, {to.x(), to.y()});
    });
  if (!traits.uses_flights) return;
  // One clock for all matches, since a filter's time must not go back.
  const double earlier_s = server.hosted() ? server.hosted()->earlier_s() : 0.0;
  federation.set_time(earlier_s + server.game().now());
  for (auto [object, flight] : server.publisher().flights()) {
    flight.time += earlier_s;
    federation.set_object_flight(object, flight);
  }
}

}  // namespace rink::game
