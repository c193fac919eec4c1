// Tells the user which cell runs and how long the rest will take.
#pragma once

#include <cstddef>
#include <ostream>

#include "loadgen/run_record.h"

namespace rink::loadgen {

/// One line that is overwritten in place on a terminal, one plain line per finished cell elsewhere.
class Progress {
 public:
  /// `expected_cell_s` [s] is the guess until cells have finished; after that their mean is.
  Progress(std::ostream& out, bool is_terminal, std::size_t cell_count, double expected_cell_s);
  /// Cell number `finished_count() + 1` starts.
  void starts(const Cell& cell);
  /// It ended after `took_s` [s]. An invalid one is always named with its reason.
  void finished(const RunRecord& record, double took_s);
  /// Clears the line that is overwritten in place.
  void clear();
  std::size_t finished_count() const { return finished_count_; }
  /// The time that the cells not yet finished will take [s].
  double left_s() const;

 private:
  std::ostream& out_;
  bool is_terminal_;
  std::size_t cell_count_;
  double expected_cell_s_;
  std::size_t finished_count_ = 0;
  double spent_s_ = 0.0;
};

}  // namespace rink::loadgen
