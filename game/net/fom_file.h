// The path of Rink's own object model.
#pragma once

#include <string>

namespace rink::game {

/// The path of rink.fom.xml as it was built or installed: ../share/rink/ seen from the running
/// executable.
std::string fom_file();

}  // namespace rink::game
