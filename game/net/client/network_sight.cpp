// Makes the picture of a network match from predictions, replicas and figures of the connection.
#include <algorithm>

#include "game/net/client/network_match.h"

namespace rink::game {

void NetworkMatch::show(double now_s) {
  if (rink_ && rink_->has_received()) show_bodies();
  else if (settings_.only_watches) show_replicas(now_s);
  show_state(now_s);
  show_interest(now_s);
  sight_.notice = !host_.is_lost() && !host_.has_joined() ? "connecting ..." : host_.error();
  sight_.interrupted_s.reset();
  if (!host_.is_lost() && host_.is_interrupted()) sight_.interrupted_s = host_.silent_s();
  if (!host_.is_lost() && state_.is_unrecorded && sight_.phase != MatchPhase::playing)
    sight_.notice = "The host could not record the last match";
  show_link(now_s);
  goals_.look(sight_, now_s, scene() != nullptr ? scene()->rules.face_off_delay : 0.0);
  noises_.listen(sight_);
}

void NetworkMatch::show_bodies() {
  sight_.things = scene_.things();
  std::size_t thing = 0;
  for (const auto* bodies : {&rink_->bats(), &rink_->pucks()})
    for (const ShownBody& body : *bodies) {
      sight_.things[thing].position = body.position;
      sight_.things[thing++].velocity = body.velocity;
    }
  sight_.time = rink_->now();
  if (state_.phase != MatchPhase::over) drop_scored(sight_);
}

/// Shows a game that is no match: everything on its path by the updates.
void NetworkMatch::show_replicas(double now_s) {
  const ReplicaSet& replicas = client_.replicas();
  if (!replicas.field()) return;
  sight_.field.length = static_cast<double>(replicas.field()->length);
  sight_.field.width = static_cast<double>(replicas.field()->width);
  sight_.time = replicas.newest().time + (replicas.newest().time > 0.0 ? now_s - received_s_ : 0.0);
  sight_.things.clear();
  for (const EntityReplica& entity : replicas.entities()) {
    if (!entity.in_scope || !entity.is_placed)
      continue;  // a budget may delay its position and kind
    sight_.things.push_back({.id = entity.object.value,
                             .kind = static_cast<physics::BodyKind>(entity.shape.kind),
                             .team = static_cast<Team>(entity.shape.team),
                             .position = entity.position_at(sight_.time),
                             .half_extent = {static_cast<double>(entity.shape.half_length),
                                             static_cast<double>(entity.shape.half_width)}});
  }
}

void NetworkMatch::show_state(double now_s) {
  const Goals& goals = client_.replicas().goals();
  sight_.score = {goals.left, goals.right};
  sight_.winner = state_.winner;
  sight_.phase = state_.phase;
  if (host_.is_lost()) sight_.phase = MatchPhase::lost;
  else if (client_.state() != Client::State::playing) sight_.phase = MatchPhase::waiting;
  else if (!client_.replicas().has_match()) sight_.phase = MatchPhase::playing;
  else if (state_.phase == MatchPhase::countdown && rink_ &&
           rink_->now() > state_.clock_simulated_s)
    sight_.phase = MatchPhase::playing;  // it is foreseen
  const bool is_counted = sight_.phase == MatchPhase::countdown || sight_.phase == MatchPhase::away;
  const double until_s =
      host_.clock().is_set() ? std::max(0.0, state_.until_s - host_.clock().arrival(now_s)) : 0.0;
  sight_.remaining_s = is_counted ? until_s : 0.0;
  const bool is_ending = sight_.phase == MatchPhase::playing && state_.holder;
  sight_.holder = is_ending ? state_.holder : std::nullopt;
  sight_.possession_s = is_ending ? until_s : 0.0;
  const std::optional<std::uint32_t> own = player();
  if (!own || *own > 1) return;
  sight_.own_team = *own == 0 ? Team::left : Team::right;
  sight_.wants_rematch = state_.wants_rematch[*own];
  sight_.other_wants_rematch = state_.wants_rematch[1 - *own];
}

/// The shown decisions are up to a tenth of a second and a round trip old.
void NetworkMatch::show_interest(double now_s) {
  InterestQuestions* const questions = client_.questions();
  if (questions == nullptr) return;
  const bool may_be_asked = sight_.phase == MatchPhase::playing && !client_.replicas().has_match();
  inspected_.show(*questions, may_be_asked, now_s, sight_.interest);
}

void NetworkMatch::show_link(double now_s) {
  const rti::AmbassadorCounters& counters = client_.ambassador().counters();
  LinkFigures figures{.ping_ms = 1e3 * host_.clock().ping_s(),
                      .jitter_ms = 1e3 * host_.clock().jitter_s(),
                      .loss = host_.clock().loss(),
                      .tick = counters.frames_received,
                      .payload_bytes_per_s = traffic_.measure(counters.bytes_received, now_s)};
  if (rink_) show_prediction(*rink_, delay_.seconds(), figures);
  sight_.link = figures;
}

}  // namespace rink::game
