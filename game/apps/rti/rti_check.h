// rink rti --check: what the files of an object model mean to this RTI.
#pragma once

#include <string>
#include <vector>

namespace rink::game {

/// Prints a line for each file, then what all of them are as one model, and warns of what is
/// understood otherwise than it is meant. False if a file cannot be read or the model is refused,
/// which is printed as an error.
bool check_model(const std::vector<std::string>& files);

}  // namespace rink::game
