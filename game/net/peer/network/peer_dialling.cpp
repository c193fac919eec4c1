// Dials, reads the answer, and repeats what was in vain.
#include "game/net/peer/network/peer_dialling.h"

#include <algorithm>
#include <cassert>

#include "im/basics/printable.h"

namespace rink::game {

namespace {

/// A peer that starts before the first one listens tries for so long, this often.
constexpr double redial_s_max = 5.0, redial_s = 0.2;

}  // namespace

PeerDialling::PeerDialling(PeerLinks& links, PeerRoster& roster, PeerLosses& losses)
    : links_(links), roster_(roster), losses_(losses) {}

void PeerDialling::dial() { links_.dial({.place = any_}, LinkRole::asked); }

void PeerDialling::ask(const Place& any, double now_s) {
  assert(!roster_.is_in());
  any_ = any;
  begin_s_ = asked_s_ = now_s;
  dial();
}

void PeerDialling::ask_again(double patience_s, double now_s) {
  if (now_s > begin_s_ + std::max(patience_s, redial_s_max))
    throw SessionError(ExitStatus::no_server, unanswered_.empty()
                                                  ? "no peer has answered at " + any_.text()
                                                  : unanswered_);
  if (unanswered_.empty()) return;
  if (now_s > begin_s_ + redial_s_max && !may_ask_again_)
    throw SessionError(ExitStatus::no_server, unanswered_);
  if (now_s < asked_s_ + redial_s) return;
  unanswered_.clear();
  may_ask_again_ = was_redirected_ = false;
  asked_s_ = now_s;
  dial();
}

void PeerDialling::introduce(rti::ConnectionId connection) {
  Hello hello;
  hello.session_fingerprint = roster_.session_fingerprint(), hello.info = roster_.self();
  links_.send(connection, FrameKind::hello, bytes_of(hello));
}

bool PeerDialling::handle(rti::ConnectionId connection, const Frame& frame) {
  switch (frame.kind) {
    case FrameKind::refusal:
      return be_refused(connection, frame);
    case FrameKind::elsewhere:
      return go_elsewhere(connection, frame);
    case FrameKind::welcome:
      return enter(connection, frame);
    default:
      return false;
  }
}

bool PeerDialling::be_refused(rti::ConnectionId connection, const Frame& frame) {
  const auto refused = message_from<Refused>(frame.content);
  if (!refused) return false;
  const std::string why =
      "the peer at " + links_.find(connection)->info.place.text() +
      " does not let this one in: " + printable(refused->reason, reason_shown_max);
  if (refused->kind == RefusalKind::again) {
    unanswered_ = why;
    may_ask_again_ = true;
    links_.forget(connection);
  } else {
    losses_.fail(refused->kind == RefusalKind::wrong_version ? ExitStatus::wrong_version
                                                             : ExitStatus::not_admitted,
                 why);
  }
  return true;
}

bool PeerDialling::go_elsewhere(rti::ConnectionId connection, const Frame& frame) {
  const auto elsewhere = message_from<Elsewhere>(frame.content);
  if (!elsewhere || !is_reachable(elsewhere->first) || was_redirected_) return false;
  was_redirected_ = true;
  links_.forget(connection);
  links_.dial({.place = elsewhere->first}, LinkRole::asked);
  return true;
}

bool PeerDialling::enter(rti::ConnectionId connection, const Frame& frame) {
  const auto welcome = message_from<Welcome>(frame.content);
  if (!welcome || !std::all_of(welcome->others.begin(), welcome->others.end(),
                               [](const Introduced& one) { return is_reachable(one.info.place); }))
    return false;
  roster_.enter(*welcome);
  for (const Introduced& one : welcome->others) {
    const bool is_sponsor = one.number == welcome->sponsor;
    links_.identify(is_sponsor ? connection : links_.dial(one.info, LinkRole::peer), one.number,
                    one.info);
    if (!is_sponsor) links_.send_to(one.number, FrameKind::greeting, bytes_of(roster_.greeting()));
    links_.at(one.number)->is_counted = one.is_member;
  }
  return true;
}

void PeerDialling::note_unanswered(const PeerLink& link, const std::string& why) {
  assert(link.role == LinkRole::asked);
  unanswered_ = "no peer answers at " + link.info.place.text() + ": " + why;
}

}  // namespace rink::game
