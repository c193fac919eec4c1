// The only source that includes the header of the commit, so that a commit recompiles this alone.
#include "game/version/version.h"

#include <build_facts.h>

namespace rink::game {

const char* built_commit() { return RINK_COMMIT; }
const char* built_version() { return RINK_VERSION; }
const char* built_flags() { return RINK_FLAGS; }

std::string version_line(const std::string& command) {
  return command + " " + built_version() + " (commit " + built_commit() + ")";
}

}  // namespace rink::game
