// Each frame: hear, foretell, press, show, say.
#include "game/net/client/network_match.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "game/model/scene_file.h"
#include "game/model/time_grid.h"

namespace rink::game {
namespace {

constexpr double match_patience_s = 3.0;  ///< for a match to be told of, once joined
constexpr double foretold_longest_s =
    60.0;  ///< without news, which come every few seconds while anything moves
constexpr std::uint32_t caught_up_most =
    32;  ///< ticks heard of in one frame, each of which is worked out: half a second's; a host
         ///< could send any number
constexpr double time_bend = 0.5;  ///< how much slower or faster than real time the other's time
                                   ///< may run while its delay changes

// What a match may say without being no match: beyond, an engine that takes its word would have no
// end of impacts, or no next instant.
constexpr double fastest_told = 100.0;  ///< m/s
constexpr double latest_told = 1e9;     ///< s, as in scenes

/// Where a body is and how it moves, as of `time`.
ToldBody told_of(const MirroredEntity& entity, double time) {
  ToldBody body{.position = entity.position_at(time), .held = {}};
  if (entity.trajectory && !entity.trajectory->is_resting())
    body.velocity = entity.motion.at(std::max(time, entity.motion.time)).velocity;
  body.velocity = body.velocity.cwiseMax(-fastest_told).cwiseMin(fastest_told);
  for (const Key key : all_keys)
    body.held.set(key, (entity.input.held >> static_cast<unsigned>(key) & 1u) != 0);
  return body;
}

bool is_kind(const MirroredEntity& entity, physics::BodyKind kind) {
  return entity.in_scope && entity.is_placed &&
         entity.shape.kind == static_cast<std::uint8_t>(kind);
}

}  // namespace

ClientSettings NetworkMatch::client_settings(const NetworkMatchSettings& settings) {
  return {.federation = settings.federation,
          .name = settings.name,
          .view_fraction = 1.0,
          .plays_match = true,
          .only_watches = settings.only_watches};
}

NetworkMatch::NetworkMatch(const rti::Fom& fom, const ObjectModel& model, rti::Transport& transport,
                           rti::ConnectionId connection, const NetworkMatchSettings& settings)
    : settings_(settings),
      client_(fom, model, client_settings(settings)),
      transport_(transport),
      link_(client_.ambassador(), transport, connection) {
  links_.add(link_);
  client_.before_next_stamp = [this] {  // what came in between is a past that is still to be shown
    if (caught_up_++ < caught_up_most) hear(now_s_);
  };
}

void NetworkMatch::press(std::uint32_t, Key key, bool is_down) {
  pressed_.push_back({key, is_down});
}

void NetworkMatch::pause(bool is_wanted) {
  if (client_.state() == Client::State::playing && !settings_.only_watches)
    client_.remote()->pause(is_wanted);
}

void NetworkMatch::rematch() {
  if (client_.state() == Client::State::playing && !settings_.only_watches)
    client_.remote()->ask_rematch();
}

void NetworkMatch::leave(double now_s) {
  has_left_ = true;
  if (client_.ambassador().is_joined()) client_.ambassador().resign();
  link_.flush(now_s);
  link_.close();
}

void NetworkMatch::advance(double now_s) {
  assert(!has_left_);
  if (trouble_.empty()) {
    caught_up_ = 0;
    converse(now_s);
    hear(now_s);
    predict(now_s);
    link_.flush(now_s);
  }
  show(now_s);
  now_s_ = now_s;
}

void NetworkMatch::converse(double now_s) {
  transport_.poll({}, links_);
  if (!joined_s_ && client_.ambassador().is_joined()) joined_s_ = now_s;
  const std::string beginning = joined_s_ ? ""
                                : client_.state() == Client::State::refused
                                    ? "the host refuses: "
                                    : "no answer from the host: ";
  if (client_.state() == Client::State::refused || client_.state() == Client::State::lost)
    lose(beginning + client_.joining().trouble());
  else if (link_.is_finished())
    lose(beginning + "the connection is closed: " + rti::to_string(link_.close_reason()));
  else if (!settings_.only_watches && joined_s_ && now_s > *joined_s_ + match_patience_s &&
           !client_.mirror().has_match())
    lose("no match is hosted there; what goes on can be watched");
  if (!trouble_.empty()) return;
  if (const auto pong = client_.remote()->take_pong())
    clock_.answered(pong->number, pong->server_s, now_s);
  clock_.advance(now_s);
  if (!client_.ambassador().is_joined() || !client_.mirror().has_match()) return;
  if (const auto question = clock_.ask(now_s)) client_.remote()->ping(*question);
}

void NetworkMatch::lose(const std::string& why) {
  trouble_ = why.empty() ? "the connection is lost" : why;
}

void NetworkMatch::hear(double now_s) {
  const Mirror& mirror = client_.mirror();
  if (mirror.counters().updates == heard_updates_) return;
  heard_updates_ = mirror.counters().updates;
  heard_s_ = now_s;
  const double told_s = mirror.newest().time;
  const bool did_run = state_.phase == MatchPhase::playing && told_s > state_.clock_simulated_s;
  if (did_run && rink_ && rink_->has_heard() && match_number_ == mirror.match().number)
    news_.heard(rink_->now(), told_s - mirror.match_tick() - tick_grid);
  state_ = mirror.match();
  if (!read_scene()) return;
  const std::optional<ToldRink> news = told();
  if (!news) return;
  if (!rink_ || match_number_ != state_.number) {
    rink_.emplace(*scene_, player());
    rink_->count_from(client_.keys_sent());
    match_number_ = state_.number;
    delay_ = 0.0;
  }
  rink_->hear(*news);
}

/// Checked before it is read: a population of a stranger's could be of any size.
bool NetworkMatch::read_scene() {
  if (scene_ || !trouble_.empty()) return scene_.has_value();
  const std::string& text = client_.mirror().match_scene();
  if (text.empty()) return false;
  try {
    if (text.find("population") != std::string::npos)
      throw SceneError("a match has no populations");
    Scene scene = parse_scene(text, "match.toml");
    if (const auto objection = match_objection(scene)) throw SceneError(*objection);
    sight_ = sight_of(scene);
    all_things_ = sight_.things;
    scene_ = std::move(scene);
  } catch (const SceneError& error) {
    lose(std::string("the server's scene cannot be played: ") + error.what());
  }
  return scene_.has_value();
}

/// All that is known as of the newest stamp; nothing while a body is still missing, or of an
/// instant that no match reaches.
std::optional<ToldRink> NetworkMatch::told() const {
  const Mirror& mirror = client_.mirror();
  const std::size_t bats = scene_->bodies.bats.size(), pucks = scene_->bodies.pucks.size();
  ToldRink told{.time = mirror.newest().time, .bats = std::vector<ToldBody>(bats), .pucks = {}};
  std::size_t bat_count = 0;
  std::vector<const MirroredEntity*> found;
  for (const MirroredEntity& entity : mirror.entities()) {
    if (is_kind(entity, physics::BodyKind::puck)) found.push_back(&entity);
    if (!is_kind(entity, physics::BodyKind::bat) || entity.shape.team >= bats) continue;
    told.bats[entity.shape.team] = told_of(entity, told.time);
    ++bat_count;
  }
  if (bat_count != bats || found.size() != pucks || std::abs(told.time) > latest_told)
    return std::nullopt;
  std::sort(found.begin(), found.end(),
            [](const MirroredEntity* a, const MirroredEntity* b) { return a->object < b->object; });
  for (const MirroredEntity* puck : found) {
    told.pucks.push_back(told_of(*puck, told.time));
    const double x = told.pucks.back().position.x();
    told.pucks.back().is_in_play = x > 0.0 && x < scene_->world.field.length;
  }
  const MirroredEntity* own = client_.bat();
  told.own_felt = own != nullptr ? own->input.count : 0;
  return told;
}

void NetworkMatch::predict(double now_s) {
  if (!rink_ || !clock_.is_set()) return;
  const double instant = simulated_at(state_, clock_.arrival(now_s));
  const bool does_run =
      state_.phase == MatchPhase::playing || state_.phase == MatchPhase::countdown;
  if (!does_run && instant < rink_->now()) rink_->rewind(instant);
  const double now = std::clamp(instant, rink_->now(),
                                std::max(rink_->now(), rink_->told_time() + foretold_longest_s));
  press_keys(now);
  move_delay(now_s - now_s_);
  rink_->advance(now, delay_);
}

void NetworkMatch::press_keys(double instant) {
  if (client_.state() == Client::State::playing && !settings_.only_watches) {
    const double felt_at = next_on(key_grid, instant);
    for (const PressedKey& pressed : pressed_) {
      pressed.is_down ? client_.press(pressed.key, felt_at) : client_.release(pressed.key, felt_at);
      rink_->press(pressed.key, pressed.is_down, felt_at);
    }
  }
  pressed_.clear();
}

/// Where time stands everything is known, and the other need not be shown late.
void NetworkMatch::move_delay(double dt) {
  const double wanted =
      state_.phase == MatchPhase::playing
          ? news_.delay().value_or(clock_.delay(client_.mirror().match_tick() + tick_grid))
          : 0.0;
  delay_ = std::clamp(wanted, std::max(0.0, delay_ - time_bend * dt), delay_ + time_bend * dt);
}

}  // namespace rink::game
