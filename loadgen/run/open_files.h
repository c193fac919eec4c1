// The limit on open files, which a server with many clients needs raised.
#pragma once

#include <cstddef>

namespace rink::loadgen {

/// Raises this process's limit on open files, which children inherit, to the most that is allowed.
/// Returns the limit then in force.
std::size_t raise_open_file_limit();

}  // namespace rink::loadgen
