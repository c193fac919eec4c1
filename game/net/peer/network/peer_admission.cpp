// Refuses, seats and announces newcomers.
#include "game/net/peer/network/peer_admission.h"

#include <algorithm>
#include <cassert>
#include <utility>
#include <variant>

#include "game/net/peer/network/difference.h"

namespace rink::game {

PeerAdmission::PeerAdmission(PeerLinks& links, PeerRoster& roster, double (*now_s)())
    : links_(links), roster_(roster), now_s_(now_s) {
  assert(now_s != nullptr);
}

bool PeerAdmission::handle(rti::ConnectionId connection, const Frame& frame) {
  if (frame.kind == FrameKind::hello) {
    const auto hello = message_from<Hello>(frame.content);
    if (hello) answer(connection, *hello);
    return hello.has_value();
  }
  const auto greeting =
      frame.kind == FrameKind::greeting ? message_from<Greeting>(frame.content) : std::nullopt;
  if (greeting) admit(connection, *greeting);
  return greeting.has_value();
}

void PeerAdmission::answer(rti::ConnectionId connection, const Hello& hello) {
  if (!hello.is_of_this_version())
    return links_.refuse(connection, RefusalKind::wrong_version, other_version(hello.version));
  if (!roster_.is_in()) {
    links_.find(connection)->asking = hello;
    return;
  }
  if (const auto reason = difference(hello.session_fingerprint, roster_.session_fingerprint()))
    return links_.refuse(connection, RefusalKind::other, *reason);
  if (roster_.is_playing()) return answer_in_play(connection, hello);
  if (roster_.number() == 0) return seat(connection, hello);
  links_.send(connection, FrameKind::elsewhere, bytes_of(Elsewhere{roster_.infos()[0].place}));
}

void PeerAdmission::seat(rti::ConnectionId connection, const Hello& hello) {
  const auto answer = roster_.seat(hello.info);
  if (const auto* const no = std::get_if<Refused>(&answer))
    return links_.refuse(connection, no->kind, no->reason);
  const Welcome& welcome = std::get<Welcome>(answer);
  links_.identify(connection, welcome.number, roster_.infos()[welcome.number]);
  links_.send(connection, FrameKind::welcome, bytes_of(welcome));
}

/// Differences are checked here; whether there is room all decide together.
void PeerAdmission::answer_in_play(rti::ConnectionId connection, const Hello& hello) {
  if (!roster_.terms().is_replicated)
    return links_.refuse(
        connection, RefusalKind::other,
        "they play already, and without replicas (--unmirrored) none can join them");
  if (late_refusal_) return links_.refuse(connection, RefusalKind::other, late_refusal_());
  const bool is_good = !hello.info.place.address.empty() && hello.info.place.port != 0 &&
                       bytes_of(hello.info.place).size() <= peer::Newcomer::place_max;
  if (!is_good)
    return links_.refuse(connection, RefusalKind::other, "it does not say where others reach it");
  PeerLink& link = *links_.find(connection);
  link.role = LinkRole::caller, link.info = hello.info, link.since_s = now_s_();
}

void PeerAdmission::admit(rti::ConnectionId connection, const Greeting& greeting) {
  const PeerRoster::Standing standing = roster_.standing_of(greeting);
  PeerLink& link = *links_.find(connection);
  if (standing == PeerRoster::Standing::early) {
    link.early = greeting;
    return;
  }
  if (standing == PeerRoster::Standing::unknown || links_.at(greeting.number))
    return links_.refuse(connection, RefusalKind::other, "it is none of this session's peers");
  roster_.set_info(greeting.number, greeting.info);
  links_.identify(connection, greeting.number, greeting.info);
  link.is_counted = standing != PeerRoster::Standing::expected;
}

std::vector<rti::ConnectionId> PeerAdmission::answer_early() {
  assert(roster_.is_in());
  std::vector<rti::ConnectionId> early, asking;
  for (const auto& [connection, link] : links_.all()) {
    if (link.early) early.push_back(connection);
    if (link.asking) asking.push_back(connection);
  }
  for (const rti::ConnectionId connection : asking)
    answer(connection, *std::exchange(links_.find(connection)->asking, std::nullopt));
  for (const rti::ConnectionId connection : early) {
    PeerLink* const link = links_.find(connection);
    if (!link || !link->early) continue;  // it asked as well, and was answered
    const Greeting greeting = *std::exchange(link->early, std::nullopt);
    if (link->role == LinkRole::stranger) admit(connection, greeting);
  }
  return early;
}

std::vector<peer::Newcomer> PeerAdmission::callers() {
  std::vector<peer::Newcomer> all;
  for (auto& [connection, link] : links_.all()) {
    if (link.role != LinkRole::caller || link.is_announced || link.is_closed) continue;
    link.is_announced = true;
    const PeerInfo& info = link.info;
    all.push_back({.token = info.token,
                   .bat_count = info.bat_count,
                   .puck_count = info.puck_count,
                   .hand_count = info.hand_count,
                   .place = bytes_of(info.place)});
  }
  return all;
}

void PeerAdmission::refuse_caller(std::uint64_t token, const std::string& reason,
                                  bool may_ask_again) {
  const PeerLinks::Links& links = links_.all();
  const auto caller = std::find_if(links.begin(), links.end(), [&](const auto& entry) {
    return entry.second.role == LinkRole::caller && entry.second.info.token == token;
  });
  if (caller != links.end())
    links_.refuse(caller->first, may_ask_again ? RefusalKind::again : RefusalKind::other, reason);
}

std::optional<rti::ConnectionId> PeerAdmission::expect(const peer::Candidate& candidate,
                                                       bool has_asked_here,
                                                       const peer::State& state) {
  if (links_.at(candidate.number)) return std::nullopt;
  const PeerInfo info = info_of(candidate);
  roster_.expect(candidate.number, info);
  const auto is_it = [&](const auto& entry) {
    const PeerLink& link = entry.second;
    if (has_asked_here) return link.role == LinkRole::caller && link.info.token == info.token;
    return link.role == LinkRole::stranger && link.early &&
           link.early->number == candidate.number && link.early->info.token == info.token;
  };
  PeerLinks::Links& links = links_.all();
  const auto found = std::find_if(links.begin(), links.end(), is_it);
  if (found == links.end()) return std::nullopt;
  auto& [connection, link] = *found;
  link.is_counted = false;
  const bool was_early = std::exchange(link.early, std::nullopt).has_value();
  if (link.is_closed)
    link.loss = "peer " + std::to_string(candidate.number) + " (" + info.place.text() + ") is gone";
  roster_.set_info(candidate.number, info);
  links_.identify(connection, candidate.number, info);
  if (was_early) return connection;
  links_.send(connection, FrameKind::welcome, bytes_of(roster_.welcome_of(candidate, state)));
  return std::nullopt;
}

bool PeerAdmission::reaches(peer::PeerNumber candidate) const {
  const PeerLink* const link = links_.at(candidate);
  return link && link->is_open && !link->is_closed && !link->is_done && link->loss.empty();
}

bool PeerAdmission::has_given_up(peer::PeerNumber candidate, double patience_s) const {
  return !reaches(candidate) || now_s_() > links_.at(candidate)->since_s + patience_s;
}

void PeerAdmission::decide(peer::PeerNumber candidate, bool is_in) {
  PeerLink* const link = links_.at(candidate);
  if (is_in) {
    if (link) link->is_counted = true;
    return;
  }
  roster_.expect_no_more(candidate);
  // The newcomer closes the connection itself: closing it here could discard the message.
  links_.send_to(
      candidate, FrameKind::refusal,
      bytes_of(Refused{RefusalKind::again, "others were lost or left before it was in"}));
  links_.release(candidate);
  if (link) link->role = LinkRole::dismissed, link->since_s = now_s_();
}

}  // namespace rink::game
