// Definitions of the columns that single tables of results have beside the cell's and figures.
#pragma once

#include <span>

#include "loadgen/report/definition.h"

namespace rink::loadgen {

/// Further columns of a table beside the cell's and figures; they are no fields of runs.jsonl.
struct TableColumns {
  const char* table;  ///< the file's name without its ending
  std::span<const Definition> columns;
};

/// All tables that have such columns, each once.
std::span<const TableColumns> table_columns();

}  // namespace rink::loadgen
