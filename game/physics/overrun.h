// Which bodies spent a budget of events, and why.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "game/physics/event_budget.h"
#include "game/physics/world.h"

namespace rink::physics::inline RINK_PRECISION {

/// Why a body has so many events; the first that holds.
enum class OverrunReason : std::uint8_t {
  pressed,  ///< thrust presses it: it hops in a cluster, or meets a bat under thrust
  no_room,  ///< between two of its events it goes less than a millionth of its size
  light,    ///< its mass is at most a hundredth of that of a body it meets, which makes it fast
  common,   ///< nothing that most others have not: the scene has so many events
  fast      ///< it goes far between its events, but so fast that they are many
};

/// As they stand in files, in order of the enumeration.
inline constexpr std::array overrun_reason_names{"pressed", "no_room", "light", "common", "fast"};

struct BusyBody {
  BodyId body;
  double share = 0.0;  ///< of the events looked at; those of two bodies are counted for both
  std::optional<BodyId> partner{};  ///< the body in most of them; nothing: most were with the field
  double free_path = 0.0;           ///< at most what it goes between two of its events, on average:
                                    ///< at the speed of the fastest looked at [m]
  double mass_ratio = 0.0;          ///< of the heaviest that it met and that moves to itself; 0:
                                    ///< it met nobody
  OverrunReason reason = OverrunReason::common;
};

/// Why a budget was exceeded, told from the last events that it was charged with.
struct Overrun {
  static constexpr std::size_t busiest_max = 5;

  Real time = 0.0;                  ///< reached [s]
  std::uint64_t events = 0;         ///< of the second in which it was exceeded
  std::uint64_t events_per_s = 0;   ///< that were allowed
  std::size_t looked_at = 0;        ///< events
  Real span = 0.0;                  ///< of simulated time that these took [s]
  std::vector<BusyBody> busiest{};  ///< at most busiest_max, the busiest first, then by number
};

/// Of a budget that `world` has just exceeded (asserted).
Overrun overrun_of(const World& world, const EventBudget& budget);

/// In one line, without an end: when, how many, who and why.
std::string text_of(const Overrun& overrun);

}  // namespace rink::physics::inline RINK_PRECISION
