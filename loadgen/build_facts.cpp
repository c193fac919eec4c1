// Alone with the header that changes at each commit, so that only this is compiled again.
#include "loadgen/build_facts.h"

#include <build_facts.h>

namespace rink::loadgen {

const char* built_commit() { return RINK_COMMIT; }
const char* built_version() { return RINK_VERSION; }
const char* built_flags() { return RINK_FLAGS; }

}  // namespace rink::loadgen
