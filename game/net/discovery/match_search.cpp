// A host that answers several times, by several interfaces, is listed once, at its nearest place.
#include "game/net/discovery/match_search.h"

#include <algorithm>
#include <array>
#include <tuple>
#include <utility>

#include "rti/wire/membership_messages.h"

namespace rink::game {

MatchSearch::MatchSearch(const rti::MulticastGroup& group, std::function<std::uint64_t()> draw)
    : socket_(group, rti::MulticastSocket::Role::asks), draw_(std::move(draw)) {}

void MatchSearch::search(double now_s) {
  constexpr int taken_most = 256;  // at once, however many come
  std::array<std::byte, discovery_size + 1> room;
  for (int taken = 0; taken < taken_most; ++taken) {
    const auto arrival = socket_.receive(room);
    if (!arrival) break;
    take(rti::Bytes(room).first(std::min(arrival->size, room.size())), arrival->from, now_s);
  }
  std::erase_if(queries_,
                [&](const Query& each) { return now_s > each.asked_s + forgets_after_s; });
  std::erase_if(hosts_, [&](const Host& each) { return now_s > each.heard_s + forgets_after_s; });
  if (queries_.empty() || now_s >= queries_.back().asked_s + asks_every_s) ask(now_s);
  list();
}

void MatchSearch::ask(double now_s) {
  queries_.push_back({draw_(), now_s});
  ++counters_.asked;
  socket_.send_to_group(encoded(DiscoveryQuery{queries_.back().number}));
}

void MatchSearch::take(rti::Bytes bytes, const rti::DatagramSource& from, double now_s) {
  const auto answer = answer_of(bytes);
  const auto query =
      answer ? std::ranges::find(queries_, answer->number, &Query::number) : queries_.end();
  if (query == queries_.end()) {
    ++counters_.refused;
    return;
  }
  ++counters_.answers;
  const FoundMatch match{.name = answer->name,
                         .place = from.address() + ':' + std::to_string(answer->port),
                         .ping_s = now_s - query->asked_s,
                         .is_same_version = answer->protocol == rti::protocol_version};
  const auto host = std::ranges::find(hosts_, answer->host, &Host::id);
  if (host == hosts_.end()) {
    if (hosts_.size() < found_max) hosts_.push_back({answer->host, now_s, match});
    return;
  }
  host->heard_s = now_s;
  if (match.ping_s < host->match.ping_s) host->match = match;
}

void MatchSearch::list() {
  found_.clear();
  for (const Host& each : hosts_) found_.push_back(each.match);
  std::ranges::sort(found_, [](const FoundMatch& a, const FoundMatch& b) {
    return std::tie(a.name, a.place) < std::tie(b.name, b.place);
  });
}

}  // namespace rink::game
