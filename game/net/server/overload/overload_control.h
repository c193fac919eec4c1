// How much less often a server tells its clients while it has more of them than it holds.
#pragma once

#include <cstdint>

namespace rink::game {

/// Follows the ticks of a server by the clock that it is handed. While they run late and do not
/// catch up, each client is sent one of `divisor()` of its updates; when there is time again, more
/// of them (docs/rti.md, "Overload").
class OverloadControl {
 public:
  struct Settings {
    double tick_s = 1.0 / 30.0;
    double late_s = 0.5;         ///< ticks run late for so long before clients are told less often
    double calm_s = 2.0;         ///< and in time for so long before they are told more often
    double calm_max_s = 64.0;    ///< to which that doubles while clients cannot be told more often
    double load_max = 0.75;      ///< part of a tick that may be work after they are
    double behind_max_s = 1.0;   ///< ticks that are further behind than that are left out
    double told_within_s = 2.0;  ///< each client, where the game alone takes too long
  };
  static constexpr std::uint32_t divisor_max = 16;

  explicit OverloadControl(const Settings& settings);

  /// A tick was due at `due_s`, worked from `begin_s` on and ended at `end_s` [s], not before
  /// (asserted); `telling_s` [s] of that were for its clients. True if `divisor()` has changed.
  bool ticked(double due_s, double begin_s, double end_s, double telling_s);
  /// How many ticks from the one that was due at `due_s` on are left out at `now_s` [s], so that
  /// what clients receive is never much older than `behind_max_s`; the game goes on at full pace.
  std::uint64_t ticks_left_out(double due_s, double now_s) const;

  /// 1: as often as asked for; up to `divisor_max`.
  std::uint32_t divisor() const { return divisor_; }
  std::uint32_t divisor_reached() const { return divisor_reached_; }  ///< the largest so far
  std::uint64_t changes() const { return changes_; }                  ///< of the divisor so far

 private:
  struct Stretch {  ///< of ticks that were all late or all in time
    std::uint64_t ticks = 0;
    double from_s = 0.0, busy_s = 0.0, telling_s = 0.0;
  };
  bool slow_down(double end_s);
  bool share_out(double between_s, double telling_s);
  bool speed_up(double end_s);
  bool change_to(std::uint32_t divisor);

  Settings settings_;
  Stretch late_, calm_;
  double calm_needed_s_;
  double sped_up_s_ = 0.0;
  bool has_sped_up_ = false;
  std::uint32_t divisor_ = 1, divisor_reached_ = 1;
  std::uint32_t divisor_most_ = divisor_max;  ///< while the game alone takes too long
  std::uint64_t changes_ = 0;
};

}  // namespace rink::game
