// Plays the windows of a node's own part, and tells the other nodes what changed in each.
#include "game/node/node.h"

#include <algorithm>
#include <cassert>
#include <string>
#include <utility>

#include "game/net/interrupt.h"
#include "game/net/late_players.h"
#include "game/net/peer/crowd.h"
#include "game/net/peer/network/unguessable_number.h"
#include "game/net/peer/start_together.h"
#include "game/peer/message_bytes.h"

namespace rink::game {
namespace {

PartTeller teller_of(const SessionNetwork& network, const Game& start) {
  const Terms& terms = network.terms();
  PartTeller teller(start.world().spec().field, start.world().body_count(), terms.peer_count,
                    network.number());
  for (peer::PeerNumber to = 0; to < terms.peer_count; ++to) {
    const PeerInfo& info = network.peer_infos()[to];
    for (std::uint32_t player = info.first_bat; player < info.first_bat + info.bat_count; ++player)
      teller.seat(to, start.bat(player)->index);
  }
  return teller;
}

std::string late_refusal(const NodeSettings& settings) {
  const std::string refusal = "they play already, and none can join them any more";
  if (!settings.players_place) return refusal;
  return refusal + "; " + late_players_come_to + settings.players_place();
}

/// If it fails, the other nodes that wait are told why there is no game.
void gather(SessionNetwork& network) {
  try {
    network.gather();
  } catch (const SessionError& error) {
    network.leave({FarewellKind::trouble, error.what()});
    throw;
  }
}

}  // namespace

Node::Node(SharedGame& game, Meeting& meeting, const NodeSettings& settings, double (*now_s)())
    : game_(game),
      meeting_(meeting),
      settings_(settings),
      now_s_(now_s),
      subscription_(game.scene().world.field, settings.reach) {
  if (game.has_keys())
    throw SceneError("scene '" + game.scene().name +
                     "' has keys of its own, and nodes play those of their clients: expected one "
                     "without");
  if (!settings.hosting) game.require_divisible();
}

void Node::meet() {
  assert(!thread_.joinable());
  const PeerInfo own{.place = {},
                     .bat_count = settings_.player_count,
                     .hand_count = settings_.player_count,
                     .token = unguessable_number()};
  network_ = meeting_.enter({.self = own,
                             .bats = game_.bat_count(),
                             .session_fingerprint = fingerprint_of_nodes(game_),
                             .session = unguessable_number(),
                             .patience_s = settings_.patience_s,
                             .late_refusal = [this] { return late_refusal(settings_); },
                             .gathering_s = settings_.gathering_s,
                             .must_end = [this] { return is_interrupted != 0 || must_end_; }},
                            now_s_);
  game_.require_window(terms().window);
  gather(*network_);
  const std::string scheme = settings_.hosting ? matches_scheme : nodes_scheme;
  const bool may_have_copies = meeting_.survives_losses();
  if (terms().interest.scheme != scheme || terms().is_seated || number() >= terms().peer_count ||
      terms().is_replicated > may_have_copies)
    throw SessionError(ExitStatus::not_admitted,
                       "the first node gave terms that these nodes do not have: expected " +
                           scheme + (may_have_copies ? "" : " without standby copies"));
  game_.players(terms(), network_->peer_infos());  // or a greeting could name another's bats
  players_.emplace(game_, first_player(), player_count());
  const bool may_go_back = terms().is_replicated && !settings_.hosting;
  if (may_go_back) players_->keep_unfelt();
  if (settings_.hosting) match_.emplace(*settings_.hosting);
  SeatTable table(game_.bat_count(), settings_.hosting ? 0.0 : settings_.absence_s);
  for (peer::PeerNumber node = 0; node < terms().peer_count; ++node)
    table.assign(node, network_->peer_infos()[node].first_bat,
                 network_->peer_infos()[node].bat_count);
  seats_.emplace(std::move(table), number(), terms().peer_count, may_go_back);
  feed_.emplace(match_ ? 1 : terms().peer_count, end_of_window(terms(), 1));
  if (!match_) {
    receiver_.emplace(game_.start().world(), terms(), number(), *feed_);
    teller_.emplace(teller_of(*network_, game_.start()));
  }
  recovery_.emplace(NodeRecovery::Parts{*network_, game_, *feed_, receiver_, teller_, *seats_,
                                        *players_, subscription_},
                    [this](peer::PeerNumber from, const std::vector<std::uint8_t>& bytes) {
                      return receive(from, bytes);
                    });
  if (match_)
    recovery_->host({.clock_s = [this] { return clock_s(); },
                     .session = [this] { return session_; },
                     .decide = [this](const SeatDecision& each) { return receive(each); },
                     .receive = {},
                     .notify = settings_.notify},
                    *match_);
  thread_ = std::thread([this] { run(); });
}

Node::~Node() {
  must_end_ = true;
  if (thread_.joinable()) thread_.join();
}

void Node::run() {
  try {
    wait_for([this] { return is_ready_.load(); });
    const double start_s = start_together(*network_, now_s_) + start_lead_s;
    network_->receive_aside = [this](peer::PeerNumber from,
                                     const std::vector<std::uint8_t>& bytes) {
      return receive(from, bytes);
    };
    network_->begin();
    start_s_ = start_s;
    wait_for([this] { return has_begun(); });
    if (match_) host();
    else play();
    network_->leave({});
  } catch (const std::exception& error) {
    outcome_.failure = std::current_exception();
    network_->leave(
        {is_interrupted != 0 ? FarewellKind::interrupted : FarewellKind::trouble, error.what()});
  }
  outcome_.has_ended = true;
}

void Node::wait_for(const std::function<bool()>& is_there) {
  while (!is_there()) {
    if (is_interrupted != 0 || must_end_)
      throw SessionError(ExitStatus::interrupted, "interrupted while no game was played");
    network_->rest_until(now_s_() + look_s);
  }
}

/// A match needs the start again when the next one begins.
void Node::play() {
  PartOptions options;
  options.before_window = [this](double time) {
    network_->note_window();
    if (!match_) network_->rest_until(start_s_ + time);
  };
  options.participant = this;
  options.notify = settings_.notify;
  if (terms().is_replicated && !match_) options.losses = &*recovery_;
  options.takes_latecomers = true;
  if (!match_)
    network_->before_wait = [this] {
      pass_on_keys();
      return now_s_() + look_s;
    };
  if (match_) options.is_stopped = [this](std::uint64_t window) { return match_->is_last(window); };
  else options.when_taken = [this] { game_.forget_start(); };
  outcome_.part = match_
                      ? play_whole(options)
                      : game_.play(terms(), network_->peer_infos(), number(), *network_, options);
  session_ = nullptr;
}

bool Node::may_begin() {
  check();
  is_ready_ = true;
  return start_s_ > 0.0;
}

void Node::before_window(peer::Session& session) {
  session_ = &session;
  if (is_interrupted != 0 || must_end_) throw SessionError(ExitStatus::interrupted, "interrupted");
  recovery_->follow();
  if (match_) await_match_window(session);
  if (session.step() == 0) {
    session.peer().keep_changes();
    if (!match_) teller_->begin(session.peer());
    for (const auto& [player, node] : seats_->holders())
      take_over({.node = node, .player = player}, session);
  }
  agree_on_seats(session);
  pass_on_keys();
  if (match_) {
    match_->rounds().exchange(recovery_->matches()->members(), game_, *seats_, session);
    return recovery_->matches()->finish_round();
  }
  const std::optional<Cells> cells = subscription_.take();
  if (!cells) return;
  WantedCells wanted{
      .step = feed_->count(number()) + 1, .side = cells->side(), .runs = cells->runs()};
  tell_others(*network_, NodeMessage::wanted_cells, peer::bytes_from(wanted));
}

void Node::pass_on_wishes() {
  ListOf<SeatWish> wishes{seats_->take_wishes()};
  if (const peer::PeerNumber referee = seats_->referee(); number() == referee)
    for (const SeatWish& wish : wishes.words) seats_->hear(referee, wish);
  else if (!wishes.words.empty())
    say(*network_, referee, NodeMessage::seat_wishes, bytes_of(std::move(wishes)));
  if (!match_) return;
  for (const MatchWish& wish : match_->take_wishes())
    if (const peer::PeerNumber referee = seats_->referee(); number() == referee)
      match_->apply(wish, clock_s());
    else say(*network_, referee, NodeMessage::match_wish, bytes_of(wish));
}

void Node::pass_on_keys() {
  if (session_ == nullptr || session_->is_recovering()) return;
  for (auto& [owner, keys] : players_->take(*session_, match_.has_value()))
    if (match_)
      for (const peer::Press& key : keys.words) match_->rounds().press(key);
    else if (owner != number()) say(*network_, owner, NodeMessage::keys, bytes_of(std::move(keys)));
    else session_->peer().receive(owner, keys.words);
}

void Node::decide_seats(std::uint64_t instant, double now_s) {
  if (number() != seats_->referee() || !recovery_->is_settled()) return;
  const ListOf<SeatDecision> decisions{seats_->decide(instant, now_s)};
  if (!match_) {
    if (!decisions.words.empty())
      tell_others(*network_, NodeMessage::seat_decisions, bytes_of(decisions));
    for (const SeatDecision& decision : decisions.words) receive(decision);
    return;
  }
  recovery_->matches()->say(decisions.words);
  for (const std::uint32_t player : {0u, 1u})
    match_->take_part(player, seats_->is_taken(player), clock_s());
}

/// Decisions of the referee hold after the window that is now played: then all have its claims, and
/// with them the decisions, which it sends before.
void Node::agree_on_seats(peer::Session& session) {
  const std::uint64_t instant =
      NodeSeats::instant_of(match_ ? match_->begun() : 0, session.window());
  pass_on_wishes();
  if (!match_) decide_seats(instant + 1, session.peer().now());
  for (const SeatDecision& decision : seats_->due(instant, session.peer().now()))
    take_over(decision, session);
}

void Node::take_over(const SeatDecision& decision, peer::Session& session) {
  if (decision.player == no_player || decision.change != SeatChange::enter) return;
  const std::uint32_t bat = game_.start().bat(decision.player)->index;
  if (!match_) teller_->seat(decision.node, bat);
  session.peer().players().move_seat({.bat = bat,
                                      .peer = match_ ? session.peer().number() : decision.node,
                                      .period = 0.0,
                                      .puck_count = 0});
  if (decision.node == number()) players_->seat(decision.player);
  else players_->unseat(decision.player);
}

void Node::after_stretch(const peer::Session& session) {
  peer::PartChange change = session.peer().change(false);
  change.step = session.step();
  change.gone.clear(), change.keys.clear();
  // A post changes hands where zones shift; all have it where it always is.
  std::erase_if(change.bodies, [&](const peer::Handover::Body& body) {
    return session.peer().world().kind({body.number}) == physics::BodyKind::post;
  });
  feed_->expect(session.scoring(), session.peer().end());
  if (match_) return feed_->add(0, std::move(change));
  change.step = feed_->count(number()) + 1;  // without recoveries
  teller_->look(session.peer(), change, session.is_over());
  for (peer::PeerNumber to = 0; to < terms().peer_count; ++to)
    if (to != number())
      say(*network_, to, NodeMessage::change, teller_->bytes_for(to, session.peer(), change));
  recovery_->finish_window(std::move(change), session);
}

/// False for what no node says.
bool Node::receive(peer::PeerNumber from, const std::vector<std::uint8_t>& bytes) {
  if (const std::optional<bool> answer = recovery_->sort(from, bytes)) return *answer;
  const auto content = content_of(bytes);
  switch (kind_of(bytes)) {
    case NodeMessage::change: {
      peer::PartChange change;
      return !match_ && session_ != nullptr && read(content, change) &&
             recovery_->receive(from, std::move(change));
    }
    case NodeMessage::wanted_cells: {
      WantedCells wanted;
      return !match_ && peer::read_whole(content, wanted) && teller_->follow(from, wanted);
    }
    case NodeMessage::seat_wishes: {
      const auto wishes = message_from<ListOf<SeatWish>>(content);
      return wishes && std::ranges::all_of(wishes->words, [&](const SeatWish& wish) {
               return seats_->hear(from, wish);
             });
    }
    case NodeMessage::seat_decisions: {
      if (match_) return recovery_->matches()->hear_decisions(from, content);
      const auto decisions = message_from<ListOf<SeatDecision>>(content);
      return from == seats_->referee() && decisions &&
             std::ranges::all_of(decisions->words,
                                 [this](const SeatDecision& each) { return receive(each); });
    }
    case NodeMessage::keys: {
      const auto keys = message_from<ListOf<peer::Press>>(content);
      if (!keys || match_) return false;
      // Else all has been played here.
      if (session_ != nullptr) session_->peer().receive(from, keys->words);
      return true;
    }
    case NodeMessage::match_wish: {
      const auto wish = message_from<MatchWish>(content);
      if (!wish || !match_ || number() != seats_->referee()) return false;
      match_->apply(*wish, clock_s());
      return true;
    }
    case NodeMessage::match_news:
      return match_ && recovery_->matches()->hear_news(from, content);
    case NodeMessage::stand_in:
      break;  // it was sorted out
  }
  return false;
}

/// Where a loss may undo it a player is seated once it holds, else before the answer reaches it:
/// its keys wait until the owner of its bat has the decision, too.
bool Node::receive(const SeatDecision& decision) {
  if ((match_ || !terms().is_replicated) && decision.change == SeatChange::enter &&
      decision.node == number() && decision.player < game_.bat_count())
    players_->seat(decision.player);
  return seats_->hear(decision);
}

const PlayedPart& Node::finish() {
  if (thread_.joinable()) thread_.join();
  check();
  return outcome_.part;
}

void Node::check() {
  if (outcome_.has_ended && outcome_.failure) std::rethrow_exception(outcome_.failure);
}

}  // namespace rink::game
