// Collects cells as text, then sets each column as wide as its widest.
#include "bench/column_reporter.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cstdio>
#include <iostream>

namespace rink::bench {
namespace {

std::string digits(double value) {
  std::array<char, 32> text;
  std::snprintf(text.data(), text.size(), "%.4g", value);
  return text.data();
}

/// Without how long it was measured and by which clock.
std::string name_of(const benchmark::BenchmarkReporter::Run& run) {
  std::string name = run.run_name.function_name;
  for (const std::string* part : {&run.run_name.args, &run.aggregate_name})
    if (!part->empty()) name += "/" + *part;
  return name;
}

}  // namespace

void ColumnReporter::ReportRuns(const std::vector<Run>& runs) {
  for (const Run& run : runs) {
    std::vector<std::string> row{name_of(run)};
    std::cerr << row.front() << (run.error_occurred ? ": " + run.error_message : "") << "\n";
    is_sound_ = is_sound_ && !run.error_occurred;
    row.push_back(run.error_occurred ? "failed"
                                     : digits(run.GetAdjustedRealTime()) + " " +
                                           benchmark::GetTimeUnitString(run.time_unit));
    for (const std::string& counter : counters_) {
      const auto found = run.counters.find(counter);
      row.push_back(found == run.counters.end() ? "-" : digits(found->second.value));
    }
    assert(row.size() == 2 + counters_.size());
    rows_.push_back(std::move(row));
  }
}

std::string ColumnReporter::unknown_counter() const {
  for (std::size_t i = 0; i < counters_.size(); ++i)
    if (std::ranges::all_of(rows_, [i](const auto& row) { return row[i + 2] == "-"; }))
      return counters_[i];
  return {};
}

void ColumnReporter::Finalize() {
  std::vector<std::string> head{"benchmark", "time"};
  head.insert(head.end(), counters_.begin(), counters_.end());
  rows_.insert(rows_.begin(), head);
  std::vector<std::size_t> widths(head.size(), 0);
  for (const auto& row : rows_)
    for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], row[i].size());
  for (const auto& row : rows_) {
    std::cout << row[0] << std::string(widths[0] - row[0].size(), ' ');
    for (std::size_t i = 1; i < row.size(); ++i)
      std::cout << "  " << std::string(widths[i] - row[i].size(), ' ') << row[i];
    std::cout << "\n";
  }
  std::cout << std::flush;
  rows_.erase(rows_.begin());
}

}  // namespace rink::bench
