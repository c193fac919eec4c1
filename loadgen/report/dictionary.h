// What the names in tables of results mean, once, for whoever reads the files without the program's
// documents.
#pragma once

#include <span>
#include <string>

namespace rink::loadgen {

/// What one key of a line of runs.jsonl holds. Figures of a sample, such as update_age_ms, have a
/// member each for its percentiles.
struct Definition {
  const char* field;    ///< the key
  const char* unit;     ///< empty: a name or a truth value; "1": a count or a fraction
  const char* alias;    ///< what the literature calls it where that differs; may be empty
  const char* meaning;  ///< a sentence without its stop
};

/// Of the keys that name a cell, every parameter among them.
std::span<const Definition> cell_definitions();
/// Of the keys that `figures()` are read from.
std::span<const Definition> figure_definitions();

/// The one that the figure called `name` is a member of, e.g. update_age_ms of update_age_ms_p99;
/// null if there is none.
const Definition* definition_of(const std::string& name);

/// That of the figure called `name`, of which there must be a definition (asserted).
std::string unit_of(const std::string& name);

/// Every column of the cell, every figure, and every further column of the tables of results as
/// CSV, a line each: name, kind (cell, figure, or the table's name without its ending), unit,
/// alias, field, which is empty of the tables' own columns, and definition. No two lines share name
/// and kind.
std::string data_dictionary_csv();

}  // namespace rink::loadgen
