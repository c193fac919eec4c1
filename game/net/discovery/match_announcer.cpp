// An answer is as large as its query, and there are few a second: nobody can be flooded by it.
#include "game/net/discovery/match_announcer.h"

#include <algorithm>
#include <array>
#include <cassert>

#include "rti/wire/membership_messages.h"

namespace rink::game {

MatchAnnouncer::MatchAnnouncer(const AnnouncedMatch& match, const rti::MulticastGroup& group,
                               double now_s)
    : match_(match),
      socket_(group, rti::MulticastSocket::Role::listens),
      allowance_(answers_per_s, now_s) {
  assert(match.port != 0 && match_name(match.name) == match.name);
}

void MatchAnnouncer::attend(double now_s) {
  constexpr int taken_most = 256;  // at once, however many come
  std::array<std::byte, discovery_size + 1> room;
  for (int taken = 0; taken < taken_most; ++taken) {
    const auto arrival = socket_.receive(room);
    if (!arrival) return;
    const std::size_t size = std::min(arrival->size, room.size());
    const auto query = query_of(rti::Bytes(room).first(size));
    if (!query) {
      ++counters_.refused;
    } else if (match_.is_local_only && !arrival->from.is_loopback()) {
      ++counters_.from_elsewhere;
    } else if (!allowance_.take(1.0, now_s)) {
      ++counters_.over_limit;
    } else {
      socket_.send_to(arrival->from, encoded(DiscoveryAnswer{.number = query->number,
                                                             .host = match_.host,
                                                             .port = match_.port,
                                                             .protocol = rti::protocol_version,
                                                             .name = match_.name}));
      ++counters_.answered;
    }
  }
}

}  // namespace rink::game
