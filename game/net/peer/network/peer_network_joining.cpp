// Admits peers, assigns numbers, and sends each what it needs.
#include <algorithm>
#include <utility>

#include "game/net/peer/network/difference.h"
#include "game/net/peer/network/peer_network.h"

namespace rink::game {

namespace {

constexpr std::size_t address_max = 253;  // characters, of a host's name
/// A peer that starts before the first one listens tries for so long, this often.
constexpr double redial_s_max = 5.0, redial_s = 0.2;

bool is_reachable(const Place& place) {
  return !place.address.empty() && place.address.size() <= address_max && place.port != 0;
}

}  // namespace

void PeerNetwork::found(const Terms& terms) {
  terms_ = terms;
  is_in_ = true;
  peers_.resize(terms.peer_count);
  peer_infos_.resize(terms.peer_count);
  peer_infos_[0] = settings_.self;
  bats_taken_ = settings_.self.bat_count;
}

void PeerNetwork::join(const Place& any) {
  dial({.place = any}, Role::asked, 0);
  const double begin_s = now_s_();
  for (double asked_s = begin_s; !is_in_;) {
    const double now = now_s_();
    if (now > begin_s + std::max(settings_.patience_s, redial_s_max))
      throw SessionError(ExitStatus::no_server, unanswered_.empty()
                                                    ? "no peer has answered at " + any.text()
                                                    : unanswered_);
    attend(0.05);
    if (unanswered_.empty()) continue;
    if (now > begin_s + redial_s_max && !may_ask_again_)
      throw SessionError(ExitStatus::no_server, unanswered_);
    if (now < asked_s + redial_s) continue;
    unanswered_.clear();
    may_ask_again_ = false;
    redirections_ = 0;
    asked_s = now;
    dial({.place = any}, Role::asked, 0);
  }
}

bool PeerNetwork::are_all_here() const {
  for (peer::PeerNumber k = 0; k < terms_.peer_count; ++k)
    if (k != number_ && (!peers_[k] || !links_.at(*peers_[k]).is_open)) return false;
  return true;
}

/// A peer that falls silent before all are connected would keep the others waiting for ever: it
/// neither plays nor closes its connection.
void PeerNetwork::gather() {
  double begin_s = now_s_(), looked_s = begin_s;
  while (!are_all_here()) {
    attend(0.05);
    show_signs();
    const double now = now_s_();
    // A peer that was itself stopped has not read the others' messages yet.
    if (now - looked_s > 0.5 * settings_.patience_s) begin_s = now;
    looked_s = now;
    for (const auto& [connection, link] : links_)
      if (link.role == Role::peer && !link.is_closed &&
          now > std::max({begin_s, link.since_s, link.received_s}) + settings_.patience_s)
        throw SessionError(ExitStatus::connection_lost,
                           name_of(link) + " was silent for " +
                               std::to_string(static_cast<int>(settings_.patience_s)) +
                               " s, before all were there");
  }
}

void PeerNetwork::become_peer(rti::ConnectionId connection, peer::PeerNumber number,
                              const PeerInfo& info) {
  Link& link = links_.at(connection);
  link.role = Role::peer, link.number = number, link.info = info;
  if (number >= peers_.size()) peers_.resize(number + 1), peer_infos_.resize(number + 1);
  peers_[number] = connection;
  peer_infos_[number] = info;
  if (const auto mail = waiting_mail_.extract(number))
    for (const std::vector<std::uint8_t>& bytes : mail.mapped())
      send_frame(connection, FrameKind::mail, bytes);
}

/// False for a frame that no peer would send.
bool PeerNetwork::handle_stranger(rti::ConnectionId connection, const Frame& frame) {
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

/// The first peer assigns the numbers, so that newcomers through different peers get different
/// ones.
void PeerNetwork::answer(rti::ConnectionId connection, const Hello& hello) {
  if (!hello.is_of_this_version())
    return refuse(connection, RefusalKind::wrong_version, other_version(hello.version));
  if (!is_in_) {
    links_.at(connection).asking = hello;
    return;
  }
  if (const auto reason = difference(hello.session_fingerprint, settings_.session_fingerprint))
    return refuse(connection, RefusalKind::other, *reason);
  if (is_playing_ || !members_.empty()) return answer_in_play(connection, hello);
  if (number_ != 0) {
    send_frame(connection, FrameKind::elsewhere, bytes_of(Elsewhere{peer_infos_[0].place}));
    return;
  }
  PeerInfo info = hello.info;
  if (!is_reachable(info.place))
    return refuse(connection, RefusalKind::other, "it does not say where others reach it");
  // A newcomer that was not expected can be admitted during the game.
  if (peer_info_count_ == terms_.peer_count)
    return refuse(connection, terms_.is_replicated ? RefusalKind::again : RefusalKind::other,
                  "all " + std::to_string(terms_.peer_count) +
                      " peers that were waited for are there, and do not play yet");
  if (const std::uint32_t free = settings_.bats - bats_taken_; info.bat_count > free)
    return refuse(connection, RefusalKind::other,
                  "it wants to play " + std::to_string(info.bat_count) + " bats, of " +
                      std::to_string(settings_.bats) + " here " + std::to_string(free) +
                      " are free");
  info.first_bat = bats_taken_;
  bats_taken_ += info.bat_count;
  Welcome welcome{.session = settings_.session,
                  .terms = terms_,
                  .sponsor = 0,
                  .number = peer_info_count_,
                  .first_bat = info.first_bat,
                  .is_playing = false,
                  .others = {}};
  for (peer::PeerNumber k = 0; k < peer_info_count_; ++k)
    welcome.others.push_back({k, true, peer_infos_[k]});
  become_peer(connection, peer_info_count_++, info);
  send_frame(connection, FrameKind::welcome, bytes_of(welcome));
}

void PeerNetwork::admit(rti::ConnectionId connection, const Greeting& greeting) {
  const bool is_of_us = greeting.session == settings_.session && is_reachable(greeting.info.place);
  const auto expected = expected_.find(greeting.number);
  const bool is_expected =
      expected != expected_.end() && expected->second.token == greeting.info.token;
  const bool is_early = !is_in_ || (is_of_us && (is_playing_ || !members_.empty()) &&
                                    !is_expected && greeting.number < peer::numbers_max);
  // The greeting came before the own number was known, or before the peer was announced.
  if (is_early) {
    links_.at(connection).early = greeting;
    return;
  }
  const bool is_due = is_of_us &&
                      (is_expected || (greeting.number > number_ &&
                                       greeting.number < terms_.peer_count && !is_playing_)) &&
                      !link_at(greeting.number);
  if (!is_due) return refuse(connection, RefusalKind::other, "it is none of this session's peers");
  become_peer(connection, greeting.number, greeting.info);
  links_.at(connection).is_counted = !is_expected;
}

bool PeerNetwork::handle_answer(rti::ConnectionId connection, const Frame& frame) {
  if (frame.kind == FrameKind::refusal) {
    const auto refused = message_from<Refused>(frame.content);
    if (refused && refused->kind == RefusalKind::again) {
      unanswered_ = "the peer at " + links_.at(connection).info.place.text() +
                    " does not let this one in: " + refused->reason;
      may_ask_again_ = true;
      links_.erase(connection);
      sockets_.get().close(connection);
    } else if (refused)
      note(refused->kind == RefusalKind::wrong_version ? ExitStatus::wrong_version
                                                       : ExitStatus::not_admitted,
           "the peer at " + links_.at(connection).info.place.text() +
               " does not let this one in: " + refused->reason);
    return refused.has_value();
  }
  if (frame.kind == FrameKind::elsewhere) {
    const auto elsewhere = message_from<Elsewhere>(frame.content);
    if (!elsewhere || !is_reachable(elsewhere->first) || redirections_++ > 0) return false;
    links_.erase(connection);
    sockets_.get().close(connection);
    dial({.place = elsewhere->first}, Role::asked, 0);
    return true;
  }
  const auto welcome =
      frame.kind == FrameKind::welcome ? message_from<Welcome>(frame.content) : std::nullopt;
  if (!welcome) return false;
  for (const Introduced& one : welcome->others)
    if (!is_reachable(one.info.place)) return false;
  enter(connection, *welcome);
  return true;
}

void PeerNetwork::enter(rti::ConnectionId connection, const Welcome& welcome) {
  is_in_ = true;
  settings_.session = welcome.session;
  terms_ = welcome.terms;
  number_ = welcome.number;
  settings_.self.first_bat = welcome.first_bat;
  peer_infos_.resize(std::max(terms_.peer_count, number_ + 1));
  peer_infos_[number_] = settings_.self;
  peers_.resize(peer_infos_.size());
  for (const Introduced& one : welcome.others) {
    if (one.number == welcome.sponsor) {
      become_peer(connection, one.number, one.info);
    } else {
      dial(one.info, Role::peer, one.number);
      send_frame(*peers_[one.number], FrameKind::greeting,
                 bytes_of(Greeting{settings_.session, number_, settings_.self}));
    }
    link_of(one.number).is_counted = one.is_member;
    if (one.is_member && welcome.is_playing) members_.push_back(one.number);
  }
  std::vector<rti::ConnectionId> early, asking;
  for (const auto& [other, link] : links_) {
    if (link.early) early.push_back(other);
    if (link.asking) asking.push_back(other);
  }
  for (const rti::ConnectionId other : asking)
    answer(other, *std::exchange(links_.at(other).asking, std::nullopt));
  for (const rti::ConnectionId other : early) {
    admit(other, *std::exchange(links_.at(other).early, std::nullopt));
    read_frames(other);
  }
}

}  // namespace rink::game
