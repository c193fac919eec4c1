// Divides a scene, plays its windows, and joins the parts to one hash.
#include "game/net/peer/shared_game.h"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "game/control/free_place.h"
#include "game/model/state_hash.h"
#include "game/net/peer/crowd.h"
#include "game/net/peer/network/seating.h"
#include "im/basics/freed_memory.h"

namespace rink::game {

namespace {

std::vector<InputEvent> merged(std::vector<InputEvent> keys,
                               const std::vector<InputEvent>& further) {
  keys.insert(keys.end(), further.begin(), further.end());
  std::stable_sort(keys.begin(), keys.end(), [](const InputEvent& a, const InputEvent& b) {
    return std::tuple(a.time, a.player) < std::tuple(b.time, b.player);
  });
  return keys;
}

bool has_goals(const Scene& scene) { return scene.world.field.goal_width > 0.0; }

BatController controller_of(const Scene& scene, std::uint32_t player) {
  return BatController(scene.bodies.bats[player].thrust);
}

/// Notifies the user of peers that are gone, and of those that came.
class Membership {
 public:
  Membership(const peer::Session& session, const PartOptions& part_options)
      : session_(session),
        options_(part_options),
        members_(session.members()),
        lost_(session.lost().size()) {}

  void notify() {
    if (!options_.notify || session_.has_left() ||
        (session_.members() == members_ && session_.lost().size() == lost_))
      return;
    for (const peer::PeerNumber peer : members_)
      if (!is_in(session_.members(), peer) && !is_in(session_.lost(), peer))
        options_.notify("peer " + std::to_string(peer) + " has left in good order");
    for (const peer::PeerNumber peer : session_.members())
      if (!is_in(members_, peer))
        options_.notify("peer " + std::to_string(peer) + " joins at " +
                        std::to_string(session_.peer().now()) + " s");
    members_ = session_.members();
    const std::string who = members_.size() == 1 ? "this peer continues alone"
                                                 : std::to_string(members_.size()) + " peers go on";
    if (std::exchange(lost_, session_.lost().size()) != session_.lost().size())
      options_.notify(session_.last_loss() + ": " + who + " from " +
                      std::to_string(session_.peer().now()) + " s");
  }

 private:
  static bool is_in(const std::vector<peer::PeerNumber>& sorted, peer::PeerNumber peer) {
    return std::binary_search(sorted.begin(), sorted.end(), peer);
  }

  const peer::Session& session_;
  const PartOptions& options_;
  std::vector<peer::PeerNumber> members_;
  std::size_t lost_;
};

}  // namespace

std::uint64_t window_count_of(const Terms& terms) {
  constexpr double rounding =
      1e-9;  // a third of a second is no whole number of windows of a thirtieth otherwise
  return static_cast<std::uint64_t>(
      std::max(1.0, std::ceil(terms.until / terms.window - rounding)));
}

double end_of_window(const Terms& terms, std::uint64_t window) {
  const std::uint64_t last = window_count_of(terms);
  return window == last  ? terms.until
         : window > last ? terms.until + terms.window
                         : static_cast<double>(window) * terms.window;
}

SharedGame::SharedGame(Scene scene, const std::vector<InputEvent>& recorded)
    : scene_(std::move(scene)), keys_(merged(scene_.keys, recorded)), start_(scene_) {
  if (scene_.network_grid > 0.0)
    throw SceneError("scene '" + scene_.name +
                     "' has a network_grid, and peers and nodes cannot yet put bodies on one: "
                     "expected network_grid = 0, or a server alone");
  for (const Entity& entity : start_.entities()) {
    extent_max_ = std::max(extent_max_, entity.half_extent.maxCoeff());
    speed_max_ = std::max(speed_max_, start_.velocity(entity.id).norm());
  }
  for (const InputEvent& key : keys_)
    if (key.kind == InputKind::enter || key.kind == InputKind::leave)
      throw SceneError("player " + std::to_string(key.player) +
                       (key.kind == InputKind::enter ? " enters" : " leaves") + " at " +
                       std::to_string(key.time) +
                       " s, and peers cannot yet add or remove bats: expected keys alone");
}

void SharedGame::forget_start() {
  forgotten_ = static_cast<std::uint32_t>(start_.entities().size());
  // Posts and bats come before pucks, so they keep their numbers.
  std::vector<Puck> pucks = std::exchange(scene_.bodies.pucks, {});
  start_ = Game(scene_);
  scene_.bodies.pucks = std::move(pucks);
  give_back_freed_memory();
}

Fingerprint SharedGame::session_fingerprint() const {
  StateHash keys;
  for (const InputEvent& key : keys_)
    keys.add(key.time),
        keys.add(std::uint64_t{key.player} << 32 | static_cast<std::uint64_t>(key.kind) << 8 |
                 static_cast<std::uint64_t>(key.key));
  return {.self_test = peer::self_test_hash(), .scene = fingerprint(scene_), .keys = keys.value()};
}

/// Posts cost nothing, so they do not count.
peer::Cuts SharedGame::cuts(peer::PeerNumber peer_count) const {
  std::vector<Vector2> places;
  for (const Entity& entity : start_.entities())
    if (entity.kind != physics::BodyKind::post) places.push_back(start_.position(entity.id));
  return peer::Cuts::by_count(scene_.world.field, std::move(places), peer_count);
}

/// The size of two large bodies side by side, and the flight of the fastest in a window; peers
/// adapt it while they play.
double SharedGame::first_halo(double window) const {
  return 4.0 * extent_max_ + 2.0 * speed_max_ * window + 1e-3;
}

/// As Game's: on the spot of the side that conceded, or at the nearest free place.
std::optional<peer::GoalRules> SharedGame::goal_rules(double window) const {
  if (!has_goals(scene_)) return std::nullopt;
  const MatchRules& rules = scene_.rules;
  static_assert(MatchRules::possession_min >= Game::placement_retry);
  const double shortest = std::min(rules.face_off_delay, Game::placement_retry);
  if (window > shortest)
    throw SceneError("scene '" + scene_.name + "' has pucks come back " + std::to_string(shortest) +
                     " s after they could not, or after a goal, and windows are " +
                     std::to_string(window) + " s long: expected shorter ones");
  const physics::Field field = scene_.world.field;
  const double from_end = rules.face_off_distance * field.length;
  return peer::GoalRules{.goals_to_win = rules.goals_to_win,
                         .face_off_delay = rules.face_off_delay,
                         .placement_retry = Game::placement_retry,
                         .possession = rules.possession_s,
                         .places = [field, from_end](bool is_left, double radius, std::size_t first,
                                                     std::size_t count) {
                           return places_for_disc(
                               field,
                               {is_left ? from_end : field.length - from_end, field.width / 2},
                               radius, first, count);
                         }};
}

void SharedGame::require_divisible() const {
  if (scene_.rules.possession_s > 0.0)
    throw SceneError("scene '" + scene_.name +
                     "' has possession_s, which only peers keep that play the whole of a match of "
                     "two: expected none");
}

std::vector<peer::Key> SharedGame::thrusts() const {
  std::vector<BatController> players;
  for (std::uint32_t k = 0; k < start_.player_count(); ++k)
    players.push_back(controller_of(scene_, k));
  std::vector<peer::Key> keys;
  for (const InputEvent& event : keys_) {
    players[event.player].press(event.key, event.kind == InputKind::key_down);
    keys.push_back({event.time, start_.bat(event.player)->index, players[event.player].thrust()});
  }
  return keys;
}

std::uint64_t SharedGame::hash(std::uint64_t world, std::span<const InputEvent> keys, double until,
                               const peer::Scoring& scoring) const {
  std::vector<BatController> players;
  for (std::uint32_t k = 0; k < start_.player_count(); ++k)
    players.push_back(controller_of(scene_, k));
  for (const InputEvent& event : keys)
    if (event.time <= until)
      players[event.player].press(event.key, event.kind == InputKind::key_down);
  std::vector<const BatController*> hands(players.size());
  std::ranges::transform(players, hands.begin(), [](const BatController& each) { return &each; });
  std::vector<Entity> all(start_.entities().begin(), start_.entities().end());
  for (auto number = static_cast<std::uint32_t>(all.size()); number < forgotten_; ++number)
    all.push_back({.id = {number}, .player = std::nullopt});
  StateHash hash = begun_game_hash(world, all, hands, {scoring.left, scoring.right});
  for (const peer::FaceOff& due : scoring.face_offs)
    hash.add(due.time), hash.add(std::uint64_t{due.puck});
  add_stays(hash, scoring.halves.stays());
  return hash.value();
}

std::vector<peer::Player> SharedGame::players(const Terms& terms,
                                              std::span<const PeerInfo> peer_infos) const {
  std::vector<peer::Player> players;
  std::vector<std::uint8_t> is_taken(start_.player_count(), 0);
  for (peer::PeerNumber number = 0;
       number < std::min<std::size_t>(terms.peer_count, peer_infos.size()); ++number) {
    for (std::uint64_t player = peer_infos[number].first_bat,
                       end = player + peer_infos[number].bat_count;
         player < end; ++player)
      if (player >= is_taken.size() || std::exchange(is_taken[player], std::uint8_t{1}) != 0)
        throw peer::ProtocolError("peer " + std::to_string(number) + " plays bat " +
                                  std::to_string(player) + ", which is taken or not there");
    players.push_back({number, peer_infos[number].first_bat, peer_infos[number].bat_count,
                       peer_infos[number].puck_count, peer_infos[number].hand_count});
  }
  return players;
}

std::vector<peer::Seat> SharedGame::seats(const peer::Player& player) const {
  if (player.bat_count > start_.player_count() ||
      player.first_bat > start_.player_count() - player.bat_count)
    throw peer::ProtocolError("peer " + std::to_string(player.peer) +
                              " plays bats that are not there");
  std::vector<peer::Seat> seats;
  for (std::uint32_t k = player.first_bat; k < player.first_bat + player.bat_count; ++k) {
    const bool is_hand = k < player.first_bat + player.hand_count;
    seats.push_back({.bat = start_.bat(k)->index,
                     .peer = player.peer,
                     .period = is_hand ? 0.0 : decision_period,
                     .phase = decision_phase(k),
                     .puck_count = player.puck_count});
  }
  return seats;
}

std::unique_ptr<peer::Peer> SharedGame::peer(const peer::Division& division,
                                             peer::PeerNumber number, double window) const {
  if (has_goals(scene_))
    throw SceneError("scene '" + scene_.name +
                     "' has goals (field.goal_width), which only peers of a session count: "
                     "expected a scene without, such as arena");
  const physics::World& whole = start_.world();
  auto peer = std::make_unique<peer::Peer>(whole.spec(), division, number, whole.body_count(),
                                           first_halo(window));
  peer->validate_by(peer::Validator(whole));
  for (std::uint32_t body = 0; body < whole.body_count(); ++body)
    peer->consider(body, physics::Subdomain::state_in(whole, body));
  for (const peer::Key& key : thrusts()) peer->press_first(key);
  return peer;
}

/// The keys of all peers together.
std::vector<InputEvent> SharedGame::keys_with(std::span<const peer::Handover> logs) const {
  std::vector<InputEvent> keys;
  for (const peer::Handover& log : logs)
    for (const peer::Key& key : log.keys) {
      if (!start_.is_there({key.bat}) || !start_.entity({key.bat}).player || key.input == 0)
        throw peer::ProtocolError("a log has keys of body " + std::to_string(key.bat) +
                                  ", which has no player");
      keys.push_back(event_of(key.input, key.time, *start_.entity({key.bat}).player));
    }
  return merged(keys_, keys);
}

PlayedPart SharedGame::play(const Terms& terms, std::span<const PeerInfo> peer_infos,
                            peer::PeerNumber number, peer::Mail& mail,
                            const PartOptions& part_options) const {
  if (terms.peer_count > 1 || terms.is_replicated) require_divisible();
  peer::SessionSettings settings{.number = number,
                                 .peer_count = terms.peer_count,
                                 .halo = first_halo(terms.window),
                                 .is_replicated = terms.is_replicated,
                                 .end_of = {}};
  settings.window_count = window_count_of(terms);
  settings.end_of = [terms](std::uint64_t window) { return end_of_window(terms, window); };
  settings.balance_windows = terms.balance_windows;
  settings.keys = thrusts();
  settings.goals = goal_rules(terms.window);
  settings.bat_count = has_keys() ? 0 : start_.player_count();
  settings.takes_latecomers = part_options.takes_latecomers;
  settings.seats_of = [this](const peer::Player& player) { return seats(player); };
  // Views and updates are in order with claims and handovers alone.
  settings.keeps_to_neighbours = part_options.observer == nullptr;
  // What a node tells of a window comes before its next verdict, from which others go on.
  if (part_options.takes_latecomers) settings.tree_from = peer::members_max + 1;
  if (part_options.observer != nullptr) {
    settings.hooks.when_played = [&part_options] { part_options.observer->when_played(); };
    settings.hooks.when_told = [&part_options] { part_options.observer->when_told(); };
    settings.hooks.when_sending = [&part_options](peer::Subject about) {
      part_options.observer->when_sending(about);
    };
  }
  if (terms.is_seated && terms.peer_count > start_.player_count())
    throw peer::ProtocolError(
        "there are more peers than bats, and each is to have one in its zone");
  // A copy: the list grows while a newcomer waits to be admitted.
  const PeerInfo self = peer_infos[number];  // NOLINT(performance-unnecessary-copy-initialization)
  if (part_options.members.empty()) settings.players = players(terms, peer_infos);
  settings.is_stopped = part_options.is_stopped;
  std::optional<peer::Session> made;
  if (LossParticipant* const losses = part_options.losses)
    settings.losses = {
        .when_taken_over =
            [losses](peer::PeerNumber lost, const peer::Part& part,
                     std::span<const peer::Key> keys) { losses->take_over(lost, part, keys); },
        .when_entered = [losses, &made](peer::Peer& peer) { losses->seat_again(*made, peer); },
        .when_recovered =
            [losses, &made](std::span<const peer::Key> pending) {
              losses->go_back(*made, pending);
            }};
  if (part_options.participant != nullptr)
    settings.when_committed = [&] {
      if (made) part_options.participant->after_stretch(*made);
    };
  if (part_options.members.empty())
    made.emplace(
        start_.world(),
        terms.is_seated ? seated_division(start_, terms.peer_count).cuts : cuts(terms.peer_count),
        std::move(settings), mail, part_options.when_taken);
  else made.emplace(start_.world(), std::move(settings), mail, part_options.members);
  peer::Session& session = *made;
  Crowd crowd(scene_, start_,
              {.kinds = part_options.players,
               .seed = scene_.seed,
               .first = self.first_bat + self.hand_count,
               .count = self.bat_count - self.hand_count,
               .from = session.peer().now(),
               .until = terms.until});
  Membership membership(session, part_options);
  if (!part_options.members.empty() && part_options.notify)
    part_options.notify("peer " + std::to_string(number) + " is in from " +
                        std::to_string(session.peer().now()) + " s");
  if (part_options.observer != nullptr) part_options.observer->begin(session);
  const auto play_on = [&] {
    while (!session.is_over()) {
      if (part_options.before_window) part_options.before_window(session.peer().now());
      if (part_options.wants_to_leave && terms.is_replicated && part_options.wants_to_leave())
        session.leave();
      if (part_options.participant != nullptr) part_options.participant->before_window(session);
      session.advance();
      membership.notify();
      if (part_options.observer != nullptr) part_options.observer->when_stepped();
      if (part_options.participant != nullptr) part_options.participant->after_window(session);
      crowd.act(session);
    }
  };
  play_on();
  if (part_options.observer != nullptr) part_options.observer->end();
  PlayedPart part;
  part.has_left = session.has_left();
  // A peer that left in good order is no member of the last window.
  part.was_last =
      part.has_left && session.members().size() == 1 && session.members().front() == number;
  while (!session.has_left() && !end(session, part)) play_on();
  part.has_left = session.has_left();
  membership.notify();
  part.members = session.members().size();
  part.counters = session.counters();
  part.may_have_split = session.may_have_split();
  part.lost = session.lost();
  part.time = session.peer().now();
  part.owned = session.peer().owned().size(), part.ghosts = session.peer().ghosts().size(),
  part.halo = session.peer().halos().own();
  part.presses = crowd.presses();
  return part;
}

KeyLog SharedGame::record_of(const PlayedPart& part, const std::string& scene_text) const {
  KeyLog log = key_log_for(scene_);
  log.scene_text = scene_text;
  log.until = part.time;
  log.hash = part.hash;
  log.events = part.keys;
  // The scene has these keys.
  for (const InputEvent& scripted : scene_.keys)
    if (const auto found = std::find(log.events.begin(), log.events.end(), scripted);
        found != log.events.end())
      log.events.erase(found);
  return log;
}

/// All peers have exchanged their parts and their players' keys. False if the last window was
/// undone instead.
bool SharedGame::end(peer::Session& session, PlayedPart& part) const {
  std::vector<peer::Handover> parts = session.end();
  if (session.has_left()) return true;
  if (parts.empty()) return false;
  const physics::PartWorld& own = session.peer().world();
  const auto world = peer::hash_of_whole(own.spec(), own.body_count(), parts);
  if (!world) throw peer::ProtocolError("not every body has one owner in the end");
  part.result_bytes = measured(parts[session.peer().number()]) * (session.members().size() - 1);
  part.keys = keys_with(parts);
  part.hash = hash(*world, part.keys, session.peer().now(), session.scoring());
  part.score = {session.scoring().left, session.scoring().right};
  return true;
}

}  // namespace rink::game
