// What a condition or score is compiled to: steps over columns of numbers, each for many pairs at
// once, so that reading the program costs little per pair.
#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "im/pairs/pair_function.h"

namespace rink::im {

/// Truths are the numbers 1 and 0; a team, owner or kind is its number.
class Program final : public PairFunction {
 public:
  /// A column of one number for each of `pairs.count` pairs.
  using Attribute = void (*)(const rink_pairs& pairs, double* out);
  using Operation = void (*)(const double* a, const double* b, double* out, std::size_t count);
  using Column = std::uint16_t;
  static constexpr std::size_t columns_max = 256;

  // Each of these returns the column that it fills; the operation's operands are then gone, unless
  // they are attributes or constants, which stay.
  Column constant(double value);
  Column attribute(Attribute attribute, const PairUses& uses);
  Column operation(Operation operation, Column a, Column b);
  bool is_full() const { return kinds_.size() >= columns_max; }
  /// The column that is the answer; nothing may be added afterwards.
  void answer_with(Column column);

  PairUses uses() const override { return uses_; }
  void evaluate(const rink_pairs& pairs, double* results, double* slacks) override;

 private:
  /// So many pairs are worked on at once that the columns of a usual program stay in the cache.
  static constexpr std::size_t rows = 128;
  enum class ColumnKind : std::uint8_t { stays, is_used, is_free };
  struct Load {
    Attribute attribute;
    Column out;
  };
  struct Step {
    Operation operation;
    Column a, b, out;
  };
  Column add_column(ColumnKind kind);
  void release(Column column);
  double* at(Column column) { return columns_.data() + rows * column; }

  std::vector<Load> loads_;
  std::vector<Step> steps_;
  std::vector<ColumnKind> kinds_;
  std::vector<std::pair<Column, double>> constants_;
  std::vector<double> columns_;
  Column answer_ = 0;
  PairUses uses_;
};

}  // namespace rink::im
