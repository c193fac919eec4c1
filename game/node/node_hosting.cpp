// Hosts matches with other nodes, one session each: node 0 keeps to the rules, and while it waits
// with a window all wait.
#include <algorithm>
#include <array>

#include "game/node/node.h"

namespace rink::game {

/// Node 0 decides nothing more that holds from a session's start once it has called all to it.
void Node::host() {
  network_->before_wait = [this] {
    pass_on_wishes(), pass_on_keys();
    const auto news = number() == 0 ? match_->advance(clock_s()) : std::nullopt;
    if (news) tell_others(*network_, NodeMessage::match_news, bytes_of(*news));
    return now_s_() + look_s;
  };
  for (;;) {
    const std::uint64_t next = NodeSeats::instant_of(match_->begun() + 1, 0);
    wait_for([this, next] {
      if (match_->begins()) return true;
      decide_seats(next, clock_s());
      if (number() == 0 && match_->wants_session()) match_->call_session();
      return false;
    });
    seats_->due(next);
    players_->begin_session(seats_->own());
    feed_->begin_session(end_of_window(terms(), 1));
    match_->begin_session();
    play();
    match_->rounds().confirm(*network_, *seats_, outcome_.part.hash);
    match_->end_session(outcome_.part.time, feed_->count(0));
    const std::uint32_t wanted = game_.scene().rules.goals_to_win.value_or(0);
    if (number() == 0 && std::max(outcome_.part.score.left, outcome_.part.score.right) >= wanted)
      match_->win(outcome_.part.score.left > outcome_.part.score.right ? Team::left : Team::right,
                  outcome_.part.time);
  }
}

/// Each node plays the whole of a match, as one peer that is alone.
PlayedPart Node::play_whole(const PartOptions& options) {
  Terms alone = terms();
  alone.peer_count = 1, alone.balance_windows = 0;
  return game_.play(alone, std::array{PeerInfo{}}, 0, *network_, options);
}

/// A pause is waited for here, so that keys that are pressed in it go with the next window. A match
/// that was given up ends with one more window, for others may have begun it.
void Node::await_match_window(const peer::Session& session) {
  const double begin = session.peer().now();
  for (;; network_->rest_until(now_s_() + look_s)) {
    decide_seats(NodeSeats::instant_of(match_->begun(), session.window() + 1), clock_s());
    if (number() == 0 && match_->is_given_up()) match_->end_after(session.window() + 1);
    network_->before_wait();  // the news goes before the window's round
    const MatchNews& news = match_->news();
    if (news.last_window != 0 || (number() != 0 && news.is_given_up())) return;
    const double wait_s = begin - simulated_at(news.state, clock_s());
    if (news.state.phase == MatchPhase::playing && wait_s <= look_s)
      return network_->rest_until(now_s_() + wait_s);
  }
}

}  // namespace rink::game
