// How long the windows of the tests of sessions are, and what becomes of a peer.
#pragma once

#include <cstdint>

namespace rink::peer::test {

inline constexpr double window_length = 0.01;  // s

enum class Fate : std::uint8_t { away, playing, done, killed, halted, left };

}  // namespace rink::peer::test
