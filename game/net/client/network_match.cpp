// Each frame: receive, predict, press, show, send.
#include "game/net/client/network_match.h"

#include <algorithm>
#include <cassert>

#include "game/match/sight.h"
#include "game/model/time_grid.h"

namespace rink::game {
namespace {

constexpr double predicted_longest_s =
    60.0;  ///< without news, which come every few seconds while anything moves
constexpr std::uint32_t caught_up_most =
    32;  ///< ticks received in one frame, each of which is predicted: half a second's; a host could
         ///< send any number

}  // namespace

ClientSettings NetworkMatch::client_settings(const NetworkMatchSettings& settings) {
  return {.federation = settings.federation,
          .name = settings.name,
          .view_fraction = 1.0,
          .plays_match = true,
          .only_watches = settings.only_watches,
          .timeouts = {.lost_after_s = interruption_max_s}};
}

NetworkMatch::NetworkMatch(const rti::Fom& fom, const ObjectModel& model, rti::Transport& transport,
                           rti::ConnectionId connection, const NetworkMatchSettings& settings)
    : settings_(settings),
      client_(fom, model, client_settings(settings)),
      host_(client_, transport, connection, !settings.only_watches) {
  client_.before_next_stamp = [this] {  // the state in between is a past that is still to be shown
    if (caught_up_++ < caught_up_most) receive(now_s_);
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
  host_.leave(now_s);
}

void NetworkMatch::advance(double now_s) {
  assert(!has_left_);
  if (!host_.is_lost()) {
    caught_up_ = 0;
    host_.converse(now_s);
    receive(now_s);
    predict(now_s);
    host_.flush(now_s);
  }
  show(now_s);
  now_s_ = now_s;
}

void NetworkMatch::receive(double now_s) {
  const ReplicaSet& replicas = client_.replicas();
  if (replicas.counters().updates == received_updates_) return;
  received_updates_ = replicas.counters().updates;
  received_s_ = now_s;
  const double received_s = replicas.newest().time;
  const bool did_run = state_.phase == MatchPhase::playing && received_s > state_.clock_simulated_s;
  if (did_run && rink_ && rink_->has_received() && match_number_ == replicas.match().number)
    delay_.received(rink_->now(), received_s - replicas.match_tick() - tick_grid);
  const bool was_played = state_.phase == MatchPhase::playing;
  state_ = replicas.match();
  if (was_played && state_.phase == MatchPhase::countdown && match_number_ == state_.number &&
      rink_)
    rink_->rewind(state_.clock_simulated_s);  // the host stood still, and goes on from there
  if (!read_scene()) return;
  const std::optional<ReceivedRink> news = scene_.received(replicas, client_.bat());
  if (!news) return;
  if (!rink_ || match_number_ != state_.number) {
    rink_.emplace(*scene_.scene(), player());
    rink_->count_from(client_.keys_sent());
    match_number_ = state_.number;
    hand_.forget();
    delay_.begin();
  }
  rink_->receive(*news);
}

bool NetworkMatch::read_scene() {
  if (scene() != nullptr || host_.is_lost()) return scene() != nullptr;
  const std::string& text = client_.replicas().match_scene();
  if (text.empty()) return false;
  if (const auto objection = scene_.read(text))
    host_.lose("the server's scene cannot be played: " + *objection);
  else sight_ = sight_of(*scene());
  return scene() != nullptr;
}

void NetworkMatch::predict(double now_s) {
  // Of an interrupted match nobody knows how it goes on, so it stands still.
  if (!rink_ || !host_.clock().is_set() || host_.is_interrupted()) return;
  const double instant = simulated_at(state_, host_.clock().arrival(now_s));
  const bool does_run =
      state_.phase == MatchPhase::playing || state_.phase == MatchPhase::countdown;
  if (!does_run && instant < rink_->now()) rink_->rewind(instant);
  const double now = rink_->within_reach(instant, predicted_longest_s);
  press_keys(now);
  move_delay(now_s - now_s_);
  rink_->advance(now, delay_.seconds());
  push_bat(now_s);
}

/// By where the own bat is shown, and felt from this frame on.
void NetworkMatch::push_bat(double now_s) {
  const bool is_felt = state_.phase != MatchPhase::waiting && state_.phase != MatchPhase::over;
  if (!is_felt || !why_keys_alone().empty() || !rink_->has_received()) return;
  const std::optional<Push> push = hand_.next(rink_->own_bat(), now_s);
  if (!push) return;
  const double felt_at = next_on(key_grid, rink_->now());
  client_.remote()->push(*push, felt_at);
  rink_->push(*push, felt_at);
}

std::string NetworkMatch::why_keys_alone() const {
  if (settings_.only_watches || client_.state() != Client::State::playing)
    return "No match is played";
  return state_.takes_keys_alone ? "Hosts that share a match take keys alone" : "";
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

/// While time stands still everything is known, and the other bat needs no delay.
void NetworkMatch::move_delay(double dt) {
  if (state_.phase != MatchPhase::playing) return delay_.move(0.0, dt);
  const double estimate = host_.clock().delay(client_.replicas().match_tick() + tick_grid);
  delay_.move(delay_.measured_or(estimate), dt);
}

}  // namespace rink::game
