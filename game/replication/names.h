// Names that the server and its clients share.
#pragma once

#include <cstdint>
#include <string>

namespace rink::game {

/// The synchronisation point that every federate reaches before the first tick.
inline constexpr const char* start_barrier = "start";

/// Federates of this type get a bat; others only watch.
inline constexpr const char* player_federate_type = "player";

inline constexpr const char* watcher_federate_type = "watcher";

/// The RTI object that player `player` plays.
inline std::string bat_name(std::uint32_t player) { return "bat-" + std::to_string(player); }

}  // namespace rink::game
