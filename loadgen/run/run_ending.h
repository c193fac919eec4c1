// How a run ends that has no result.
#pragma once

#include <string>

namespace rink::loadgen {

/// The user wants an end.
struct Interrupted {};
/// A run that cannot go on; `why` becomes the record's reason.
struct Failure {
  std::string why;
};

}  // namespace rink::loadgen
