// What may follow a scheme: each stage takes filters and is one, so that any number of them stand
// behind any scheme.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "im/filter.h"

namespace rink::im {

/// Relevant from when `enter` says so until `stay`, the same scheme, no longer says so of a
/// subscription that is `margin` [m] larger on each side.
std::unique_ptr<Filter> make_hysteresis(std::unique_ptr<Filter> enter, std::unique_ptr<Filter> stay,
                                        double margin);

/// Who enters stays for `matches` matches at least.
std::unique_ptr<Filter> make_dwell(std::unique_ptr<Filter> inner, std::uint32_t matches);

/// Tier k: within `fractions[k]` (above 0, ascending) of the subscription's disc, by the rule of
/// `aura`, of which `rings` has one for each; who is in none has the last.
std::unique_ptr<Filter> make_tiers(std::unique_ptr<Filter> inner,
                                   std::vector<std::unique_ptr<Filter>> rings,
                                   std::vector<double> fractions);

/// Hands `inner` regions that reach over the next `horizon` seconds of their flights, never less
/// than half of it, and works out when who is with whom: by rectangles, or by the disc of the
/// subscription.
std::unique_ptr<Filter> make_swept(std::unique_ptr<Filter> inner, double horizon, double drag,
                                   bool is_disc);

/// Orders what is relevant by what it is due (im/stages/priority_order.h), for who sends at most
/// `budget` bytes to a subscriber between two matches; 0: any.
std::unique_ptr<Filter> make_priority(std::unique_ptr<Filter> inner, std::size_t budget);

}  // namespace rink::im
