// Shows the user which cell runs and how long the rest will take.
#pragma once

#include <cstddef>
#include <functional>
#include <ostream>

#include "loadgen/measure/run_record.h"

namespace rink::loadgen {

/// One line that is overwritten in place on a terminal, one plain line per finished cell elsewhere.
class Progress {
 public:
  /// `expected_cell_s` [s] is the guess until cells have finished; after that their mean is.
  Progress(std::ostream& out, bool is_terminal, std::size_t cell_count, double expected_cell_s);

  /// Estimates the time left from now on by each cell's expected time, of which `all_s` [s] are
  /// still to come, corrected by the ratio for finished cells.
  void expect(std::function<double(const Cell&)> cell_s, double all_s) {
    expected_of_ = std::move(cell_s), expected_s_ = all_s;
  }

  /// The cell after those that have finished starts.
  void starts(const Cell& cell);
  /// The cell ended after `took_s` [s]. An invalid one is always named with its reason.
  void finished(const RunRecord& record, double took_s);
  /// Clears the line that is overwritten in place.
  void clear();
  /// The time that the cells not yet finished will take [s].
  double left_s() const;

 private:
  std::ostream& out_;
  bool is_terminal_;
  std::size_t cell_count_;
  double expected_cell_s_;
  std::function<double(const Cell&)> expected_of_;
  double expected_s_ = 0.0,
         expected_done_s_ = 0.0;  ///< of all cells, and of those that have finished
  std::size_t finished_count_ = 0;
  double spent_s_ = 0.0;
};

}  // namespace rink::loadgen
