// The rest is estimated from the run so far: simulated time passes evenly in most scenes.
#include "game/control/simulate_progress.h"

#include <cassert>
#include <cstdio>

namespace rink::game {

void SimulateProgress::reached(double simulated_s, std::uint64_t event_count, double wall_s) {
  assert(simulated_s >= 0.0 && wall_s >= 0.0);
  if (wall_s < next_s_ || simulated_s >= until_) return;
  next_s_ = wall_s + (is_terminal_ ? between_overwrites_s : between_lines_s);
  const double part = simulated_s / until_;
  char text[160];
  std::snprintf(text, sizeof text, "%.6g of %.6g s simulated (%.1f %%), %.4g events, %.0f s passed",
                simulated_s, until_, 100.0 * part, static_cast<double>(event_count), wall_s);
  out_ << (is_terminal_ ? "\r\033[K" : "") << text;
  if (part > 0.0) {
    std::snprintf(text, sizeof text, ", about %.3g s left", wall_s * (1.0 - part) / part);
    out_ << text;
  }
  out_ << (is_terminal_ ? "" : "\n") << std::flush;
  is_shown_ = is_terminal_;
}

void SimulateProgress::clear() {
  if (is_shown_) out_ << "\r\033[K" << std::flush;
  is_shown_ = false;
}

}  // namespace rink::game
