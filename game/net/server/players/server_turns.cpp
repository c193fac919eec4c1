// Decides when a server may tick; TickGrid places ticks in logical time.
#include "game/net/server/players/server_turns.h"

namespace rink::game {

Pace ServerTurns::pace() const {
  return {.ticks_per_second = 1.0 / settings_.tick_s,
          .is_synchronous = settings_.is_synchronous,
          .is_time_managed = settings_.is_time_managed,
          .is_late = is_called_};
}

std::optional<double> ServerTurns::wanted(double played, double granted) const {
  if (!settings_.is_time_managed || !is_started_) return std::nullopt;
  const double wanted = grid().turns_heard(played);
  return granted < wanted ? std::optional(wanted) : std::nullopt;
}

bool ServerTurns::may_step(bool are_all_turns_done, double played, double granted) const {
  if (is_within_tick_) return true;
  return settings_.is_time_managed ? granted >= grid().turns_heard(played) : are_all_turns_done;
}

}  // namespace rink::game
