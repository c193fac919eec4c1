// What breaks engines.
#pragma once

#include <vector>

#include "bench/trials/trial.h"

namespace rink::accuracy {

/// All of them, in the order in which they are shown. The same bits each time.
std::vector<Trial> stability_trials();

}  // namespace rink::accuracy
