// Waiting for frames, and reading them.
#include "game/net/peer/network/peer_network.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

namespace rink::game {

namespace {

constexpr double wait_s_max = 0.05;
/// The time to wait for the others' farewells.
constexpr double goodbye_s_max = 5.0;

}  // namespace

PeerNetwork::PeerNetwork(rti::SocketTransport& sockets, const PeerNetworkSettings& settings,
                         double (*now_s)())
    : sockets_(sockets),
      now_s_(now_s),
      patience_s_(settings.patience_s),
      gathering_s_(settings.gathering_s),
      must_end_(settings.must_end),
      roster_(settings.self, settings.bats, settings.session_fingerprint, settings.session),
      links_(sockets, now_s),
      admission_(links_, roster_, now_s),
      dialling_(links_, roster_, losses_),
      conversation_(links_, roster_, losses_) {
  if (settings.late_refusal) admission_.refuse_late(settings.late_refusal);
}

void PeerNetwork::attend(double wait_s) {
  if (before_wait) wait_s = std::clamp(before_wait() - now_s_(), 0.0, wait_s);
  links_.show_signs(patience_s_);  // who waits for another must not seem silent itself
  links_.push_all();
  if (links_.is_sending()) wait_s = std::min(0.001, wait_s);
  sockets_.get().poll(std::chrono::nanoseconds(static_cast<std::int64_t>(1e9 * wait_s)), *this);
  conversation_.deliver_deferred(receive_aside);
  links_.dismiss_idle(patience_s_);
  check_interrupt();
  losses_.check();
}

void PeerNetwork::check_interrupt() {
  if (!must_end_()) return;
  leaving_.interrupt(now_s_());
  if (!losses_.are_survived() || !leaving_.is_left(now_s_(), roster_.terms().window))
    throw SessionError(ExitStatus::interrupted, "interrupted");
}

void PeerNetwork::begin() {
  roster_.begin();
  losses_.begin(roster_.terms().is_replicated);
}

void PeerNetwork::join(const Place& any) {
  dialling_.ask(any, now_s_());
  for (;;) {
    attend(wait_s_max);
    if (roster_.is_in()) return;
    dialling_.ask_again(patience_s_, now_s_());
  }
}

/// A peer that falls silent before all are connected would keep the others waiting for ever: it
/// neither plays nor closes its connection.
void PeerNetwork::gather() {
  const double give_up_s = now_s_() + gathering_s_;
  Patience patience(patience_s_, 0.5 * patience_s_, now_s_());
  while (!links_.are_open(roster_.terms().peer_count, roster_.number())) {
    attend(wait_s_max);
    links_.show_signs(patience_s_);
    if (now_s_() > give_up_s) throw too_few_came();
    patience.look(now_s_());
    for (const auto& [connection, link] : links_.all())
      if (link.role == LinkRole::peer && !link.is_closed &&
          patience.is_over(std::max(link.since_s, link.received_s)))
        throw SessionError(ExitStatus::connection_lost,
                           name_of(link) + " was silent for " +
                               std::to_string(static_cast<int>(patience_s_)) +
                               " s, before all were there");
  }
}

SessionError PeerNetwork::too_few_came() {
  std::uint32_t came = 1;  // this one
  for (const auto& [connection, link] : links_.all())
    came += link.role == LinkRole::peer && link.is_open && !link.is_closed ? 1 : 0;
  return {ExitStatus::nobody_came,
          std::to_string(came) + " of " + std::to_string(roster_.terms().peer_count) +
              " came within " + std::to_string(std::lround(gathering_s_)) + " s"};
}

void PeerNetwork::rest_until(double time_s) {
  // Who is late looks at others and the user all the same.
  do attend(std::clamp(time_s - now_s_(), 0.0, wait_s_max));
  while (now_s_() < time_s && !must_end_());
}

std::optional<std::vector<std::uint8_t>> PeerNetwork::next_mail(peer::PeerNumber from) {
  if (auto mail = conversation_.next_mail(from)) return mail;
  if (!waiting_)
    waiting_.emplace(patience_s_, std::max(0.5 * patience_s_, 2.0 * wait_s_max), now_s_());
  waiting_->look(now_s_());
  conversation_.check_losses();
  conversation_.may_still_come(from, *waiting_);
  return std::nullopt;
}

void PeerNetwork::leave(const Farewell& farewell) {
  conversation_.bid_farewell(farewell);
  // Closing a connection before all is read may discard the last bytes sent.
  const double give_up_s =
      now_s_() + (farewell.kind == FarewellKind::done ? std::min(patience_s_, goodbye_s_max) : 0.5);
  while ((conversation_.awaits_farewell() || links_.has_unsent()) && now_s_() < give_up_s) {
    links_.push_all();
    sockets_.get().poll(std::chrono::milliseconds(1), *this);
  }
}

void PeerNetwork::send(peer::PeerNumber to, std::vector<std::uint8_t> bytes) {
  conversation_.send(to, std::move(bytes));
}

void PeerNetwork::send_aside(peer::PeerNumber to, std::vector<std::uint8_t> bytes) {
  links_.send_to(to, FrameKind::aside, bytes);
}

void PeerNetwork::defer(peer::PeerNumber from, std::vector<std::uint8_t> bytes) {
  conversation_.defer(from, std::move(bytes));
}

std::pair<peer::PeerNumber, std::vector<std::uint8_t>> PeerNetwork::receive_any(
    std::span<const peer::PeerNumber> from) {
  Patience patience(patience_s_, std::max(0.5 * patience_s_, 2.0 * wait_s_max), now_s_());
  for (;;) {
    patience.look(now_s_());
    for (const peer::PeerNumber peer : from)
      if (auto mail = conversation_.take_mail(peer)) return {peer, std::move(*mail)};
    bool may_come = true;
    for (const peer::PeerNumber peer : from)
      may_come = conversation_.may_still_come(peer, patience) && may_come;
    if (may_come) attend(wait_s_max);
  }
}

void PeerNetwork::refuse(std::uint64_t token, const std::string& reason, bool may_ask_again) {
  admission_.refuse_caller(token, reason, may_ask_again);
}

void PeerNetwork::expect(const peer::Candidate& candidate, bool has_asked_here,
                         const peer::State& state) {
  if (const auto connection = admission_.expect(candidate, has_asked_here, state))
    read_frames(*connection);
}

bool PeerNetwork::has_given_up(peer::PeerNumber candidate) {
  return admission_.has_given_up(candidate, patience_s_);
}

void PeerNetwork::admit(peer::PeerNumber candidate, bool is_in) {
  admission_.decide(candidate, is_in);
}

void PeerNetwork::on_open(rti::ConnectionId connection) {
  links_.open(connection);
  const PeerLink* const link = links_.find(connection);
  if (link && link->role == LinkRole::asked) dialling_.introduce(connection);
}

void PeerNetwork::on_bytes(rti::ConnectionId connection, rti::Bytes bytes) {
  links_.add(connection, bytes);
  read_frames(connection);
  if (PeerLink* const link = links_.find(connection)) link->frames.keep();
}

void PeerNetwork::on_close(rti::ConnectionId connection, rti::CloseReason reason,
                           const std::string& detail) {
  PeerLink* const link = links_.find(connection);
  if (!link) return;
  std::string why(rti::to_string(reason));
  if (!detail.empty() && detail != why) why += ", " + detail;
  if (link->role == LinkRole::peer && !link->is_done && !link->is_parted)
    losses_.lose(*link, ExitStatus::connection_lost,
                 name_of(*link) + (link->is_open ? " is gone: " : " cannot be reached: ") + why);
  if (link->role == LinkRole::asked) dialling_.note_unanswered(*link, why);
  links_.note_close(connection);
}

/// Each frame may change who is at the other end, or whether anybody is.
void PeerNetwork::read_frames(rti::ConnectionId connection) {
  for (PeerLink* link = links_.find(connection); link && !link->is_closed && !link->early;
       link = links_.find(connection)) {
    std::optional<Frame> frame =
        link->frames.next(link->role == LinkRole::peer ? peer_frame_max : stranger_frame_max);
    if (!frame && (!link->frames.is_broken() || link->role == LinkRole::dismissed)) return;
    if (link->role == LinkRole::dismissed) continue;
    const LinkRole role = link->role;
    if (frame && handle(connection, *link, std::move(*frame))) continue;
    if (role == LinkRole::stranger || role == LinkRole::caller) return links_.dismiss(connection);
    end_bad(connection, *link);
  }
}

/// False for a frame that nobody in its role would send.
bool PeerNetwork::handle(rti::ConnectionId connection, PeerLink& link, Frame frame) {
  switch (link.role) {
    case LinkRole::stranger:
      return admission_.handle(connection, frame);
    case LinkRole::asked: {
      if (!dialling_.handle(connection, frame)) return false;
      if (!roster_.is_in()) return true;
      for (const rti::ConnectionId early : admission_.answer_early()) read_frames(early);
      return true;
    }
    case LinkRole::peer:
      return conversation_.handle(connection, link, std::move(frame));
    case LinkRole::caller:
    case LinkRole::dismissed:
      break;
  }
  return false;
}

/// Another peer, or who was asked, has sent what is no message.
void PeerNetwork::end_bad(rti::ConnectionId connection, PeerLink& link) {
  if (link.role == LinkRole::peer)
    losses_.lose(link, ExitStatus::failed, name_of(link) + " sent what is no message");
  else
    losses_.fail(ExitStatus::no_server,
                 "what answers at " + link.info.place.text() + " is no peer that speaks version " +
                     std::to_string(peer_protocol_version) + " of the peers' protocol");
  links_.close(connection);
}

}  // namespace rink::game
