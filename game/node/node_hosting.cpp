// Hosts matches with other nodes, one session each: the referee keeps to the rules, and while it
// waits with a window all wait.
#include <algorithm>
#include <array>

#include "game/node/node.h"

namespace rink::game {
namespace {

/// What a part that each has played alone does not know.
void note_losses(const MatchMembers& members, PlayedPart& part) {
  part.members = members.left().size();
  part.may_have_split = members.may_have_split();
  for (peer::PeerNumber node = 0; node < members.count(); ++node)
    if (members.is_lost(node)) part.lost.push_back(node);
}

/// The others have left, and a match has not its two players.
bool is_alone(const MatchMembers& members, const NodeSeats& seats) {
  return members.count() > 1 && members.left().size() == 1 &&
         !(seats.is_taken(0) && seats.is_taken(1));
}

}  // namespace

/// The referee decides nothing more that holds from a session's start once it has called all to it.
void Node::host() try {
  MatchRecovery& recovery = *recovery_->matches();
  network_->before_wait = [this, &recovery] {
    if (recovery.members().is_recovering()) return now_s_() + look_s;
    pass_on_wishes(), pass_on_keys();
    const auto news = recovery.is_referee() ? match_->advance(clock_s()) : std::nullopt;
    if (news) recovery.say(*news);
    return now_s_() + look_s;
  };
  for (;;) {
    const std::uint64_t next = NodeSeats::instant_of(match_->begun() + 1, 0);
    bool is_deserted = false;  // and nobody can come to a node that has no place for players
    wait_for([this, next, &recovery, &is_deserted] {
      recovery.members().look();
      if (match_->begins()) return true;
      decide_seats(next, clock_s());
      is_deserted =
          !settings_.players_place && match_->begun() > 0 && is_alone(recovery.members(), *seats_);
      if (is_deserted) return true;
      if (recovery.is_referee() && match_->wants_session()) match_->call_session();
      return false;
    });
    if (is_deserted) return note_losses(recovery.members(), outcome_.part);
    seats_->due(next);
    players_->begin_session(seats_->own());
    feed_->begin_session(end_of_window(terms(), 1));
    match_->begin_session();
    play();
    match_->rounds().confirm(recovery.members(), outcome_.part.hash);
    recovery.finish_round();
    match_->end_session(outcome_.part.time, feed_->count(0));
    const Score& score = outcome_.part.score;
    std::optional<Team> winner;
    if (std::max(score.left, score.right) >= game_.scene().rules.goals_to_win.value_or(0))
      winner = score.left > score.right ? Team::left : Team::right;
    if (winner) match_->note_won(*winner, outcome_.part.time);
    if (recovery.is_referee()) match_->follow_win();
    if (!is_one_match(terms())) continue;
    match_->close(winner);
    return note_losses(recovery.members(), outcome_.part);
  }
} catch (const SessionError& error) {
  if (error.status() != ExitStatus::interrupted ||
      !recovery_->matches()->members().may_have_split())
    throw;
  throw SessionError(ExitStatus::may_have_split,
                     "this node went on alone, and the other may have done so too: what it has "
                     "played since is that of one part");
}

/// Each node plays the whole of a match, as one peer that is alone.
PlayedPart Node::play_whole(const PartOptions& options) {
  Terms alone = terms();
  alone.peer_count = 1, alone.balance_windows = 0, alone.is_replicated = false;
  return game_.play(alone, std::array{PeerInfo{}}, 0, *network_, options);
}

/// A pause is waited for here, so that keys that are pressed in it go with the next window. A match
/// that was given up ends with one more window, for others may have begun it.
void Node::await_match_window(const peer::Session& session) {
  const double begin = session.peer().now();
  MatchRecovery& recovery = *recovery_->matches();
  for (;; network_->rest_until(now_s_() + look_s)) {
    if (is_interrupted != 0 || must_end_)
      throw SessionError(ExitStatus::interrupted, "interrupted");
    recovery.members().look();
    decide_seats(NodeSeats::instant_of(match_->begun(), session.window() + 1), clock_s());
    if (recovery.is_referee() && match_->is_given_up()) match_->end_after(session.window() + 1);
    network_->before_wait();  // the news goes before the window's round
    // Who has said its round waits in it, and can't decide anything before it is over.
    if (!recovery.is_referee() && recovery.members().has_said(recovery.members().referee())) return;
    const MatchNews& news = match_->news();
    if (news.last_window != 0 || (!recovery.is_referee() && news.is_given_up())) return;
    const double wait_s = begin - simulated_at(news.state, clock_s());
    if (news.state.phase == MatchPhase::playing && wait_s <= look_s)
      return network_->rest_until(now_s_() + wait_s);
  }
}

}  // namespace rink::game
