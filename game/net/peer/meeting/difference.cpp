// The words for each difference.
#include "game/net/peer/meeting/difference.h"

#include <cinttypes>
#include <cstdio>

namespace rink::game {

namespace {

std::string in_hexadecimal(std::uint64_t number) {
  char text[17];
  std::snprintf(text, sizeof text, "%016" PRIx64, number);
  return text;
}

}  // namespace

std::optional<std::string> difference(const Luggage& theirs, const Luggage& ours) {
  const auto both = [](std::uint64_t a, std::uint64_t b) {
    return in_hexadecimal(a) + ", here it is " + in_hexadecimal(b);
  };
  if (theirs.scene != ours.scene)
    return "it has another scene: its fingerprint is " + both(theirs.scene, ours.scene);
  if (theirs.self_test != ours.self_test)
    return "it is a build that computes other bits: the hash of its self-test is " +
           both(theirs.self_test, ours.self_test);
  if (theirs.keys != ours.keys)
    return "it has other keys: their hash is " + both(theirs.keys, ours.keys);
  return std::nullopt;
}

std::string other_version(std::uint32_t theirs) {
  return "it speaks version " + std::to_string(theirs) +
         " of the peers' protocol, here it is version " + std::to_string(peer_protocol_version);
}

}  // namespace rink::game
