// The port of a rank is that of the first one and its number; its number stands in the names of its
// files.
#include "game/apps/serve_rank.h"

#include <cstdint>
#include <filesystem>
#include <limits>
#include <stdexcept>
#include <string>
#include <system_error>

namespace rink::game {
namespace {

/// Rank 2's report.json is report.2.json. What is there and is no file, such as /dev/null, stays.
std::string file_of_rank(const std::string& name, std::uint32_t rank) {
  std::filesystem::path path(name);
  std::error_code error;
  if (name.empty() ||
      (std::filesystem::exists(path, error) && !std::filesystem::is_regular_file(path, error)))
    return name;
  const std::string extension = path.extension().string();
  return path.replace_extension(std::to_string(rank) + extension).string();
}

}  // namespace

void become_rank(ServeOptions& options, const rti::Ranks& ranks) {
  const std::uint32_t port = options.port + ranks.number();
  if (options.port > 0 && port > std::numeric_limits<std::uint16_t>::max())
    throw std::runtime_error("--port: rank " + std::to_string(ranks.number()) +
                             " would listen at " + std::to_string(port) +
                             ": expected a port after which there is one for each other rank");
  if (options.port > 0) options.port = static_cast<std::uint16_t>(port);
  options.report = file_of_rank(options.report, ranks.number());
  options.record = file_of_rank(options.record, ranks.number());
}

}  // namespace rink::game
