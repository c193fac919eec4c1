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

/// The key called `name`, or null.
const CellKey* key_called(const std::string& name);

/// The columns that name a cell in a line of a table (RFC 4180), without its seed, and their
/// heading; each ends without a comma.
std::string cell_csv(const Cell& cell);
std::string cell_csv_heading();

}  // namespace rink::loadgen
