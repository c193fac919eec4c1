// Definitions of the names in tables of results, for readers of the files without the program's
// documents.
#pragma once

#include <span>
#include <string>

#include "loadgen/report/definition.h"

namespace rink::loadgen {

/// Definitions of the keys that name a cell, every parameter among them.
std::span<const Definition> cell_definitions();
/// Definitions of the keys that `figures()` are read from.
std::span<const Definition> figure_definitions();

/// The definition whose member is the figure called `name`, e.g. update_age_ms of
/// update_age_ms_p99; null if there is none.
const Definition* definition_of(const std::string& name);

/// The unit of the figure called `name`, which must have a definition (asserted).
std::string unit_of(const std::string& name);

/// Every column of the cell, every figure, and every further column of the tables of results as
/// CSV, a line each: name, kind (cell, figure, or the table's name without its ending), unit,
/// alias, field, which is empty of the tables' own columns, and definition. No two lines share name
/// and kind.
std::string data_dictionary_csv();

}  // namespace rink::loadgen
