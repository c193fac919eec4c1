// How schemes and stages are written, for who lists them.
#pragma once

#include <string>

namespace rink::im {

/// `name`, a scheme's or a stage's, with the parameters it takes and what they may be:
/// "cone(half_angle=0..180)"; what need not be given stands in brackets, and what may be given
/// several times has dots behind it.
std::string usage_of(const std::string& name);

}  // namespace rink::im
