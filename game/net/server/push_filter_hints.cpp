// A player with held keys looks in their direction.
#include "game/net/server/push_filter_hints.h"

#include "game/replication/filter_setup.h"

namespace rink::game {
namespace {

void push_facts(const Server& server, rti::FederationExecution& federation, GameFacts& facts,
                double now) {
  const Game& game = server.game();
  for (const Entity& entity : game.entities()) {
    const rti::ObjectHandle object = server.publisher().object(entity.id);
    federation.set_object_facts(object, facts.of(game, entity, now));
  }
  server.seats().for_each([&](rti::FederateHandle federate, const Seats::Seat& seat) {
    const auto bat = game.bat(seat.player);
    if (!seat.is_offered || !bat) return;
    federation.set_federate_facts(federate, facts.of(game, game.entity(*bat), now));
  });
}

/// A player feels at once what its own keys and collisions do to its bat. What is sent at each tick
/// anyway waits.
void send_own_at_once(const Server& server, rti::FederationExecution& federation,
                      rti::AttributeSet attributes) {
  for (const auto& [object, entity] : server.publisher().registered())
    if (entity.player)
      if (const auto federate = server.seats().federate_of(*entity.player))
        federation.send_at_once(*federate, object, attributes);
  for (const auto& [federate, player] : server.seats().offered())
    federation.send_at_once(federate, server.publisher().object(*server.game().bat(player)),
                            attributes);
}

}  // namespace

void push_filter_hints(const Server& server, rti::FederationExecution& federation,
                       GameFacts& facts) {
  for (const auto& [object, entity] : server.publisher().registered())
    federation.set_object_role(object, role_of(entity, server.is_always_relevant(entity.kind)));
  for (const auto& [federate, player] : server.seats().offered())
    federation.set_federate_role(federate,
                                 role_of(server.game().entity(*server.game().bat(player)), false));
  send_own_at_once(server, federation, server.publisher().event_attributes());
  const im::Traits traits = federation.filter().traits();
  if (traits.uses_headings)
    server.seats().for_each([&](rti::FederateHandle federate, const Seats::Seat& seat) {
      if (!seat.is_offered) return;
      const Vector2 to = direction(server.game().keys_held(seat.player));
      federation.set_federate_heading(federate, {to.x(), to.y()});
    });
  if (!traits.uses_flights && !traits.uses_facts) return;
  // One clock for all matches, since a filter's time must not go back.
  const double earlier_s = server.hosted() ? server.hosted()->earlier_s() : 0.0;
  federation.set_time(earlier_s + server.game().now());
  if (traits.uses_facts) push_facts(server, federation, facts, earlier_s + server.game().now());
  for (auto [object, flight] : server.publisher().flights()) {
    flight.time += earlier_s;
    federation.set_object_flight(object, flight);
  }
}

}  // namespace rink::game
