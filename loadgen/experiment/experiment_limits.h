// Refuses experiments of which cells could not run.
#pragma once

#include <string>

#include "loadgen/experiment/experiment.h"

namespace rink::loadgen {

/// What modes, nodes, rates and warm starts cannot do is found before cells run that would fail.
/// `experiment`, or the part of one, has no parts. Throws ExperimentError, naming `file`.
void expect_what_can_run(const Experiment& experiment, const std::string& file);

}  // namespace rink::loadgen
