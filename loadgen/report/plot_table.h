// The figures behind a plot, as a file and as a table on the page.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "loadgen/report/provenance.h"

namespace rink::loadgen {

/// `name` becomes plots/NAME.csv; a column's unit is part of its name.
struct PlotTable {
  std::string name, about;  ///< `about` is a sentence about what a row is
  std::vector<std::string> columns;
  std::vector<std::vector<std::string>> rows{};  ///< each as long as `columns`

  bool is_empty() const { return rows.empty(); }
};

/// Comma-separated (RFC 4180) below comment lines that start with `# ` and hold `about` and the
/// provenance; readers that know no comments skip them by that sign.
std::string to_csv(const PlotTable& table, const Provenance& provenance);

/// A closed `<details>` with the rows, or with the file's name if there are too many to scroll
/// through.
std::string to_details(const PlotTable& table);

}  // namespace rink::loadgen
