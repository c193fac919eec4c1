// Assigns numbers and bats, and judges who introduces itself.
#include "game/net/peer/network/peer_roster.h"

#include <algorithm>
#include <cassert>
#include <string>

#include "game/net/peer/network/difference.h"

namespace rink::game {

namespace {

constexpr std::size_t address_max = 253;  // characters, of a host's name

}  // namespace

bool is_reachable(const Place& place) {
  return !place.address.empty() && place.address.size() <= address_max && place.port != 0;
}

PeerInfo info_of(const peer::Candidate& candidate) {
  const auto place = message_from<Place>(candidate.newcomer.place);
  const peer::Newcomer& newcomer = candidate.newcomer;
  return {place.value_or(Place{}), candidate.first_bat, newcomer.bat_count,
          newcomer.puck_count,     newcomer.hand_count, newcomer.token};
}

PeerRoster::PeerRoster(const PeerInfo& self, std::uint32_t bats,
                       const Fingerprint& session_fingerprint, std::uint64_t session)
    : self_(self), bats_(bats), session_fingerprint_(session_fingerprint), session_(session) {
  assert(self.hand_count <= self.bat_count);
}

void PeerRoster::found(const Terms& terms) {
  assert(!is_in_);
  terms_ = terms;
  is_in_ = true;
  infos_.resize(terms.peer_count);
  infos_[0] = self_;
  bats_taken_ = self_.bat_count;
}

void PeerRoster::enter(const Welcome& welcome) {
  assert(!is_in_);
  is_in_ = true;
  session_ = welcome.session;
  terms_ = welcome.terms;
  number_ = welcome.number;
  self_.first_bat = welcome.first_bat;
  infos_.resize(std::max(terms_.peer_count, number_ + 1));
  infos_[number_] = self_;
  for (const Introduced& one : welcome.others) {
    set_info(one.number, one.info);
    if (one.is_member && welcome.is_playing) members_.push_back(one.number);
  }
}

void PeerRoster::set_info(peer::PeerNumber number, const PeerInfo& info) {
  if (number >= infos_.size()) infos_.resize(number + 1);
  infos_[number] = info;
}

std::variant<Welcome, Refused> PeerRoster::seat(const PeerInfo& info) {
  assert(is_in_ && number_ == 0 && !is_playing());
  if (!is_reachable(info.place))
    return Refused{RefusalKind::other, "it does not say where others reach it"};
  // A newcomer that was not expected can be admitted during the game.
  if (seated_ == terms_.peer_count)
    return Refused{terms_.is_replicated ? RefusalKind::again : RefusalKind::other,
                   "all " + std::to_string(terms_.peer_count) +
                       " peers that were waited for are there, and do not play yet"};
  assert(bats_taken_ <= bats_);
  if (const std::uint32_t free = bats_ - bats_taken_; info.bat_count > free)
    return Refused{RefusalKind::other, too_few_bats(info.bat_count, bats_, free)};
  Welcome welcome{.session = session_,
                  .terms = terms_,
                  .sponsor = 0,
                  .number = seated_,
                  .first_bat = bats_taken_,
                  .is_playing = false,
                  .others = {}};
  for (peer::PeerNumber k = 0; k < seated_; ++k) welcome.others.push_back({k, true, infos_[k]});
  set_info(seated_, info);
  infos_[seated_++].first_bat = bats_taken_;
  bats_taken_ += info.bat_count;
  return welcome;
}

Welcome PeerRoster::welcome_of(const peer::Candidate& candidate, const peer::State& state) const {
  Welcome welcome{.session = session_,
                  .terms = terms_,
                  .sponsor = number_,
                  .number = candidate.number,
                  .first_bat = candidate.first_bat,
                  .is_playing = true,
                  .others = {}};
  for (const peer::PeerNumber member : state.members)
    welcome.others.push_back({member, true, infos_[member]});
  for (const peer::Candidate& other : state.candidates)
    if (other.number < candidate.number)
      welcome.others.push_back({other.number, false, info_of(other)});
  std::sort(welcome.others.begin(), welcome.others.end(),
            [](const Introduced& a, const Introduced& b) { return a.number < b.number; });
  return welcome;
}

PeerRoster::Standing PeerRoster::standing_of(const Greeting& greeting) const {
  if (!is_in_) return Standing::early;
  if (greeting.session != session_ || !is_reachable(greeting.info.place)) return Standing::unknown;
  const auto expected = expected_.find(greeting.number);
  if (expected != expected_.end() && expected->second.token == greeting.info.token)
    return Standing::expected;
  if (is_playing())
    return greeting.number < peer::numbers_max ? Standing::early : Standing::unknown;
  return greeting.number > number_ && greeting.number < terms_.peer_count ? Standing::due
                                                                          : Standing::unknown;
}

}  // namespace rink::game
