// The two folders, as the build defines them.
#include "tests/places.h"

namespace rink::test {

std::string source_folder() { return RINK_SOURCE_DIR; }

std::string binary_folder() { return RINK_BINARY_DIR; }

}  // namespace rink::test
