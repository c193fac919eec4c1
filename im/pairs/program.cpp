// Runs the steps, rows by rows.
#include "im/pairs/program.h"

#include <algorithm>
#include <cassert>

namespace rink::im {

Program::Column Program::add_column(ColumnKind kind) {
  if (kind == ColumnKind::is_used) {
    const auto free = std::find(kinds_.begin(), kinds_.end(), ColumnKind::is_free);
    if (free != kinds_.end()) {
      *free = ColumnKind::is_used;
      return static_cast<Column>(free - kinds_.begin());
    }
  }
  assert(!is_full());
  kinds_.push_back(kind);
  return static_cast<Column>(kinds_.size() - 1);
}

void Program::release(Column column) {
  if (kinds_[column] == ColumnKind::is_used) kinds_[column] = ColumnKind::is_free;
}

Program::Column Program::constant(double value) {
  constants_.emplace_back(add_column(ColumnKind::stays), value);
  return constants_.back().first;
}

Program::Column Program::attribute(Attribute attribute, const PairUses& uses) {
  uses_.roles |= uses.roles, uses_.motion |= uses.motion, uses_.age |= uses.age;
  for (const Load& load : loads_)
    if (load.attribute == attribute) return load.out;
  loads_.push_back({attribute, add_column(ColumnKind::stays)});
  return loads_.back().out;
}

Program::Column Program::operation(Operation operation, Column a, Column b) {
  release(a), release(b);
  const Column out = add_column(ColumnKind::is_used);
  steps_.push_back({operation, a, b, out});
  return out;
}

void Program::answer_with(Column column) {
  answer_ = column;
  columns_.assign(rows * kinds_.size(), 0.0);
  for (const auto& [constant, value] : constants_) std::fill_n(at(constant), rows, value);
}

void Program::evaluate(const rink_pairs& pairs, double* results, double*) {
  assert(!columns_.empty());
  for (std::size_t begin = 0; begin < pairs.count; begin += rows) {
    const rink_pairs some{pairs.subscribers, pairs.entities, pairs.pairs + begin,
                          std::min(rows, pairs.count - begin)};
    for (const Load& load : loads_) load.attribute(some, at(load.out));
    for (const Step& step : steps_)
      step.operation(at(step.a), at(step.b), at(step.out), some.count);
    std::copy_n(at(answer_), some.count, results + begin);
  }
}

}  // namespace rink::im
