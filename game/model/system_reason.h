// Says why the system refused something, as files that cannot be written.
#pragma once

#include <string>
#include <system_error>

namespace rink::game {

/// `error` is errno, read right after a stream has failed, and set to 0 before: streams of files
/// leave it as the system's call did, though the language does not say so. 0 is an unknown reason.
inline std::string system_reason(int error) {
  return error != 0 ? std::generic_category().message(error) : "unknown reason";
}

}  // namespace rink::game
