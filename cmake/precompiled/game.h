// What the game, the load generator and the benchmarks include of others' headers, parsed once for
// all of them.
#pragma once

#include "cmake/precompiled/standard.h"

#include <Eigen/Core>
#include <nlohmann/json.hpp>
