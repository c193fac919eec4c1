// Whether engines come through what is hard, and in what state.
#pragma once

#include <atomic>
#include <string>
#include <vector>

#include "bench/trials/contender.h"
#include "bench/trials/trial.h"

namespace rink::accuracy {

/// Looked at after each sixtieth of a second.
struct Wear {
  double overlap = 0.0;        ///< the deepest of all looks [m], by one measure for all engines
                               ///< (bench/peers/overlap.h); of what has not escaped
  double start_overlap = 0.0;  ///< at the start [m]
  std::uint32_t escapes = 0;   ///< bodies outside the field at the end
  bool is_finite = true;       ///< every place and speed of every look is a number
  double energy_error = 0.0;   ///< largest gain over what thrust put in, in a conservative trial
                               ///< also loss, relative to all energy that there was or was put in
  double events_per_s = 0.0;   ///< physical events (a peer: new contacts) per simulated second
  double run_s = 0.0;          ///< processor time per simulated second [s]

  bool has_survived() const { return is_finite && escapes == 0; }
};

struct Survival {
  Contender contender;
  double dt = 0.0;
  bool is_done = false;
  Wear wear{};
  std::string why_not{};  ///< if not done

  /// "yes", or why not in a few words.
  std::string verdict() const;
};

struct Ordeal {
  Trial trial;
  std::vector<Survival> survivals{};
};

/// In this process; may never end.
Wear endure(const Trial& trial, const Contender& contender, double dt);

/// In a process of its own that is ended after `limit_s`.
Survival try_to_survive(const Trial& trial, const Contender& contender, double dt, double limit_s,
                        const std::atomic<bool>& is_interrupted);

}  // namespace rink::accuracy
