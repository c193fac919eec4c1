// A peer's knowledge at the end of a window, as plain values for a drawing thread.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "game/match/zones_seen.h"
#include "game/model/key.h"
#include "game/physics/flight/motion.h"

namespace rink::game {

using physics::Vector2;

struct KnownBody {
  enum class Source : std::uint8_t { own, ghost, told };
  std::uint32_t body = 0;
  Source source = Source::own;
  bool is_in_play = true;    ///< not in a goal
  physics::Motion motion;    ///< since its last event
  Vector2 thrust{0.0, 0.0};  ///< of bats [m/s^2]
};

struct PeerSight {
  double time = 0.0, since = 0.0;  ///< the window's end, and its start [s]
  std::uint64_t window = 0;
  std::vector<KnownBody> bodies;  ///< bats and pucks
  std::uint32_t own_bat = 0;      ///< a body, which may be far from here
  Vector2 own_position{0.0, 0.0}, own_velocity{0.0, 0.0};
  KeysHeld own_held;           ///< by the keys in effect
  std::uint32_t own_felt = 0;  ///< keys
  std::uint32_t goals_left = 0, goals_right = 0;
  ZonesSeen zones;
  std::uint64_t bytes_sent = 0;
};

/// The stage of a peer's session.
struct PeerStage {
  enum class Step : std::uint8_t { gathering, countdown, playing, over, lost };
  Step step = Step::gathering;
  std::string words;         ///< for the player: what the peer waits for, why it is lost, how it
                             ///< ended
  double begins_in_s = 0.0;  ///< of a countdown: real time, when it began
  std::optional<std::uint32_t> player;  ///< the number of its player, once that is known
  std::string notice;                   ///< the latest notice about others
  std::uint32_t notice_count = 0;
};

}  // namespace rink::game
