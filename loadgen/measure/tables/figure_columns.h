// Columns of the tables that show figures of nodes: means, and below them how well they are known.
#pragma once

#include <cassert>
#include <cmath>
#include <cstddef>
#include <optional>
#include <span>
#include <string>

#include "loadgen/measure/statistics/distributions.h"
#include "loadgen/measure/statistics/statistics.h"
#include "loadgen/measure/summary.h"
#include "loadgen/measure/tables/table_number.h"

namespace rink::loadgen {

struct FigureColumn {
  const char *title, *figure;
  double scale = 1.0;  ///< from the figure's unit to the column's
};

inline std::string padded(const std::string& text, std::size_t width) {
  return std::string(text.size() < width ? width - text.size() : 0, ' ') + text;
}

inline constexpr std::size_t figure_column_width = 7;

inline std::string titles_of(std::span<const FigureColumn> columns) {
  std::string text;
  for (const FigureColumn& column : columns)
    text += " " + padded(column.title, figure_column_width);
  return text;
}

inline std::string means_of(const SummaryRow& row, std::span<const FigureColumn> columns) {
  std::string text;
  for (const FigureColumn& column : columns)
    text +=
        " " + padded(table_number(row.of(column.figure).mean, column.scale), figure_column_width);
  return text;
}

/// Student's t times the standard error: about half the width of the interval, which keeps above 0
/// and is not symmetric.
inline std::optional<double> margin(const Statistic& statistic, std::size_t runs) {
  if (!statistic.deviation) return std::nullopt;
  assert(runs > 1);
  const auto count = static_cast<double>(runs);
  return student_t_quantile(0.5 + 0.5 * interval_confidence, count - 1.0) * *statistic.deviation /
         std::sqrt(count);
}

inline std::string margins_of(const SummaryRow& row, std::span<const FigureColumn> columns) {
  std::string text;
  for (const FigureColumn& column : columns)
    text += " " + padded(table_number(margin(row.of(column.figure), row.valid_runs), column.scale),
                         figure_column_width);
  return text;
}

}  // namespace rink::loadgen
