// Reasons why peers cannot play together, as texts for users.
#pragma once

#include <optional>
#include <string>

#include "game/net/peer/network/greetings.h"

namespace rink::game {

/// A newcomer's difference, with both sides; nothing if there is none.
std::optional<std::string> difference(const Fingerprint& theirs, const Fingerprint& ours);
/// The text for another version of the protocol.
std::string other_version(std::uint32_t theirs);

}  // namespace rink::game
