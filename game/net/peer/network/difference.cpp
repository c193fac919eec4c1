// Describes each difference.
#include "game/net/peer/network/difference.h"

#include "im/basics/hexadecimal.h"

namespace rink::game {

std::optional<std::string> difference(const Fingerprint& theirs, const Fingerprint& ours) {
  const auto both = [](std::uint64_t a, std::uint64_t b) {
    return hexadecimal(a) + ", here it is " + hexadecimal(b);
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

std::string too_few_bats(std::uint32_t wanted, std::uint32_t all, std::uint32_t free) {
  return "it wants to play " + std::to_string(wanted) + " bats, of " + std::to_string(all) +
         " here " + std::to_string(free) + " are free";
}

}  // namespace rink::game
