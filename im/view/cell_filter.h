// A predicate over cells as a filter.
#pragma once

#include "im/filter.h"
#include "im/schemes/predicate_filter.h"

namespace rink::im {

/// Of a predicate that is made from the settings and judges by the cells that they say.
template <typename CellPredicate>
class CellFilter final : public PredicateFilter<CellPredicate> {
 public:
  explicit CellFilter(const FilterSettings& settings)
      : PredicateFilter<CellPredicate>(settings.world, CellPredicate(settings)),
        cell_size_(cell_size_of(settings)) {}
  double cell_size() const override { return cell_size_; }

 private:
  double cell_size_;
};

}  // namespace rink::im
