// A quiet tune that goes round, made in code.
#pragma once

#include <cstdint>
#include <vector>

namespace rink::view {

/// Mono, so many samples a second; its end leads into its beginning.
std::vector<std::int16_t> music_loop(int rate);

}  // namespace rink::view
