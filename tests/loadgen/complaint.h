// What is wrong with an experiment or with a demand on one, in the words that its user reads.
#pragma once

#include <string>

#include "loadgen/experiment/experiment.h"

namespace rink::loadgen {

/// The words of the ExperimentError that `act` throws.
template <class Act>
std::string complaint_of(const Act& act) {
  try {
    act();
  } catch (const ExperimentError& error) {
    return error.what();
  }
  return "no complaint";
}

}  // namespace rink::loadgen
