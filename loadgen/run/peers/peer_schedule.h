// The events at known instants of a game among peers.
#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "game/model/key.h"

namespace rink::loadgen {

/// The keys of a game, and the instants at which decisions are noted and players are asked what
/// they see, each in order of time. Instants are simulated [s]; the game starts at the real time
/// `start_s`.
class PeerSchedule {
 public:
  void plan_keys(std::vector<game::InputEvent> keys) { keys_ = std::move(keys); }
  void plan_samples(std::vector<double> decisions, std::vector<double> samples) {
    decisions_.instants = std::move(decisions);
    samples_.instants = std::move(samples);
  }

  /// The instant of the next event; infinite if there is none.
  double next_s() const {
    const double key_s = next_key_ < keys_.size() ? keys_[next_key_].time : never;
    return std::min({key_s, decisions_.next_s(), samples_.next_s()});
  }
  /// The next key that is due at the real time `now_s`; null if none is. Valid for good.
  const game::InputEvent* take_key(double start_s, double now_s) {
    const bool is_due = next_key_ < keys_.size() && start_s + keys_[next_key_].time <= now_s;
    return is_due ? &keys_[next_key_++] : nullptr;
  }
  std::optional<double> take_decision(double simulated_s) { return decisions_.take(simulated_s); }
  std::optional<double> take_sample(double simulated_s) { return samples_.take(simulated_s); }

 private:
  static constexpr double never = std::numeric_limits<double>::infinity();
  struct Instants {
    std::vector<double> instants;
    std::size_t next = 0;
    double next_s() const { return next < instants.size() ? instants[next] : never; }
    std::optional<double> take(double now_s) {
      return next_s() <= now_s ? std::optional(instants[next++]) : std::nullopt;
    }
  };

  std::vector<game::InputEvent> keys_;
  std::size_t next_key_ = 0;
  Instants decisions_, samples_;
};

}  // namespace rink::loadgen
