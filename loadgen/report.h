// The comparison as one HTML page that needs neither network nor script.
#pragma once

#include <span>
#include <string>

#include "loadgen/experiment.h"
#include "loadgen/provenance.h"
#include "loadgen/run_record.h"

namespace rink::loadgen {

/// The page: plots, a table of all cells, the runs that did not count with their reasons, definitions, and provenance. Light and dark follow the reader's
/// setting; print is light. All text from outside is escaped.
std::string report_of(const Experiment& experiment, std::span<const RunRecord> runs, const Provenance& provenance);

}  // namespace rink::loadgen
