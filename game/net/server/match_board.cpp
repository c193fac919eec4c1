// Publishes the state of a match when it changes.
#include "game/net/server/match_board.h"

#include <span>
#include <vector>

#include "game/replication/attributes.h"

namespace rink::game {

MatchBoard::MatchBoard(rti::Ambassador& ambassador, const ObjectModel& model,
                       const std::string& scene_text, double tick_s)
    : ambassador_(ambassador), model_(model) {
  for (const rti::InteractionClassHandle interaction : {model.pause, model.rematch, model.ping})
    ambassador.subscribe_interaction_class(interaction);
  ambassador.publish_interaction_class(model.pong);
  ambassador.publish_object_class_attributes(
      model.match, {model.match_state, model.match_scene, model.match_tick});
  match_ = ambassador.register_object_instance(model.match, "match");
  std::vector<std::byte> bytes;
  const SceneText scene{std::as_bytes(std::span(scene_text))};
  ambassador.update_attribute_values(match_, {model.match_scene, model.match_tick},
                                     encode(bytes, scene, TickPeriod{tick_s}), {});
}

void MatchBoard::show(const MatchState& state, const rti::Stamp& stamp) {
  if (shown_ == state) return;
  shown_ = state;
  std::vector<std::byte> bytes;
  ambassador_.update_attribute_values(match_, {model_.match_state}, encode(bytes, *shown_), stamp);
}

void MatchBoard::answer(rti::FederateHandle federate, std::uint64_t number, double now_s) {
  ambassador_.send_directed_interaction(model_.pong, federate, {}, {.time = now_s, .tag = number});
  is_urgent_ = true;
}

}  // namespace rink::game
