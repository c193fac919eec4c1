// Sends a player's requests about a match; the server decides whether they have effect.
#include "game/net/client/match_remote.h"

#include <cassert>

#include "game/replication/attributes.h"

namespace rink::game {

MatchRemote::MatchRemote(rti::Ambassador& ambassador, const ObjectModel& model)
    : ambassador_(ambassador), model_(model) {
  for (const rti::InteractionClassHandle interaction :
       {model.pause, model.rematch, model.ping, model.push})
    ambassador.publish_interaction_class(interaction);
  ambassador.subscribe_interaction_class(model.pong);
  ambassador.subscribe_object_class_attributes(
      model.match, {model.match_state, model.match_scene, model.match_tick});
}

void MatchRemote::push(const Push& push, double instant) {
  assert(is_sound(push));
  ambassador_.send_interaction(model_.push, encode(encoded_, steps_of(push)),
                               {.time = instant, .tag = 0});
  ++pushes_sent_;
}

void MatchRemote::pause(bool is_wanted) {
  const PauseWish wish{static_cast<std::uint8_t>(is_wanted)};
  std::vector<std::byte> bytes;
  ambassador_.send_interaction(model_.pause, encode(bytes, wish), {});
}

}  // namespace rink::game
