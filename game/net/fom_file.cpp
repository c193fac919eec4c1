// Finds the file beside the executable, so that neither build nor installation needs its path.
#include "game/net/fom_file.h"

#include <filesystem>

namespace rink::game {

std::string fom_file() {
  std::error_code error;
  const std::filesystem::path executable = std::filesystem::read_symlink("/proc/self/exe", error);
  return (executable.parent_path().parent_path() / "share/rink/rink.fom.xml").string();
}

}  // namespace rink::game
