// The table [network] of an experiment: what the modelled network of virtual time is like.
#pragma once

#include "loadgen/experiment/experiment.h"
#include "loadgen/experiment/experiment_reader.h"

namespace rink::loadgen {

/// Fills the network of `result`, whose transport and delay have been read. Throws ExperimentError.
void read_network(ExperimentReader& reader, Experiment& result);

}  // namespace rink::loadgen
