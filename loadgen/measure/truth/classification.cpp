// Merges ascending lists, sums squares.
#include "loadgen/measure/truth/classification.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "loadgen/measure/statistics/histogram.h"

namespace rink::loadgen {
namespace {

Percentiles percentiles_in(std::vector<double> durations_s, double units_per_s) {
  std::sort(durations_s.begin(), durations_s.end());
  const auto count = durations_s.size();
  const auto at = [&](double fraction) -> std::optional<double> {
    if (!Histogram::supports(count, fraction)) return std::nullopt;
    return units_per_s *
           durations_s[static_cast<std::size_t>(std::ceil(fraction * static_cast<double>(count))) -
                       1];
  };
  Percentiles result{.p50 = at(0.5),
                     .p90 = at(0.9),
                     .p95 = at(0.95),
                     .p99 = at(0.99),
                     .p999 = at(0.999),
                     .max = std::nullopt};
  if (count > 0) result.max = units_per_s * durations_s.back();
  return result;
}

std::optional<double> part(std::uint64_t some, std::uint64_t all) {
  if (all == 0) return std::nullopt;
  return static_cast<double>(some) / static_cast<double>(all);
}

}  // namespace

void Classification::add(std::span<const std::uint32_t> chosen_entities,
                         std::span<const Relevant> relevant_entities) {
  assert(std::ranges::is_sorted(chosen_entities));
  assert(std::ranges::is_sorted(relevant_entities, {}, &Relevant::entity));
  chosen += chosen_entities.size();
  relevant += relevant_entities.size();
  auto next = relevant_entities.begin();
  for (const std::uint32_t entity : chosen_entities) {
    while (next != relevant_entities.end() && next->entity < entity) ++next;
    if (next != relevant_entities.end() && next->entity == entity) ++both;
  }
}

std::optional<double> Classification::precision() const { return part(both, chosen); }
std::optional<double> Classification::recall() const { return part(both, relevant); }

ErrorFigures PositionErrors::figures() {
  constexpr double mm_per_m = 1e3;
  ErrorFigures figures;
  if (squares_.empty() && replaced_ == 0) return figures;
  figures.replaced_samples = replaced_;
  if (replaced_ > 0)
    figures.replaced_rms = mm_per_m * std::sqrt(replaced_squares_ / static_cast<double>(replaced_));
  if (squares_.empty()) return figures;
  std::sort(squares_.begin(), squares_.end());
  double sum = 0.0;
  for (const double square : squares_) sum += square;
  const auto count = squares_.size();
  const auto at = [&](double fraction) -> std::optional<double> {
    if (!Histogram::supports(count, fraction)) return std::nullopt;
    return mm_per_m *
           std::sqrt(
               squares_[static_cast<std::size_t>(std::ceil(fraction * static_cast<double>(count))) -
                        1]);
  };
  figures.rms = mm_per_m * std::sqrt(sum / static_cast<double>(count));
  figures.p50 = at(0.5), figures.p90 = at(0.9), figures.p99 = at(0.99);
  figures.max = mm_per_m * std::sqrt(squares_.back());
  return figures;
}

std::vector<double> PositionErrors::distances() const {
  std::vector<double> all;
  for (const double square : squares_) all.push_back(std::sqrt(square));
  return all;
}

Percentiles percentiles_ms(std::vector<double> durations_s) {
  return percentiles_in(std::move(durations_s), 1e3);
}
Percentiles percentiles_us(std::vector<double> durations_s) {
  return percentiles_in(std::move(durations_s), 1e6);
}

std::optional<double> jain_index(std::span<const double> shares) {
  double sum = 0.0, squares = 0.0;
  for (const double share : shares) sum += share, squares += share * share;
  if (squares == 0.0) return std::nullopt;
  return sum * sum / (static_cast<double>(shares.size()) * squares);
}

}  // namespace rink::loadgen
