// Takes peers' frames, and tells who is gone.
#include "game/net/peer/network/peer_conversation.h"

#include <algorithm>
#include <cassert>
#include <utility>

#include "game/net/peer/network/peer_interrupted.h"
#include "im/basics/printable.h"

namespace rink::game {

namespace {

bool is_here(const PeerLink& link) {
  return link.role == LinkRole::peer && link.is_open && !link.is_closed;
}

}  // namespace

PeerConversation::PeerConversation(PeerLinks& links, const PeerRoster& roster, PeerLosses& losses)
    : links_(links), roster_(roster), losses_(losses) {}

bool PeerConversation::handle(rti::ConnectionId connection, PeerLink& link, Frame frame) {
  assert(link.role == LinkRole::peer);
  switch (frame.kind) {
    case FrameKind::mail:
      link.inbox.push_back(std::move(frame.content));
      return !link.is_done;
    case FrameKind::aside:
      return take_aside(link, std::move(frame));
    case FrameKind::sign:
      return frame.content.empty();
    case FrameKind::farewell:
      return take_farewell(connection, link, frame);
    case FrameKind::refusal:
      return be_sent_away(link, frame);
    default:
      return false;
  }
}

/// Without interest beyond the peers' parts there are no side messages; with it no sender is
/// further ahead of its receivers than a window.
bool PeerConversation::take_aside(const PeerLink& link, Frame frame) {
  return roster_.terms().interest.is_wanted() &&
         deferred_.add(link.number, std::move(frame.content)) && !link.is_done;
}

bool PeerConversation::take_farewell(rti::ConnectionId connection, PeerLink& link,
                                     const Frame& frame) {
  const auto farewell = message_from<Farewell>(frame.content);
  if (!farewell) return false;
  link.is_done = true;
  // A peer that leaves with consent waits for this message.
  if (link.is_parted) links_.send(connection, FrameKind::farewell, bytes_of(Farewell{}));
  link.was_interrupted = farewell->kind == FarewellKind::interrupted;
  if (link.was_interrupted)
    losses_.lose(
        link, ExitStatus::connection_lost,
        name_of(link) + " was interrupted" + (losses_.are_survived() ? "" : ", so all end"));
  if (farewell->kind == FarewellKind::trouble)
    losses_.lose(link, ExitStatus::connection_lost,
                 name_of(link) + " ended: " + printable(farewell->reason, reason_shown_max));
  return true;
}

/// Only who joins a running game can be sent away.
bool PeerConversation::be_sent_away(const PeerLink& link, const Frame& frame) {
  const auto refused = message_from<Refused>(frame.content);
  if (!refused || roster_.members().empty()) return false;
  if (sent_away_.empty())
    sent_away_ = name_of(link) + ": " + printable(refused->reason, reason_shown_max);
  return true;
}

void PeerConversation::send(peer::PeerNumber to, std::vector<std::uint8_t> bytes) {
  if (!links_.send_to(to, FrameKind::mail, bytes) && roster_.is_expected(to))
    links_.keep_for(to, std::move(bytes));
}

void PeerConversation::check_losses() const {
  for (const auto& [connection, other] : links_.all())
    if (other.role == LinkRole::peer && other.is_counted && !other.loss.empty() &&
        !other.is_parted) {
      if (other.was_interrupted) throw PeerInterrupted(other.number, other.loss);
      throw peer::PeerGone(other.number, false, other.loss);
    }
}

std::optional<std::vector<std::uint8_t>> PeerConversation::take_mail(peer::PeerNumber from) {
  if (!sent_away_.empty()) throw peer::SentAway(sent_away_);
  check_losses();
  return next_mail(from);
}

std::optional<std::vector<std::uint8_t>> PeerConversation::next_mail(peer::PeerNumber from) {
  PeerLink* const link = links_.at(from);
  if (!link || link->inbox.empty()) return std::nullopt;
  std::vector<std::uint8_t> first = std::move(link->inbox.front());
  link->inbox.pop_front();
  return first;
}

bool PeerConversation::may_still_come(peer::PeerNumber from, const Patience& patience) {
  const std::string silence =
      " was silent for " + std::to_string(static_cast<int>(patience.patience_s())) + " s";
  PeerLink* const link = links_.at(from);
  if (!link) {
    if (patience.is_over())
      throw peer::PeerGone(from, false, "peer " + std::to_string(from) + silence);
    return true;
  }
  if (link->is_done && losses_.are_survived())
    throw peer::PeerGone(from, true, name_of(*link) + " has left");
  if (link->is_done)
    throw SessionError(ExitStatus::connection_lost, name_of(*link) + " left before the end");
  if (patience.is_over(link->received_s)) {
    link->is_counted = true;
    losses_.lose(*link, ExitStatus::connection_lost, name_of(*link) + silence);
  }
  return link->loss.empty() || !link->is_counted || link->is_parted;
}

void PeerConversation::deliver_deferred(const SideListener& listener) {
  while (listener) {
    std::optional<DeferredAsides::Aside> aside = deferred_.take();
    if (!aside) return;
    PeerLink* const link = links_.at(aside->from);
    if (!link || link->is_parted || listener(aside->from, std::move(aside->bytes))) continue;
    losses_.lose(*link, ExitStatus::failed,
                 name_of(*link) + " sent a side message that no peer sends");
  }
}

void PeerConversation::part(peer::PeerNumber peer, bool is_lost) {
  PeerLink* const link = links_.at(peer);
  if (!link) return;
  link->is_parted = true;
  if (link->is_closed) return;
  if (is_lost) links_.close_peer(peer);
  else if (link->is_done) links_.send_to(peer, FrameKind::farewell, bytes_of(Farewell{}));
}

void PeerConversation::rejoin(peer::PeerNumber peer) {
  PeerLink* const link = links_.at(peer);
  if (!link) return;
  link->is_parted = false;
  if (link->is_closed && !link->is_done)
    losses_.lose(*link, ExitStatus::connection_lost, name_of(*link) + " is gone");
}

void PeerConversation::bid_farewell(const Farewell& farewell) {
  for (auto& [connection, link] : links_.all())
    if (link.role == LinkRole::peer)
      links_.send(connection, FrameKind::farewell, bytes_of(farewell));
}

bool PeerConversation::awaits_farewell() const {
  const PeerLinks::Links& links = links_.all();
  return std::any_of(links.begin(), links.end(), [](const auto& entry) {
    return is_here(entry.second) && !entry.second.is_done;
  });
}

}  // namespace rink::game
