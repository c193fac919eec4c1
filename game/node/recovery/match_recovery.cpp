// Follows who is the referee, and what it says.
#include "game/node/recovery/match_recovery.h"

#include <algorithm>
#include <cassert>

#include "game/node/node_messages.h"

namespace rink::game {

MatchRecovery::MatchRecovery(const Parts& parts, Hooks hooks)
    : parts_(parts),
      hooks_(std::move(hooks)),
      members_(parts.network, parts.game.start().world(), parts.network.number(),
               parts.network.terms().peer_count, parts.network.terms().is_replicated) {
  members_.follow(
      {.next_mail = [this](peer::PeerNumber from) { return parts_.network.next_mail(from); },
       .referee_words = [this] { return log_.words(); },
       .hear_referee = [this](const RefereeWords& words) { return hear_last(words); },
       .when_recovered = [this] { when_recovered(); },
       .when_left = [this](peer::PeerNumber lost) { release(lost); }});
}

std::optional<bool> MatchRecovery::sort(peer::PeerNumber from,
                                        const std::vector<std::uint8_t>& bytes) {
  if (bytes.size() < node_message_tail) return false;
  if (members_.is_lost(from)) return true;
  if (recoveries_in(bytes) <= parts_.network.recoveries) return std::nullopt;
  if (early_.size() >= early_max) return false;
  early_.emplace_back(from, bytes);
  return true;
}

void MatchRecovery::say(const std::vector<SeatDecision>& decisions) {
  assert(is_referee());
  if (decisions.empty()) return;
  const Numbered<ListOf<SeatDecision>> said{log_.next(), {decisions}};
  tell_others(parts_.network, NodeMessage::seat_decisions, bytes_of(said));
  log_.note(said.number, decisions);
  for (const SeatDecision& decision : decisions) hooks_.decide(decision);
}

void MatchRecovery::say(const MatchNews& news) {
  assert(is_referee());
  const Numbered<MatchNews> said{log_.next(), news};
  tell_others(parts_.network, NodeMessage::match_news, bytes_of(said));
  log_.note(said.number, news);
}

bool MatchRecovery::hear_decisions(peer::PeerNumber from, std::span<const std::uint8_t> content) {
  const auto said = message_from<Numbered<ListOf<SeatDecision>>>(content);
  if (!said || from != members_.referee()) return false;
  if (log_.has(said->number)) return true;
  if (!log_.may_follow(said->number)) return false;
  log_.note(said->number, said->word.words);
  return std::ranges::all_of(said->word.words, hooks_.decide);
}

bool MatchRecovery::hear_news(peer::PeerNumber from, std::span<const std::uint8_t> content) {
  const auto said = message_from<Numbered<MatchNews>>(content);
  if (!said || from != members_.referee()) return false;
  if (log_.has(said->number)) return true;
  if (!log_.may_follow(said->number)) return false;
  log_.note(said->number, said->word);
  return parts_.match.follow(said->word);
}

/// Of the words that another has heard of the referee, this one has heard the first ones.
bool MatchRecovery::hear_last(const RefereeWords& words) {
  const std::uint64_t known = log_.words().count;
  if (words.count > known + early_max || words.news.number > words.count ||
      words.decisions.size() > early_max)
    return false;
  std::uint64_t last = 0;
  for (const Numbered<SeatDecision>& each : words.decisions)
    if (each.number < std::exchange(last, each.number) || each.number > words.count) return false;
  for (const Numbered<SeatDecision>& each : words.decisions) {
    if (each.number <= known) continue;
    if (!hooks_.decide(each.word)) return false;
    log_.add(each);
  }
  const bool are_news = words.news.number > log_.words().news.number;
  if (are_news && !parts_.match.follow(words.news.word)) return false;
  if (are_news) log_.add(words.news);
  log_.adopt(words.count);
  return true;
}

void MatchRecovery::when_recovered() {
  const peer::PeerNumber before = parts_.seats.referee();
  const bool was_referee = before == members_.number();
  parts_.network.recoveries = static_cast<std::uint16_t>(members_.lost_count());
  parts_.seats.follow(members_.referee());
  if (before != members_.referee()) parts_.match.ask_again();
  const double now_s = hooks_.clock_s();
  if (is_referee()) {
    if (!was_referee)
      parts_.match.lead({parts_.seats.is_taken(0), parts_.seats.is_taken(1)}, now_s);
    if (const peer::Session* const session = hooks_.session())
      parts_.match.fall_behind(now_s, session->peer().now());
  }
  for (const peer::PeerNumber lost : members_.newly_lost()) {
    const std::vector<SeatTable::Seated> seated = parts_.seats.lose(lost);
    if (!is_referee()) continue;
    for (const SeatTable::Seated& each : seated)
      // Heard at once: who waits for a bat may ask before this node passes on wishes.
      parts_.seats.hear(members_.number(),
                        {.change = SeatChange::leave, .player = each.player, .token = each.token});
  }
  tell_of_losses();
  for (auto& [from, bytes] : std::exchange(early_, {})) {
    const std::optional<bool> sorted = sort(from, bytes);
    if (!(sorted ? *sorted : hooks_.receive(from, bytes)))
      members_.give_up(from, "sent a side message that no peer sends");
  }
}

void MatchRecovery::tell_of_losses() {
  if (members_.lost_count() == lost_count_) return;
  lost_count_ = members_.lost_count();
  if (!hooks_.notify) return;
  const std::size_t left = members_.left().size();
  hooks_.notify(members_.last_loss() + ": " +
                (left == 1 ? "this peer continues alone" : std::to_string(left) + " peers go on") +
                (members_.may_have_split() ? ", and others may have done so too" : ""));
}

/// Its players' keys are released as if they had left it.
void MatchRecovery::release(peer::PeerNumber lost) {
  peer::Session* const session = hooks_.session();
  if (session == nullptr) return;
  MatchRounds& rounds = parts_.match.rounds();
  for (const std::uint32_t player : parts_.seats.held_in_round(lost))
    rounds.release(parts_.game, player, end_of_window(parts_.network.terms(), rounds.window() + 1),
                   *session);
}

}  // namespace rink::game
