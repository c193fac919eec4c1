// Opens and writes files; errors name the flag, the file and the reason.
#include "game/net/record_file.h"

#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <system_error>

#include "game/model/system_reason.h"

namespace rink::game {

void require_writable(const std::string& flag, const std::string& path) {
  if (path.empty()) return;
  std::FILE* file = std::fopen(path.c_str(), "ab");
  if (file == nullptr)
    throw std::runtime_error(flag + ": cannot write '" + path + "': " + system_reason(errno));
  std::fclose(file);
}

void write_file(const std::string& path, const std::string& text) {
  errno = 0;
  std::ofstream file(path);
  file << text << '\n';
  if (!file.flush())
    throw std::runtime_error("cannot write '" + path + "': " + system_reason(errno));
}

RecordFile::RecordFile(const std::string& flag, const std::string& path)
    : path_(path), is_new_(!path.empty() && !std::filesystem::exists(path)) {
  require_writable(flag, path);
}

RecordFile::~RecordFile() {
  std::error_code error;
  if (is_new_ && std::filesystem::is_regular_file(path_, error) &&
      std::filesystem::file_size(path_, error) == 0)
    std::filesystem::remove(path_, error);
}

}  // namespace rink::game
