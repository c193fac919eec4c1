// The numeric parameters of a cell, each described once for reading, sweeping, naming, writing and
// drawing.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "loadgen/experiment/experiment.h"

namespace rink::loadgen {

/// One of `Parameters`. A new one is a member there, a list in Experiment, and a line in
/// parameter.cpp; experiments, cell names, tables, CSV columns, assertions and plots follow.
struct ParameterKind {
  const char* key;      ///< in experiments, CSV columns and assertions
  const char* allowed;  ///< in words, for errors
  bool (*is_allowed)(double);
  bool is_whole;
  double (*of)(const Parameters&);
  void (*set)(Parameters&, double);
  std::vector<double> Experiment::*values;
  bool (*has)(const Cell& cell);            ///< whether a run of `cell` depends on it
  const char *short_name, *before, *after;  ///< in a cell's name, and in words around its value
  const char *axis,
      *column;   ///< its name in plots, with its unit, and in tables, in at most nine letters
  double scale;  ///< from its own unit to that of `axis` and `column`
  bool is_switch = false;  ///< 1 or 0, which experiments write true and false
};

/// False of the scheme that lets everything through: its clients declare no regions, so parameters
/// of regions have no effect.
bool has_regions(const Cell& cell);

/// All, in the order of their columns.
std::span<const ParameterKind> parameter_kinds();

/// `value` as names and tables show it: the fewest digits that identify it.
std::string shortest(double value);

/// The parameters of which `experiment` lists several values.
std::vector<const ParameterKind*> swept_parameters(const Experiment& experiment);

/// Every combination of the listed values, the last parameter's innermost.
std::vector<Parameters> parameters_of(const Experiment& experiment);

/// True if each parameter that the scheme of `cell` uses, but for `except`, is the first of its
/// list.
bool is_at_first_values(const Experiment& experiment, const Cell& cell,
                        const ParameterKind* except = nullptr);

/// The parameter's value in the unit of `axis`; a cell size of 0 reads "chosen".
std::string value_text(const ParameterKind& kind, const Cell& cell);

/// The number of parameters that differ from the first of their list.
int moved_parameters(const Experiment& experiment, const Parameters& own);

}  // namespace rink::loadgen
