// A narrow table of benchmarks: a row each, with the counters that were asked for.
#pragma once

#include <benchmark/benchmark.h>

#include <string>
#include <vector>

namespace rink::bench {

/// Prints its table when all benchmarks have run, and until then says on standard error which did.
class ColumnReporter : public benchmark::BenchmarkReporter {
 public:
  /// Columns are the name, the time of an iteration and `counters`, in that order.
  explicit ColumnReporter(std::vector<std::string> counters) : counters_(std::move(counters)) {}

  bool ReportContext(const Context&) override { return true; }
  void ReportRuns(const std::vector<Run>& runs) override;
  void Finalize() override;

  /// False if a benchmark failed, which the table and standard error say.
  bool is_sound() const { return is_sound_; }
  /// The first of the counters that no benchmark has; empty if there is none.
  std::string unknown_counter() const;

 private:
  std::vector<std::string> counters_;
  std::vector<std::vector<std::string>> rows_;
  bool is_sound_ = true;
};

}  // namespace rink::bench
