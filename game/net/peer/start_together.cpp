// Who is ready says so to the first member, beside the mail.
#include "game/net/peer/start_together.h"

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "game/net/interrupt.h"
#include "game/net/peer/network/session_error.h"

namespace rink::game {

double start_together(SessionNetwork& network, double (*now_s)()) {
  constexpr std::uint8_t word = 0xff;
  constexpr double look_s = 0.05;
  const peer::PeerNumber count = network.terms().peer_count;
  peer::PeerNumber ready = 1;
  std::optional<double> start_s;
  std::vector<std::pair<peer::PeerNumber, std::vector<std::uint8_t>>> others;
  network.receive_aside = [&](peer::PeerNumber from, std::vector<std::uint8_t> bytes) {
    if (bytes.size() != 1 || bytes[0] != word) others.emplace_back(from, std::move(bytes));
    else if (from == 0) start_s = now_s();
    else ++ready;
    return true;
  };
  if (network.number() != 0) network.send_aside(0, {word});
  while (network.number() == 0 ? ready < count : !start_s) {
    if (is_interrupted) throw SessionError(ExitStatus::interrupted, "interrupted");
    network.rest_until(now_s() + look_s);
  }
  network.receive_aside = {};
  // A peer that received it earlier may have begun.
  for (auto& [from, bytes] : others) network.defer(from, std::move(bytes));
  if (start_s) return *start_s;
  for (peer::PeerNumber to = 1; to < count; ++to) network.send_aside(to, {word});
  return now_s();
}

}  // namespace rink::game
