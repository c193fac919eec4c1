// What was measured, as text for a terminal and as rows for files.
#pragma once

#include <optional>
#include <span>
#include <string>

#include "bench/accuracy/diagram.h"
#include "bench/accuracy/stability.h"
#include "loadgen/report/plot_table.h"

namespace rink::accuracy {

/// What a contender needs to err by no more than the panel's target, in words and relative to the
/// exact engine's run time in the same panel.
struct Standing {
  std::string run_ms;  ///< "12.3", "< 0.4" if its longest step is better already, "> 300" if no
                       ///< step got there, "-" if it has no point
  std::string
      ratio;  ///< run time relative to the exact engine, in the same forms; "-" if that was not run
  std::optional<double> least_ratio{};  ///< the ratio is this, or more where is_bound
  bool is_bound = false;                ///< no step got there: the ratio is at least this
};
Standing standing_of(const Panel& panel, const Series& series);

/// One line per contender: at 1/60 s, at its finest step, and at the target.
std::string text_of(const Panel& panel);
/// One line per contender.
std::string text_of(const Ordeal& ordeal);

/// What the two kinds of tables mean, to stand below them.
extern const char* const panel_legend;
extern const char* const ordeal_legend;

/// Which of the other libraries gets to the target with the shortest run, and which takes the
/// shortest for steps of 1/60 s, relative to the exact engine; says so if Box2D v3 is not among
/// them, for no claim is against the best without it. Empty if
/// the panel lacks the exact engine or all peers.
std::string best_stepper_of(const Panel& panel);

/// The ratios of the peers in one sentence, with the best stepper; empty if the panel lacks the
/// exact engine or all peers.
std::string headline_of(const Panel& panel);

/// A row per point, per trial and contender.
loadgen::PlotTable points_table(const std::string& name, std::span<const Panel> panels);
loadgen::PlotTable stability_table(std::span<const Ordeal> ordeals);

/// A metre in scientific notation with two digits, `0`, or `-` for what is not finite.
std::string metres(double value);

}  // namespace rink::accuracy
