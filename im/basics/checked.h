// States whether this build re-checks whole data structures after each of their changes.
#pragma once

namespace rink {

/// A check of a whole structure takes time in proportion to its size, which only tests under the
/// address sanitizer can afford. Single assertions are on wherever NDEBUG is not defined.
#if defined(__SANITIZE_ADDRESS__)
inline constexpr bool checks_whole_structures = true;
#elif !defined(__has_feature)
inline constexpr bool checks_whole_structures = false;
#elif __has_feature(address_sanitizer)
inline constexpr bool checks_whole_structures = true;
#else
inline constexpr bool checks_whole_structures = false;
#endif

}  // namespace rink
