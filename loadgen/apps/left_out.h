// Takes out of an experiment what this build has not got.
#pragma once

#include <string>

#include "loadgen/experiment/experiment.h"

namespace rink::loadgen {

/// Takes the mode dds out of an experiment if this build has not got it; returns what to say of
/// that. Throws ExperimentError if nothing else is left of the experiment or a part.
std::string left_out(Experiment& experiment);

}  // namespace rink::loadgen
