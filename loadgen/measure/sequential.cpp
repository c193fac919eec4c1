// Half widths from the rows' means and deviations.
#include "loadgen/measure/sequential.h"

#include <cassert>
#include <charconv>
#include <cmath>
#include <numbers>

#include "loadgen/measure/formatted.h"
#include "loadgen/measure/statistics/distributions.h"

namespace rink::loadgen {

double confidence_of_look(std::uint32_t look) {
  assert(look > 0 && "looks are counted from 1");
  const double pi_look = std::numbers::pi * static_cast<double>(look);
  return 1.0 - (1.0 - interval_confidence) * 6.0 / (pi_look * pi_look);
}

std::vector<WideRow> wider_rows(std::span<const SummaryRow> rows, double width,
                                std::uint32_t look) {
  assert(width > 0.0 && look > 0);
  std::vector<WideRow> wide;
  for (const SummaryRow& row : rows) {
    const Statistic& payload = row.of("down_bytes_per_client_per_s");
    const std::string name = name_of(row).substr(0, name_of(row).rfind("-seed"));
    if (!payload.mean || !payload.deviation || !(*payload.mean > 0.0)) {
      wide.push_back({row.valid_runs, "the payload of " + name + " has no interval"});
      continue;
    }
    assert(row.valid_runs > 1 && "a deviation needs two");
    const auto runs = static_cast<double>(row.valid_runs);
    const double half = student_t_quantile(0.5 + 0.5 * confidence_of_look(look), runs - 1.0) *
                        *payload.deviation / std::sqrt(runs) / *payload.mean;
    if (half <= width) continue;
    wide.push_back({row.valid_runs, "the payload of " + name +
                                        formatted(" is known to within %.3g %% only, not %.3g %%",
                                                  100.0 * half, 100.0 * width)});
  }
  return wide;
}

double width_in(const std::string& text) {
  double number = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  const std::string rest(end, text.data() + text.size());
  if (rest == "%") number /= 100.0;
  if (error != std::errc() || (!rest.empty() && rest != "%") || !(number > 0.0 && number < 1.0))
    throw ExperimentError("--until-width " + text +
                          ": allowed is a fraction above 0 and below 1, such as 0.05 or 5%");
  return number;
}

}  // namespace rink::loadgen
