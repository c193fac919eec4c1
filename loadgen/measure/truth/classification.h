// Counts for precision and recall, pooled over samples, and other figures that are arithmetic on
// counts.
#pragma once

#include <cassert>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "loadgen/measure/truth/surroundings.h"
#include "loadgen/measure/truth/truth_figures.h"

namespace rink::loadgen {

/// Sizes of two sets and of their intersection, summed over samples (van Rijsbergen 1979, chapter
/// 7): each (player, entity) pair counts alike, so a sample in a dense place weighs more than one
/// in an empty one.
struct Classification {
  std::uint64_t chosen = 0, relevant = 0, both = 0;

  /// `chosen_entities` in ascending order, without the own bat.
  void add(std::span<const std::uint32_t> chosen_entities,
           std::span<const Relevant> relevant_entities);
  std::optional<double> precision() const;  ///< both / chosen; nothing if nothing was chosen
  std::optional<double> recall() const;     ///< both / relevant; nothing if nothing was relevant
};

/// Distances between believed and true positions of entities.
class PositionErrors {
 public:
  void add(double distance_m) {
    assert(!(distance_m < 0.0));
    squares_.push_back(distance_m * distance_m);
  }
  /// Adds an entity that was put back elsewhere without an update so far: a few such would outweigh
  /// all else in a root mean square.
  void add_replaced(double distance_m) {
    replaced_squares_ += distance_m * distance_m, ++replaced_;
  }
  /// Percentiles only if ten lie beyond them (see Histogram).
  ErrorFigures figures();
  std::size_t count() const { return squares_.size(); }
  /// The distances [m] without those put back, in no order.
  std::vector<double> distances() const;

 private:
  std::vector<double> squares_;
  double replaced_squares_ = 0.0;
  std::uint64_t replaced_ = 0;
};

/// Percentiles of durations [s], in milli- or microseconds: exact order statistics, as far as the
/// sample supports them.
Percentiles percentiles_ms(std::vector<double> durations_s);
Percentiles percentiles_us(std::vector<double> durations_s);

/// (sum x)^2 / (n sum x^2): 1 if all get the same, 1/n if one gets all (Jain, Chiu and Hawe 1984).
/// Nothing for no shares or if all are 0.
std::optional<double> jain_index(std::span<const double> shares);

}  // namespace rink::loadgen
