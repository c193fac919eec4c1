// A user's assertion about a comparison, e.g. `down_bytes_per_client_per_s[scheme=none] /
// down_bytes_per_client_per_s[scheme=region] >= 20`.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "loadgen/experiment/experiment.h"
#include "loadgen/measure/summary.h"

namespace rink::loadgen {

struct AssertionNode;

/// Grammar, loosest first: `or`, `and`, `not`, one comparison (< <= > >= == !=), + -, * /, unary -,
/// and numbers, parentheses, figures. A figure is the name of one in summary.csv
/// (`update_age_ms_p99`), standing for its mean over the replications, or that name and _low, _high
/// (ends of the 95 % interval), _sd, _min or _max; behind it [key=value, ...] picks cells by mode,
/// scheme, policy, clients, pucks, bats, server_cores, view_fraction, view_margin, sweep_ticks and
/// cell_size. What no selection picks is left open, and the demand must hold for every value of it:
/// `filter_recall[scheme=region] == 1` speaks of every number of clients, and the ratio above
/// compares cells that are alike in all but the scheme. Parameters that a scheme does not have are
/// passed over, as in the matrix.
class Assertion {
 public:
  /// Throws ExperimentError, which quotes the place, names what is wrong and what exists, if `text`
  /// is no demand that can be made of `experiment`.
  Assertion(const std::string& text, const Experiment& experiment);
  Assertion(Assertion&&) noexcept;
  ~Assertion();

  const std::string& text() const { return text_; }

  /// The result of an assertion.
  struct Finding {
    bool holds = false;
    std::string words;  ///< a line for each choice of cells: whether it holds, and the values of
                        ///< its figures; `undefined` is what was not measured, and fails
  };
  Finding judge(std::span<const SummaryRow> rows) const;

 private:
  std::string text_;
  std::unique_ptr<const AssertionNode> root_;
};

}  // namespace rink::loadgen
