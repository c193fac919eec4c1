// The keys by which experiments, demands and baselines pick cells.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "loadgen/experiment/experiment.h"

namespace rink::loadgen {

/// A key of a cell: sets it from a text, false if that is not of its kind.
struct CellKey {
  std::string name;
  std::function<bool(Cell&, const std::string&)> set;
};

const std::vector<CellKey>& cell_keys();

/// The one called `name`, or null.
const CellKey* key_called(const std::string& name);

}  // namespace rink::loadgen
