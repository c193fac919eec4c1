// Why peers cannot play together, in words for their users.
#pragma once

#include <optional>
#include <string>

#include "game/net/peer/network/greetings.h"

namespace rink::game {

/// What is different about a newcomer, with both sides; nothing if nothing is.
std::optional<std::string> difference(const Fingerprint& theirs, const Fingerprint& ours);
/// Of another version of the protocol than ours.
std::string other_version(std::uint32_t theirs);

}  // namespace rink::game
