// Memory asked for ahead of its use.
#pragma once

namespace rink::physics {

/// Asks the processor to fetch the cache line of `place`, to be written too. g++ holds a function
/// that only does that for one that does nothing, and drops its calls; hence the empty statement.
[[gnu::always_inline]] inline void prefetch(const void* place) {
  __builtin_prefetch(place, 1);
  asm volatile("");
}

}  // namespace rink::physics
