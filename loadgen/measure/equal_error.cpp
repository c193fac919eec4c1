// Interpolation along margins, then along the frontier of settings; then ratios paired by seed.
#include "loadgen/measure/equal_error.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <map>
#include <set>
#include <tuple>

#include "loadgen/experiment/csv_number.h"
#include "loadgen/measure/formatted.h"
#include "loadgen/measure/tables/table_number.h"

namespace rink::loadgen {
namespace {

using End = AtEqualError::End;

/// Error and bytes, in logarithms.
struct LogPoint {
  double error = 0.0, payload = 0.0, wire = 0.0;
};

LogPoint log_of(const RivalPoint& point) {
  assert(point.error_mm > 0.0 && point.payload > 0.0 && point.wire > 0.0);
  return {std::log(point.error_mm), std::log(point.payload), std::log(point.wire)};
}

LogPoint between(const LogPoint& a, const LogPoint& b, double part) {
  assert(part >= 0.0 && part <= 1.0);
  return {std::lerp(a.error, b.error, part), std::lerp(a.payload, b.payload, part),
          std::lerp(a.wire, b.wire, part)};
}

/// One setting's error and bytes at a recall of at least `recall`: those of its smallest margin if
/// that is enough already.
std::optional<LogPoint> at_recall(std::vector<RivalPoint> margins, double recall) {
  assert(!margins.empty());
  std::ranges::sort(margins, {}, &RivalPoint::margin);
  if (margins.front().recall >= recall) return log_of(margins.front());
  for (std::size_t i = 1; i < margins.size(); ++i) {
    const RivalPoint &below = margins[i - 1], &above = margins[i];
    if (below.recall < recall && above.recall >= recall)
      return between(log_of(below), log_of(above),
                     (recall - below.recall) / (above.recall - below.recall));
  }
  return std::nullopt;
}

std::vector<LogPoint> settings_at_recall(std::span<const RivalPoint> points, double recall) {
  std::map<std::pair<double, double>, std::vector<RivalPoint>> settings;
  for (const RivalPoint& point : points)
    settings[{point.setting_rate_hz, point.setting_threshold}].push_back(point);
  std::vector<LogPoint> found;
  for (const auto& [setting, margins] : settings)
    if (const auto point = at_recall(margins, recall)) found.push_back(*point);
  return found;
}

/// The points that no other beats in both error and bytes, by ascending error and descending bytes.
std::vector<LogPoint> frontier(std::vector<LogPoint> points, double LogPoint::*bytes) {
  std::ranges::sort(points, [bytes](const LogPoint& a, const LogPoint& b) {
    return std::pair(a.error, a.*bytes) < std::pair(b.error, b.*bytes);
  });
  std::vector<LogPoint> best;
  for (const LogPoint& point : points)
    if (best.empty() || point.*bytes < best.back().*bytes) best.push_back(point);
  assert(best.empty() == points.empty() && std::ranges::is_sorted(best, {}, &LogPoint::error));
  return best;
}

std::pair<double, End> bytes_at(const std::vector<LogPoint>& points, double error_mm,
                                double LogPoint::*bytes) {
  const std::vector<LogPoint> best = frontier(points, bytes);
  const double error = std::log(error_mm);
  if (best.empty() || best.front().error > error) return {0.0, End::not_reached};
  if (best.back().error < error) return {std::exp(best.back().*bytes), End::not_left};
  std::size_t i = 0;
  while (i + 1 < best.size() && best[i + 1].error <= error) ++i;
  if (best[i].error == error || i + 1 == best.size())
    return {std::exp(best[i].*bytes), End::bracketed};
  return {std::exp(between(best[i], best[i + 1],
                           (error - best[i].error) / (best[i + 1].error - best[i].error)).*
                   bytes),
          End::bracketed};
}

/// The less informative of two seeds' ends.
End worse(End a, End b) {
  if (a == End::not_reached || b == End::not_reached) return End::not_reached;
  return a == End::not_left ? a : b;
}

std::optional<RivalPoint> point_of(const RunRecord& run) {
  const auto& recall = run.truth.delivered_recall;
  const auto &error = run.truth.displayed_error_mm.rms, &payload = run.down_bytes_per_client_per_s,
             &wire = run.wire_bytes_per_client_per_s;
  if (!run.valid || !recall || !error || !payload || !wire ||
      !(*error > 0.0 && *payload > 0.0 && *wire > 0.0))
    return std::nullopt;
  const Parameters& own = run.cell.parameters;
  return RivalPoint{own.tick_rate_hz, own.threshold, own.view_margin, *recall, *error,
                    *payload,         *wire};
}

/// The conditions common to all compared policies.
using Conditions = std::tuple<std::string, double, std::string, std::uint32_t, std::uint32_t,
                              std::uint32_t, double, double>;

Conditions conditions_of(const RunRecord& run) {
  return {run.cell.mode,
          run.delay_ms,
          run.cell.scheme,
          run.cell.clients,
          run.cell.pucks,
          run.cell.bats,
          run.cell.parameters.view_fraction,
          run.view_area};
}

using PointsOfSeed = std::map<std::uint64_t, std::vector<RivalPoint>>;

/// Compares under one set of conditions.
class Comparison {
 public:
  void add(const RunRecord& run, const RivalPoint& point) {
    points_[run.cell.policy][run.cell.seed].push_back(point);
  }

  /// At the subject's own recall without a margin, or at `recall`.
  std::optional<EqualError> at(const std::string& subject, double rate_hz,
                               std::optional<double> recall) const {
    const auto own = points_.find(subject);
    if (own == points_.end()) return std::nullopt;
    EqualError result{.mode = {},
                      .scheme = {},
                      .subject = subject,
                      .rate_hz = rate_hz,
                      .is_own_recall = !recall,
                      .rivals = {}};
    std::map<std::uint64_t, RivalPoint> subjects;
    for (const auto& [seed, points] : own->second) {
      std::vector<RivalPoint> at_rate;
      std::ranges::copy_if(points, std::back_inserter(at_rate), [rate_hz](const RivalPoint& point) {
        return point.setting_rate_hz == rate_hz;
      });
      if (at_rate.empty()) continue;
      const double wanted =
          recall ? *recall : std::ranges::min(at_rate, {}, &RivalPoint::margin).recall;
      if (const auto found = at_recall(at_rate, wanted))
        subjects[seed] = {rate_hz,
                          0.0,
                          0.0,
                          wanted,
                          std::exp(found->error),
                          std::exp(found->payload),
                          std::exp(found->wire)};
    }
    if (subjects.empty()) return std::nullopt;
    for (const auto& [seed, point] : subjects) {
      const auto n = static_cast<double>(subjects.size());
      result.recall += point.recall / n, result.error_mm += point.error_mm / n,
          result.payload += point.payload / n, result.wire += point.wire / n;
    }
    for (const auto& [policy, seeds] : points_)
      if (policy != subject) result.rivals.push_back(rival(policy, seeds, subjects));
    std::ranges::stable_sort(result.rivals, [](const RivalRatio& a, const RivalRatio& b) {
      if (a.payload.has_value() != b.payload.has_value()) return a.payload.has_value();
      return a.payload && a.payload->value < b.payload->value;
    });
    return result;
  }

 private:
  static RivalRatio rival(const std::string& policy, const PointsOfSeed& seeds,
                          const std::map<std::uint64_t, RivalPoint>& subjects) {
    RivalRatio result{.policy = policy,
                      .payload = {},
                      .wire = {},
                      .payload_end = End::bracketed,
                      .wire_end = End::bracketed};
    std::vector<std::pair<double, double>> payloads, wires;
    std::set<std::pair<double, double>> settings;
    std::vector<std::size_t> below, above;
    for (const auto& [seed, subject] : subjects) {
      const auto own = seeds.find(seed);
      if (own == seeds.end()) continue;
      for (const RivalPoint& point : own->second)
        settings.emplace(point.setting_rate_hz, point.setting_threshold);
      const AtEqualError there = at_equal_error(own->second, subject.recall, subject.error_mm);
      below.push_back(there.points_below);
      above.push_back(there.points_above);
      result.payload_end = worse(result.payload_end, there.payload_end);
      result.wire_end = worse(result.wire_end, there.wire_end);
      if (there.payload_end == End::not_reached) continue;
      payloads.emplace_back(there.payload, subject.payload);
      wires.emplace_back(there.wire, subject.wire);
    }
    result.settings = settings.size();
    if (!below.empty()) {
      result.points_below = std::ranges::min(below);
      result.points_above = std::ranges::min(above);
    }
    assert(payloads.size() == wires.size() && payloads.size() <= subjects.size());
    if (payloads.empty()) result.payload_end = result.wire_end = End::not_reached;
    if (result.payload_end != End::not_reached) {
      result.payload = ratio_of(payloads);
      result.wire = ratio_of(wires);
    }
    return result;
  }

  std::map<std::string, PointsOfSeed> points_;  ///< by policy
};

std::string ratio_text(const std::optional<Ratio>& ratio, End end) {
  if (!ratio) return "-";
  const std::string value = (end == End::not_left ? "<" : "") + table_number(ratio->value);
  if (!ratio->interval) return value + " (one run)";
  const bool is_significant = ratio->difference() != Difference::insignificant;
  return value + " [" + table_number(ratio->interval->low) + ", " +
         table_number(ratio->interval->high) + "]" + (is_significant ? "" : " ~");
}

std::string note(const RivalRatio& rival) {
  if (rival.payload_end == End::not_reached) return "  never so small an error with this recall";
  if (!rival.has_few_points()) return "";
  return "  " + std::to_string(rival.points_below) + " points below, " +
         std::to_string(rival.points_above) + " above";
}

std::string trimmed(std::string line) {
  line.erase(line.find_last_not_of(' ') + 1);
  return line;
}

/// Explains the marks that occur in the table.
std::string explanation(std::span<const EqualError> comparisons) {
  const auto any = [comparisons](const auto& holds) {
    return std::ranges::any_of(comparisons, [&holds](const EqualError& each) {
      return std::ranges::any_of(each.rivals, holds);
    });
  };
  const auto is_insignificant = [](const std::optional<Ratio>& ratio) {
    return ratio && ratio->difference() == Difference::insignificant;
  };
  std::string text;
  if (any([&](const RivalRatio& rival) {
        return is_insignificant(rival.payload) || is_insignificant(rival.wire);
      }))
    text += "~: no significant difference, the interval contains 1\n";
  if (any([](const RivalRatio& rival) {
        return rival.payload_end == End::not_left || rival.wire_end == End::not_left;
      }))
    text += "<: at most, for no setting that was run has a larger error and sends less\n";
  if (any([](const RivalRatio& rival) { return rival.has_few_points(); }))
    text +=
        "points below, above: settings with at most that error and with more, where either are "
        "fewer than " +
        std::to_string(points_wanted) + "\n";
  return text;
}

}  // namespace

AtEqualError at_equal_error(std::span<const RivalPoint> points, double recall, double error_mm) {
  assert(error_mm > 0.0);
  const std::vector<LogPoint> settings = settings_at_recall(points, recall);
  const auto [payload, payload_end] = bytes_at(settings, error_mm, &LogPoint::payload);
  const auto [wire, wire_end] = bytes_at(settings, error_mm, &LogPoint::wire);
  const auto points_below = static_cast<std::size_t>(std::ranges::count_if(
      settings, [error_mm](const LogPoint& point) { return point.error <= std::log(error_mm); }));
  return {payload, wire, payload_end, wire_end, points_below, settings.size() - points_below};
}

std::vector<EqualError> equal_errors_of(const Experiment& experiment,
                                        std::span<const RunRecord> runs,
                                        const std::string& subject) {
  std::map<Conditions, Comparison> comparisons;
  std::map<Conditions, double> rates;
  for (const RunRecord& run : runs) {
    const Experiment& part = part_of(experiment, run.cell.part);
    const auto point = part.is_of_curves ? point_of(run) : std::nullopt;
    if (!point) continue;
    comparisons[conditions_of(run)].add(run, *point);
    if (run.cell.policy == subject)
      rates.try_emplace(conditions_of(run), part.tick_rates_hz.front());
  }
  std::vector<EqualError> found;
  for (const auto& [conditions, comparison] : comparisons) {
    const auto rate = rates.find(conditions);
    for (const std::optional<double> recall :
         {std::optional<double>(), std::optional(equal_recall)}) {
      auto result =
          rate == rates.end() ? std::nullopt : comparison.at(subject, rate->second, recall);
      if (!result) continue;
      result->mode = std::get<0>(conditions), result->delay_ms = std::get<1>(conditions),
      result->scheme = std::get<2>(conditions), result->clients = std::get<3>(conditions);
      found.push_back(std::move(*result));
    }
  }
  return found;
}

std::vector<RunRecord> without_curves(const Experiment& experiment,
                                      std::span<const RunRecord> runs) {
  std::vector<RunRecord> rows;
  for (const RunRecord& run : runs)
    if (!part_of(experiment, run.cell.part).is_of_curves) rows.push_back(run);
  return rows;
}

std::string equal_error_table(std::span<const EqualError> comparisons) {
  if (comparisons.empty()) return {};
  std::string text =
      "\nhow much more rivals send at equal displayed error and equal recall, each along its own "
      "rates,\n"
      "thresholds and margins, in virtual time; 95 % intervals over seeds\n";
  for (const EqualError& each : comparisons) {
    text += formatted("%.40s, %u clients, %g ms of delay, recall %.4f (%s)\n", each.scheme.c_str(),
                      each.clients, each.delay_ms, each.recall,
                      each.is_own_recall ? "without a margin" : "by its margin");
    text += formatted("    %-20s payload %-20s wire %-20s displayed error %s mm, at %g Hz\n",
                      each.subject.c_str(), (table_number(1e-3 * each.payload) + " kB/s").c_str(),
                      (table_number(1e-3 * each.wire) + " kB/s").c_str(),
                      table_number(each.error_mm).c_str(), each.rate_hz);
    for (const RivalRatio& rival : each.rivals)
      text += trimmed(formatted("    %-20s payload %-20s wire %-20s", rival.policy.c_str(),
                                ratio_text(rival.payload, rival.payload_end).c_str(),
                                ratio_text(rival.wire, rival.wire_end).c_str()) +
                      note(rival)) +
              "\n";
  }
  return text + explanation(comparisons);
}

std::string to_csv(std::span<const EqualError> comparisons) {
  std::string csv =
      "mode,scheme,clients,delay_ms,policy,tick_rate_hz,recall_is,recall,displayed_error_mm_rms,"
      "down_bytes_per_client_per_s,wire_bytes_per_client_per_s,rival,settings,end,payload_ratio,"
      "payload_ratio_low,payload_ratio_high,wire_ratio,wire_ratio_low,wire_ratio_high,pairs,"
      "wire_end,points_below,points_above,payload_difference,wire_difference\n";
  const auto ratio_and_ends = [](const std::optional<Ratio>& ratio) {
    if (!ratio) return std::string(",,");
    if (!ratio->interval) return csv_number(ratio->value) + ",,";
    return csv_number(ratio->value) + "," + csv_number(ratio->interval->low) + "," +
           csv_number(ratio->interval->high);
  };
  const auto difference = [](const std::optional<Ratio>& ratio) {
    return std::string(ratio ? words_for(ratio->difference()) : "");
  };
  const auto name_of_end = [](End end) {
    constexpr const char* names[] = {"bracketed", "not_reached", "not_left"};
    return std::string(names[static_cast<std::size_t>(end)]);
  };
  for (const EqualError& each : comparisons)
    for (const RivalRatio& rival : each.rivals) {
      csv += each.mode + ",\"" + each.scheme + "\"," + std::to_string(each.clients) + "," +
             csv_number(each.delay_ms) + "," + each.subject + "," + csv_number(each.rate_hz) + "," +
             (each.is_own_recall ? "own" : "asked_for") + "," + csv_number(each.recall) + "," +
             csv_number(each.error_mm) + "," + csv_number(each.payload) + "," +
             csv_number(each.wire) + "," + rival.policy + "," + std::to_string(rival.settings) +
             "," + name_of_end(rival.payload_end) + "," + ratio_and_ends(rival.payload) + "," +
             ratio_and_ends(rival.wire) + "," +
             std::to_string(rival.payload ? rival.payload->pairs : 0) + "," +
             name_of_end(rival.wire_end) + "," + std::to_string(rival.points_below) + "," +
             std::to_string(rival.points_above) + "," + difference(rival.payload) + "," +
             difference(rival.wire) + "\n";
    }
  return csv;
}

}  // namespace rink::loadgen
