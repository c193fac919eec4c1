// Reasons why peers cannot play together, as texts for users.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "game/net/peer/network/greetings.h"

namespace rink::game {

/// A newcomer's difference, with both sides; nothing if there is none.
std::optional<std::string> difference(const Fingerprint& theirs, const Fingerprint& ours);
/// The text for another version of the protocol.
std::string other_version(std::uint32_t theirs);
/// The text for who wants more bats than are free of those that there are.
std::string too_few_bats(std::uint32_t wanted, std::uint32_t all, std::uint32_t free);

}  // namespace rink::game
