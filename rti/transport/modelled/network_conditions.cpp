// Finds the conditions of a link, and checks their numbers.
#include "rti/transport/modelled/network_conditions.h"

namespace rink::rti {

std::string LinkConditions::objection() const {
  constexpr std::int64_t hour_ns = 3'600'000'000'000;
  const auto is_time = [](std::int64_t time_ns) { return time_ns >= 0 && time_ns <= hour_ns; };
  const auto is_fraction = [](double fraction) { return fraction >= 0.0 && fraction <= 1.0; };
  if (!is_time(latency_ns) || !is_time(jitter_ns) || !is_time(held_ns))
    return "times must be 0 to an hour";
  if (!loss.is_possible()) return "no chain of losses has these probabilities: they must be 0 to 1";
  if (!is_fraction(reorder) || !is_fraction(duplicate)) return "fractions must be 0 to 1";
  if (rate_bits_per_s > 100'000'000'000) return "the rate must be at most 10^11 bits per second";
  if (rate_bits_per_s > 0 && queue_bytes < 1500)
    return "the queue must take the largest packet, 1500 bytes";
  return "";
}

const LinkConditions& NetworkConditions::of(std::uint32_t link, LinkDirection direction) const {
  const bool is_up = direction == LinkDirection::to_listener;
  for (auto exception = exceptions.rbegin(); exception != exceptions.rend(); ++exception)
    if (link >= exception->first && link <= exception->last)
      return is_up ? exception->to_listener : exception->from_listener;
  return is_up ? to_listener : from_listener;
}

}  // namespace rink::rti
