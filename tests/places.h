// Where the tests' sources and the programs under test lie. They are told to one source file alone,
// so that the others' objects are the same in every folder.
#pragma once

#include <string>

namespace rink::test {

/// The folder that holds `rti`, `im`, `game` and the rest; no slash at its end.
std::string source_folder();

/// The folder that the build writes to; no slash at its end.
std::string binary_folder();

}  // namespace rink::test
