// The syntax of schemes and stages, for listings.
#pragma once

#include <string>

namespace rink::im {

/// `name`, a scheme's or a stage's, with its parameters and their ranges:
/// "cone(half_angle=0..180)"; optional ones are in brackets, and dots follow one that may be
/// repeated.
std::string usage_of(const std::string& name);

}  // namespace rink::im
