// Newcomers during the game: requests, connections and refusals.
#include <algorithm>
#include <utility>

#include "game/net/peer/network/peer_network.h"

namespace rink::game {

namespace {

PeerInfo info_of(const peer::Candidate& candidate) {
  const auto place = message_from<Place>(candidate.newcomer.place);
  const peer::Newcomer& newcomer = candidate.newcomer;
  return {place.value_or(Place{}), candidate.first_bat, newcomer.bat_count,
          newcomer.puck_count,     newcomer.hand_count, newcomer.token};
}

}  // namespace

PeerNetwork::Link* PeerNetwork::link_at(peer::PeerNumber number) {
  if (number >= peers_.size() || !peers_[number]) return nullptr;
  const auto entry = links_.find(*peers_[number]);
  return entry == links_.end() ? nullptr : &entry->second;
}

/// Differences are checked here; whether there is room all decide together.
void PeerNetwork::answer_in_play(rti::ConnectionId connection, const Hello& hello) {
  if (!terms_.is_replicated)
    return refuse(connection, RefusalKind::other,
                  "they play already, and without replicas (--unmirrored) none can join them");
  const bool is_good = !hello.info.place.address.empty() && hello.info.place.port != 0 &&
                       bytes_of(hello.info.place).size() <= peer::Newcomer::place_max;
  if (!is_good)
    return refuse(connection, RefusalKind::other, "it does not say where others reach it");
  Link& link = links_.at(connection);
  link.role = Role::caller, link.info = hello.info, link.since_s = now_s_();
}

std::vector<peer::Newcomer> PeerNetwork::callers() {
  std::vector<peer::Newcomer> all;
  for (auto& [connection, link] : links_) {
    if (link.role != Role::caller || link.is_announced || link.is_closed) continue;
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

void PeerNetwork::refuse(std::uint64_t token, const std::string& reason, bool may_ask_again) {
  const auto caller = std::find_if(links_.begin(), links_.end(), [&](const auto& entry) {
    return entry.second.role == Role::caller && entry.second.info.token == token;
  });
  if (caller != links_.end())
    refuse(caller->first, may_ask_again ? RefusalKind::again : RefusalKind::other, reason);
}

void PeerNetwork::expect(const peer::Candidate& candidate, bool has_asked_here,
                         const peer::State& state) {
  if (link_at(candidate.number)) return;
  const PeerInfo info = info_of(candidate);
  const auto is_it = [&](const auto& entry) {
    const Link& link = entry.second;
    if (has_asked_here) return link.role == Role::caller && link.info.token == info.token;
    return link.role == Role::stranger && link.early && link.early->number == candidate.number &&
           link.early->info.token == info.token;
  };
  expected_[candidate.number] = info;
  const auto found = std::find_if(links_.begin(), links_.end(), is_it);
  if (found == links_.end()) return;
  const rti::ConnectionId connection = found->first;
  Link& link = found->second;
  link.is_counted = false;
  const bool was_early = std::exchange(link.early, std::nullopt).has_value();
  if (link.is_closed)
    link.loss = "peer " + std::to_string(candidate.number) + " (" + info.place.text() + ") is gone";
  become_peer(connection, candidate.number, info);
  if (was_early) return read_frames(connection);
  Welcome welcome{.session = settings_.session,
                  .terms = terms_,
                  .sponsor = number_,
                  .number = candidate.number,
                  .first_bat = candidate.first_bat,
                  .is_playing = true,
                  .others = {}};
  for (const peer::PeerNumber member : state.members)
    welcome.others.push_back({member, true, peer_infos_[member]});
  for (const peer::Candidate& other : state.candidates)
    if (other.number < candidate.number)
      welcome.others.push_back({other.number, false, info_of(other)});
  std::sort(welcome.others.begin(), welcome.others.end(),
            [](const Introduced& a, const Introduced& b) { return a.number < b.number; });
  send_frame(connection, FrameKind::welcome, bytes_of(welcome));
}

bool PeerNetwork::reaches(peer::PeerNumber candidate) {
  const Link* const link = link_at(candidate);
  return link && link->is_open && !link->is_closed && !link->is_done && link->loss.empty();
}

bool PeerNetwork::has_given_up(peer::PeerNumber candidate) {
  const Link* const link = link_at(candidate);
  return !reaches(candidate) || now_s_() > link->since_s + settings_.patience_s;
}

void PeerNetwork::admit(peer::PeerNumber candidate, bool is_in) {
  Link* const link = link_at(candidate);
  if (is_in) {
    if (link) link->is_counted = true;
    return;
  }
  expected_.erase(candidate);
  waiting_mail_.erase(candidate);
  if (!link) return;
  // The newcomer closes the connection itself: closing it here could discard the message.
  if (!link->is_closed)
    send_frame(*peers_[candidate], FrameKind::refusal,
               bytes_of(Refused{RefusalKind::again, "others were lost or left before it was in"}));
  link->role = Role::dismissed, link->since_s = now_s_();
  peers_[candidate].reset();
}

}  // namespace rink::game
