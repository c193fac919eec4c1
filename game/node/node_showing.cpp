// Shows the server what all nodes have played.
#include <algorithm>
#include <utility>

#include "game/net/peer/crowd.h"
#include "game/node/node.h"

namespace rink::game {
namespace {

/// Free flights have the rest of their state in `game`.
std::vector<Game::ShownBody> bodies_of(const peer::PartChange& change, const Game& game) {
  std::vector<Game::ShownBody> bodies;
  bodies.reserve(change.bodies.size() + change.free_flights.size());
  for (const peer::Handover::Body& body : change.bodies)
    bodies.push_back({{body.number}, body.state});
  for (const peer::FreeFlightState& flight : change.free_flights) {
    bodies.push_back({{flight.number}, physics::Subdomain::state_in(game.world(), flight.number)});
    flight.write_to(bodies.back().state.flight);
  }
  return bodies;
}

Game::ShownScore shown_score(const peer::Scoring& scoring) {
  Game::ShownScore shown{.score = {scoring.left, scoring.right},
                         .is_over = scoring.is_over,
                         .face_offs = {},
                         .stays = scoring.halves.stays()};
  for (const peer::FaceOff& due : scoring.face_offs)
    shown.face_offs.push_back({due.time, {due.puck}, due.is_left ? Team::left : Team::right});
  return shown;
}

}  // namespace

std::optional<ShownWindow> Node::show_next(double until, Game& game) {
  if (match_ && match_->has_shown_all()) return check(), std::nullopt;
  const bool is_over = outcome_.has_ended;  // what all have told was added before
  const auto stretch = feed_->take(until + rounding_s);
  if (!stretch) {
    check();
    if (is_over && feed_->taken() < feed_->count(match_ ? 0 : number()) &&
        feed_->end_of(feed_->taken() + 1) <= until)
      throw SessionError(ExitStatus::failed,
                         "another node has ended without telling what it played last");
    return std::nullopt;
  }
  if (match_) match_->note_shown(feed_->taken());
  std::vector<Game::ShownBody> bodies;
  ShownWindow shown;
  for (const peer::PartChange& change : stretch->changes) {
    for (Game::ShownBody& body : bodies_of(change, game)) {
      shown.told.push_back(body.id);
      bodies.push_back(std::move(body));
    }
    for (const std::uint32_t body : change.gone) shown.left.push_back({body});
    for (const peer::Key& key : change.log)
      shown.keys.push_back(event_of(key.input, key.time, *game.entity({key.bat}).player));
  }
  game.show(stretch->changes.front().time, bodies, shown.keys, shown_score(stretch->score));
  return shown;
}

bool Node::has_come(double until) const {
  if (outcome_.has_ended || (match_ && match_->has_shown_all())) return true;
  return feed_->has_come(std::min(until, terms().until) - rounding_s);
}

bool Node::has_shown_all() const {
  if (match_) return match_->has_shown_all();
  return outcome_.has_ended && !outcome_.failure && feed_->taken() == feed_->count(number());
}

}  // namespace rink::game
