// The endings of a run without a result.
#pragma once

#include <string>

namespace rink::loadgen {

/// The user interrupted the run.
struct Interrupted {};
/// A run that cannot go on; `why` becomes the record's reason.
struct Failure {
  std::string why;
};

}  // namespace rink::loadgen
