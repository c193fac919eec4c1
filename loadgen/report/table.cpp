// Lays the summary out in columns.
#include "loadgen/report/table.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <string_view>
#include <vector>

#include "loadgen/experiment/parameter.h"
#include "loadgen/measure/formatted.h"
#include "loadgen/measure/tables/table_number.h"

namespace rink::loadgen {
namespace {

constexpr const char* payload = "down_bytes_per_client_per_s";
constexpr const char* error = "displayed_error_mm_rms";

std::string percent(const std::optional<double>& fraction) {
  if (!fraction) return "-";
  return formatted("%.*f%%", *fraction >= 0.99995 ? 0 : 1, std::floor(*fraction * 1e3) / 10.0);
}

/// Four decimals, never rounded up to 1.
std::string fraction_text(const std::optional<double>& fraction) {
  return fraction ? formatted("%.4f", *fraction >= 1.0 ? 1.0 : std::floor(*fraction * 1e4) / 1e4)
                  : "-";
}

/// The factor by which it is less than the baseline, with its interval.
std::string times_less(const std::optional<Ratio>& ratio) {
  if (!ratio) return "-";
  const Ratio less = ratio->inverse();
  if (!less.interval) return table_number(less.value) + " (one run)";
  return table_number(less.value) + " [" + table_number(less.interval->low) + ", " +
         table_number(less.interval->high) + "]" +
         (less.difference() == Difference::insignificant ? " ~" : "");
}

/// The parameters in which rows differ, and how long their schemes' names are.
struct Columns {
  std::vector<const ParameterKind*> parameters;
  std::size_t scheme_width = 7, policy_width = 9;
  auto begin() const { return parameters.begin(); }
  auto end() const { return parameters.end(); }
};

Columns columns_of(const std::vector<SummaryRow>& rows) {
  Columns columns;
  for (const SummaryRow& row : rows) {
    columns.scheme_width = std::max(columns.scheme_width, row.scheme.size());
    columns.policy_width = std::max(columns.policy_width, policy_name(row).size());
  }
  for (const ParameterKind& kind : parameter_kinds()) {
    std::set<double> values;
    for (const SummaryRow& row : rows)
      if (!kind.is_switch && kind.has(row)) values.insert(kind.of(row.parameters));
    if (values.size() > 1) columns.parameters.push_back(&kind);
  }
  return columns;
}

std::string heading(const Columns& columns) {
  std::string own;
  for (const ParameterKind* kind : columns) own += formatted(" %9s", kind->column);
  const std::string scheme = "scheme" + std::string(columns.scheme_width - 6, ' ');
  const std::string policy = "policy" + std::string(columns.policy_width - 6, ' ');
  return std::string(9 + columns.scheme_width + columns.policy_width + own.size(), ' ') +
         "  down   wire     times less    recall  displ.   age, ms     on     us per tick          "
         "  \n" +
         "clients " + scheme + " " + policy + own +
         "   kB/s   kB/s     [interval]    deliv. err., mm  p50   p99  time  phys. filter   send   "
         "n\n";
}

/// The row's values; `-` where its scheme lacks the parameter.
std::string values_of(const SummaryRow& row, const Columns& columns) {
  std::string text;
  for (const ParameterKind* kind : columns)
    text += formatted(
        " %9s",
        kind->has(row) ? formatted("%.6g", kind->scale * kind->of(row.parameters)).c_str() : "-");
  return text;
}

/// The other values of the row that are not the default, in words; parameters that differ have
/// columns, and the block's title has those that do not.
std::string rest_of(SummaryRow row) {
  row.parameters = Parameters{};
  return variant_of(row);
}

/// Parameters that no column shows and that are not the default, of the rows of the block that
/// `first` begins; the rate and the view stand in the title anyway.
std::string common_parameters(const std::vector<SummaryRow>& rows, const SummaryRow& first,
                              const Columns& columns) {
  std::string text;
  for (const ParameterKind& kind : parameter_kinds()) {
    const std::string_view key = kind.key;
    if (kind.is_switch || key == "tick_rate_hz" || key == "view_fraction" ||
        std::ranges::find(columns, &kind) != columns.end())
      continue;
    const auto shown = std::ranges::find_if(rows, [&](const SummaryRow& row) {
      return row.part == first.part && row.mode == first.mode && kind.has(row);
    });
    if (shown != rows.end() && kind.of(shown->parameters) != kind.of(Parameters{}))
      text += ", " + std::string(kind.before) + shortest(kind.of(shown->parameters)) + kind.after;
  }
  return text;
}

std::string line_of(const SummaryRow& row, const Baseline& baseline, const Columns& columns) {
  const auto mean = [&row](const char* name, double scale = 1.0) {
    return table_number(row.of(name).mean, scale);
  };
  const std::string runs = row.invalid_runs == 0
                               ? std::to_string(row.valid_runs)
                               : std::to_string(row.valid_runs) + "/" +
                                     std::to_string(row.valid_runs + row.invalid_runs);
  const bool is_baseline = baseline_of(row, baseline) == row;
  return formatted("%7u %-*s %-*s", row.clients, static_cast<int>(columns.scheme_width),
                   row.scheme.c_str(), static_cast<int>(columns.policy_width),
                   policy_name(row).c_str()) +
         values_of(row, columns) +
         formatted(" %6s %6s %18s %6s %8s %5s %5s %5s %6s %6s %6s %3s", mean(payload, 1e-3).c_str(),
                   mean("wire_bytes_per_client_per_s", 1e-3).c_str(),
                   is_baseline ? "baseline" : times_less(row.ratio(payload)).c_str(),
                   fraction_text(row.of("delivered_recall").mean).c_str(), mean(error).c_str(),
                   mean("update_age_ms_p50").c_str(), mean("update_age_ms_p99").c_str(),
                   percent(row.of("ticks_on_time_fraction").mean).c_str(),
                   mean("physics_us_per_tick").c_str(), mean("filter_us_per_tick").c_str(),
                   mean("send_us_per_tick").c_str(), runs.c_str());
}

bool is_same_game(const SummaryRow& a, const SummaryRow& b) {
  return a.mode == b.mode && a.part == b.part && a.clients == b.clients && a.pucks == b.pucks &&
         a.bats == b.bats && a.server_cores == b.server_cores;
}

bool has_fewest_bytes(const SummaryRow& row, const std::vector<SummaryRow>& rows) {
  const auto own = row.of(payload).mean;
  if (!own) return false;
  std::size_t rivals = 0;
  for (const SummaryRow& other : rows) {
    const auto theirs = other.of(payload).mean;
    if (!is_same_game(row, other) || !theirs || &row == &other) continue;
    ++rivals;
    if (*theirs < *own) return false;
  }
  return rivals > 0;
}

const RunRecord& run_of(const Cell& row, std::span<const RunRecord> runs) {
  return *std::find_if(runs.begin(), runs.end(),
                       [&row](const RunRecord& run) { return without_seed(run.cell) == row; });
}

/// The common values of all rows; those that differ have columns.
std::string block_title(const std::vector<SummaryRow>& rows, const SummaryRow& row,
                        const RunRecord& run, const Columns& columns) {
  const auto differs = [&columns](const std::string& key) {
    return std::any_of(columns.begin(), columns.end(),
                       [&key](const ParameterKind* kind) { return key == kind->key; });
  };
  const std::string view =
      run.view_area > 0.0        ? formatted(", each client sees %g m2", run.view_area)
      : differs("view_fraction") ? ""
                                 : formatted(", each client sees %g %% of the field",
                                             row.parameters.view_fraction * 100.0);
  return (row.part.empty() ? "" : row.part + ": ") + formatted("%.30s", row.mode.c_str()) +
         (differs("tick_rate_hz") ? "" : formatted(" at %g Hz", row.parameters.tick_rate_hz)) +
         view + common_parameters(rows, row, columns) +
         (run.transport == "tcp" && !row.part.empty() ? ", processes over TCP without delay"
          : run.transport == "udp"                    ? ", datagrams"
          : run.transport == "shm"                    ? ", shared memory"
          : run.transport == "bundle"                 ? ", clients share sockets"
                                                      : "") +
         (run.transport == "virtual" ? formatted(", virtual time with %g ms of delay", run.delay_ms)
                                     : "") +
         "\n";
}

/// The savings by filter and policy alone and together, a line for each row that has both.
std::string gains_text(const std::vector<SummaryRow>& rows, const Baseline& baseline) {
  std::string text;
  if (baseline.scheme.empty() || baseline.policy.empty()) return text;
  const auto row_of = [&rows](const Cell& cell) {
    return std::find(rows.begin(), rows.end(), cell);
  };
  constexpr std::ptrdiff_t lines_max =
      8;  // beyond so many rows only the row with the fewest bytes of each game
  const bool is_long = std::ranges::count_if(rows, [&](const SummaryRow& row) {
                         return row.scheme != baseline.scheme && row.policy != baseline.policy;
                       }) > lines_max;
  for (const SummaryRow& row : rows) {
    if (row.scheme == baseline.scheme || row.policy == baseline.policy || !row.ratio(payload) ||
        (is_long && !has_fewest_bytes(row, rows)))
      continue;
    const auto filter = row_of(baseline_of(row, row.scheme, baseline.policy)),
               policy = row_of(baseline_of(row, baseline.scheme, row.policy));
    const auto none = row_of(baseline_of(row, baseline.scheme, baseline.policy));
    if (filter == rows.end() || policy == rows.end()) continue;
    const std::string variant = variant_of(row);
    text += formatted("%u clients, %s with %.20s", row.clients, row.scheme.c_str(),
                      row.policy.c_str()) +
            (variant.empty() ? "" : " (" + variant + ")") +
            (row.mode == rows.front().mode ? "" : ", " + row.mode) +
            (row.part.empty() ? "" : ", " + row.part) + ": " + times_less(row.ratio(payload)) +
            " times less payload\n";
    text += "        filter alone " + times_less(filter->ratio(payload)) + ", policy alone " +
            times_less(policy->ratio(payload)) + "; displayed error " +
            table_number(row.of(error).mean) + " mm beside " + table_number(none->of(error).mean) +
            " mm\n";
  }
  return text.empty() ? text
                      : "gains over " + baseline.words() + ", 95 % intervals over seeds:\n" + text;
}

std::string agreement_text(std::span<const RunRecord> runs) {
  const Agreement agreement = agreement_of(runs);
  if (agreement.games == 0) return "state hash: no two runs were given the same keys\n";
  if (agreement.differing.empty())
    return "all cells of one seed ended in the same state hash: yes\n";
  std::string text = "all cells of one seed ended in the same state hash: NO\n";
  for (const std::string& difference : agreement.differing) text += "  " + difference + "\n";
  return text;
}

std::string invalid_text(std::span<const RunRecord> runs) {
  std::string text;
  for (const RunRecord& run : runs) {
    if (!run.valid)
      text += "invalid, not averaged in: " + name_of(run.cell) + ": " + run.why_invalid + "\n";
  }
  return text;
}

std::string explanation(const std::vector<SummaryRow>& rows, const Baseline& baseline) {
  const bool has_comparisons = std::any_of(rows.begin(), rows.end(), [&](const SummaryRow& row) {
    return baseline_of(row, baseline) != row;
  });
  std::string text =
      "down: payload to each client; wire: both directions with headers; displ. err.: displayed "
      "error, RMS;\n";
  text += has_comparisons
              ? "times less: than " + baseline.words() + ", 95 % interval over seeds;\n"
              : "nothing is compared: all cells are of the baseline, " + baseline.words() + ";\n";
  const auto any = [&rows](Difference difference) {
    return std::any_of(rows.begin(), rows.end(), [difference](const SummaryRow& row) {
      return row.ratio(payload) && row.ratio(payload)->difference() == difference;
    });
  };
  if (any(Difference::insignificant))
    text += "~: no significant difference, the interval contains 1;\n";
  if (any(Difference::unknown))
    text += "one run: the difference cannot be told from one replication;\n";
  const auto judged = std::find_if(rows.begin(), rows.end(),
                                   [](const SummaryRow& row) { return !row.relevance.empty(); });
  if (judged != rows.end()) text += "relevant is: " + judged->relevance + ";\n";
  return text + "n: runs averaged (valid/all); -: not measured, or too few samples to say\n";
}

}  // namespace

std::string table_of(std::span<const RunRecord> runs, bool is_coloured, const Baseline& baseline) {
  const std::vector<SummaryRow> rows = summarise(runs, baseline);
  const Columns columns = columns_of(rows);
  std::string text;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const bool is_new_block =
        i == 0 || rows[i].mode != rows[i - 1].mode || rows[i].part != rows[i - 1].part;
    if (is_new_block)
      text += (i == 0 ? "" : "\n") + block_title(rows, rows[i], run_of(rows[i], runs), columns) +
              heading(columns);
    if (!is_new_block && !is_same_game(rows[i], rows[i - 1])) text += "\n";
    const bool is_emphasised = is_coloured && has_fewest_bytes(rows[i], rows);
    text += (is_emphasised ? "\033[1;32m" : "") + line_of(rows[i], baseline, columns) +
            (is_emphasised ? "\033[0m" : "") + "\n";
    if (const std::string variant = rest_of(rows[i]); !variant.empty())
      text += "        " + variant + "\n";
  }
  return text + explanation(rows, baseline) + gains_text(rows, baseline) + agreement_text(runs) +
         invalid_text(runs);
}

}  // namespace rink::loadgen
