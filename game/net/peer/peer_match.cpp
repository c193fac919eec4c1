// Each frame: receive, predict, press, show.
#include "game/net/peer/peer_match.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

#include "game/model/time_grid.h"

namespace rink::game {
namespace {

constexpr double predicted_longest_s =
    0.5;  ///< without updates, after which the picture stands still with a notice
constexpr double notice_s = 8.0;
/// m from the own bat: beyond, nothing can come near it before the next update. More than
/// PredictedRink::crowd_reach, so that a body is in the others' time before it leaves the
/// prediction.
constexpr double near_reach = 1.2;

KeysHeld keys_of(const Vector2& thrust) {
  KeysHeld held;
  held.set(Key::right, thrust.x() > 0.0), held.set(Key::left, thrust.x() < 0.0),
      held.set(Key::up, thrust.y() > 0.0), held.set(Key::down, thrust.y() < 0.0);
  return held;
}

}  // namespace

/// Exact unless it had several events in one window, or is a replica.
Vector2 PeerMatch::Known::at(double instant) const {
  if (instant >= motion.time) return motion.at(instant).position;
  return before.time <= instant ? before.at(instant).position : motion.position;
}

PeerMatch::PeerMatch(const SharedGame& game, InputQueue& input)
    : game_(game),
      input_(input),
      known_(game.start().world().body_count()),
      sight_(rink::game::sight_of(game.scene())) {
  std::uint32_t pucks = 0;
  for (const Entity& entity : game.start().entities()) {
    Known& known = known_[entity.id.index];
    known.kind = entity.kind;
    if (entity.kind == physics::BodyKind::bat) known.number = *entity.player;
    if (entity.kind == physics::BodyKind::puck) known.number = pucks++;
    known.motion = known.before = game.start().world().motion(entity.id);
    all_things_.push_back({.id = entity.id.index,
                           .kind = entity.kind,
                           .team = entity.team,
                           .position = game.start().position(entity.id),
                           .half_extent = entity.half_extent});
  }
  sight_.things = all_things_;
  sight_.can_rematch = false;
  sight_.left_name = "left", sight_.right_name = "right";
}

void PeerMatch::press(std::uint32_t, Key key, bool is_down) { pressed_.push_back({key, is_down}); }

void PeerMatch::advance(double now_s) {
  const PeerStage::Step before = stage_.step;
  stage_ = input_.stage();
  if (stage_.step != before) stage_s_ = now_s;
  if (stage_.notice_count != std::exchange(notice_count_, stage_.notice_count)) notice_s_ = now_s;
  if (std::optional<PeerSight> news = input_.look()) {
    receive(std::move(*news));
    received_s_ = now_s;
  }
  if (const auto answer = input_.take_answer())
    clock_.answered(answer->number, answer->felt_at, now_s);
  clock_.advance(now_s);
  if (is_playing())
    if (const auto question = clock_.ask(now_s)) input_.ask(*question);
  predict(now_s);
  show(now_s);
  now_s_ = now_s;
}

void PeerMatch::receive(PeerSight news) {
  if (rink_) delay_.received(rink_->now(), news.since);
  news_ = std::move(news);
  const ReceivedRink all = received();
  if (!rink_) rink_.emplace(game_.scene(), stage_.player);
  rink_->receive(all);
}

ReceivedRink PeerMatch::received() {
  const Scene& scene = game_.scene();
  ReceivedRink all{.time = news_->time,
                   .bats = std::vector<ReceivedBody>(scene.bodies.bats.size()),
                   .pucks = std::vector<ReceivedBody>(scene.bodies.pucks.size()),
                   .own_felt = news_->own_felt};
  for (std::vector<ReceivedBody>* bodies : {&all.bats, &all.pucks})
    for (ReceivedBody& body : *bodies) body.is_known = false;
  for (const KnownBody& body : news_->bodies) add_body(body, all);
  for (Known& known : known_)
    if (known.window != news_->window) known.is_near = false;
  ReceivedBody& own = all.bats[known_[news_->own_bat].number];
  if (!own.is_known)
    own = {.position = news_->own_position, .velocity = news_->own_velocity, .held = {}};
  own.held = news_->own_held;
  return all;
}

void PeerMatch::add_body(const KnownBody& body, ReceivedRink& all) {
  Known& known = known_[body.body];
  known.before = known.motion;
  known.motion = body.motion;
  known.window = news_->window;
  known.is_in_play = body.is_in_play;
  const Vector2 place = known.at(news_->time);
  const bool is_own = body.body == news_->own_bat, was_near = known.is_near;
  known.is_near = is_own || (place - news_->own_position).cwiseAbs().maxCoeff() < near_reach;
  if (known.is_near && !was_near) known.near_since = news_->time;
  ReceivedBody& received =
      (known.kind == physics::BodyKind::bat ? all.bats : all.pucks)[known.number];
  const physics::Motion now = body.motion.at(std::max(news_->time, body.motion.time));
  received = {.position = place,
              .velocity = now.velocity,
              .held = keys_of(body.thrust),
              .is_in_play = body.is_in_play,
              .is_known = known.is_near};
}

void PeerMatch::predict(double now_s) {
  if (!rink_) return;
  const bool does_run = is_playing() && clock_.is_set();
  const double instant = does_run ? clock_.arrival(now_s) : rink_->received_time();
  const double now = rink_->within_reach(instant, predicted_longest_s);
  if (does_run) press_keys(now);
  move_delay(now_s - now_s_);
  rink_->advance(now, delay_.seconds());
}

void PeerMatch::press_keys(double instant) {
  const double felt_at = next_on(key_grid, instant);
  for (const PressedKey& pressed : std::exchange(pressed_, {})) {
    input_.press({pressed.key, pressed.is_down, felt_at});
    rink_->press(pressed.key, pressed.is_down, felt_at);
  }
}

void PeerMatch::move_delay(double dt) {
  const double estimate = 3.0 * (news_->time - news_->since);
  delay_.move(is_playing() ? delay_.measured_or(estimate) : 0.0, dt);
}

void PeerMatch::show(double now_s) {
  if (rink_) show_things();
  show_stage(now_s);
  show_link(now_s);
  goals_.look(sight_, now_s, game_.scene().rules.face_off_delay);
  noises_.listen(sight_);
}

void PeerMatch::show_things() {
  sight_.time = rink_->now();
  sight_.things.clear();
  for (const Thing& thing : all_things_)
    if (thing.kind == physics::BodyKind::post) sight_.things.push_back(thing);
    else if (known_[thing.id].window == news_->window || thing.id == news_->own_bat)
      show_thing(thing.id);
  drop_scored(sight_);
  sight_.zones = news_->zones;
  sight_.score = {news_->goals_left, news_->goals_right};
}

/// Bodies near the own bat are predicted; all others are on their known paths, in the others' time.
void PeerMatch::show_thing(std::uint32_t body) {
  const Known& known = known_[body];
  const double others = rink_->now() - delay_.seconds();
  const bool is_own = body == news_->own_bat;
  if (!is_own && !known.is_in_play) return;
  Thing thing = all_things_[body];
  if (is_own || (known.is_near && known.near_since <= others)) {
    const ShownBody& shown =
        (known.kind == physics::BodyKind::bat ? rink_->bats() : rink_->pucks())[known.number];
    thing.position = shown.position, thing.velocity = shown.velocity;
  } else {
    thing.position = known.at(std::min(others, news_->time)),
    thing.velocity = known.motion.velocity;
  }
  sight_.things.push_back(thing);
}

void PeerMatch::show_stage(double now_s) {
  using Step = PeerStage::Step;
  switch (stage_.step) {
    case Step::gathering:
      sight_.phase = MatchPhase::waiting;
      break;
    case Step::countdown:
      sight_.phase = MatchPhase::countdown;
      break;
    case Step::playing:
      sight_.phase = MatchPhase::playing;
      break;
    case Step::over:
      sight_.phase = MatchPhase::over;
      break;
    case Step::lost:
      sight_.phase = MatchPhase::lost;
      break;
  }
  sight_.remaining_s = std::max(0.0, stage_.begins_in_s - (now_s - stage_s_));
  sight_.notice = stage_.words;
  if (is_playing() && now_s < notice_s_ + notice_s) sight_.notice = stage_.notice;
  const double silent_s = now_s - std::max(received_s_, stage_s_);
  if (is_playing() && silent_s > predicted_longest_s) {
    char words[96];
    std::snprintf(words, sizeof words,
                  "The game stands: for %.1f s no window has been agreed upon with the other peers",
                  silent_s);
    sight_.notice = words;
  }
  const auto& [left, right] = sight_.score;
  if (stage_.step == Step::over && sight_.goals_to_win &&
      std::max(left, right) >= *sight_.goals_to_win)
    sight_.winner = left > right ? Team::left : Team::right;
  if (!stage_.player) return;
  const Bat& own = game_.scene().bodies.bats[*stage_.player];
  sight_.own_thing = game_.start().bat(*stage_.player)->index;
  if (game_.scene().bodies.bats.size() == 2 && own.team != Team::none) sight_.own_team = own.team;
}

void PeerMatch::show_link(double now_s) {
  if (!news_) return;
  LinkFigures figures{.ping_ms = 1e3 * clock_.ping_s(),
                      .jitter_ms = 1e3 * clock_.jitter_s(),
                      .loss = 0.0,
                      .tick = news_->window,
                      .payload_bytes_per_s = traffic_.measure(news_->bytes_sent, now_s)};
  show_prediction(*rink_, delay_.seconds(), figures);
  sight_.link = figures;
}

}  // namespace rink::game
