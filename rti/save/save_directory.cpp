// Names, writes and reads files of saves.
#include "rti/save/save_directory.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <system_error>
#include <utility>

#include "im/basics/fnv_hash.h"
#include "im/basics/hexadecimal.h"
#include "rti/fom/fom_module.h"

namespace rink::rti {

namespace {

/// An open file, closed at the end.
class Descriptor {
 public:
  Descriptor(const std::filesystem::path& file, int flags)
      : number_(::open(file.c_str(), flags | O_CLOEXEC, 0600)) {}
  ~Descriptor() {
    if (number_ >= 0) ::close(number_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  int number() const { return number_; }
  explicit operator bool() const { return number_ >= 0; }

 private:
  int number_;
};

std::string fault(const std::filesystem::path& file) {
  return file.string() + ": " + std::strerror(errno);
}

bool write_all(int descriptor, Bytes bytes) {
  while (!bytes.empty()) {
    const ssize_t taken = ::write(descriptor, bytes.data(), bytes.size());
    if (taken < 0 && errno == EINTR) continue;
    if (taken <= 0) return false;
    bytes = bytes.subspan(static_cast<std::size_t>(taken));
  }
  return true;
}

/// A file name of any text: its first letters for the reader, and the hash of the whole.
std::string named(std::string_view text) {
  std::string name;
  for (const char each : text.substr(0, 60)) {
    const bool is_plain = (each >= 'a' && each <= 'z') || (each >= 'A' && each <= 'Z') ||
                          (each >= '0' && each <= '9') || each == '-';
    name += is_plain ? each : '_';
  }
  return name + "-" + hexadecimal(hash_of(text));
}

}  // namespace

SaveDirectory::SaveDirectory(std::filesystem::path directory) : directory_(std::move(directory)) {
  std::error_code fault;
  std::filesystem::create_directories(directory_, fault);
  if (!std::filesystem::is_directory(directory_) || ::access(directory_.c_str(), W_OK | X_OK) != 0)
    throw FileError("'" + directory_.string() + "' is no directory in which saves can be written");
}

std::filesystem::path SaveDirectory::file_of(std::string_view federation,
                                             std::string_view label) const {
  return directory_ / (named(federation) + "." + named(label) + ".save");
}

std::string SaveDirectory::write(std::string_view federation, std::string_view label, Bytes bytes) {
  const std::filesystem::path file = file_of(federation, label);
  std::filesystem::path fresh = file;
  fresh += ".new";
  std::string why;
  {
    const Descriptor open(fresh, O_WRONLY | O_CREAT | O_TRUNC);
    if (!open || !write_all(open.number(), bytes) || ::fsync(open.number()) != 0)
      why = fault(fresh);
  }
  if (why.empty() && ::rename(fresh.c_str(), file.c_str()) != 0) why = fault(file);
  if (!why.empty()) {
    ::unlink(fresh.c_str());
    return why;
  }
  const Descriptor folder(directory_, O_RDONLY | O_DIRECTORY);
  return folder && ::fsync(folder.number()) == 0 ? std::string() : fault(directory_);
}

SaveStore::Found SaveDirectory::read(std::string_view federation, std::string_view label) {
  const std::filesystem::path file = file_of(federation, label);
  const Descriptor open(file, O_RDONLY);
  if (!open && errno == ENOENT) return {std::nullopt, "there is none"};
  struct stat state {};
  if (!open || ::fstat(open.number(), &state) != 0) return {std::nullopt, fault(file)};
  std::vector<std::byte> bytes(static_cast<std::size_t>(state.st_size));
  std::size_t size = 0;
  while (size < bytes.size()) {
    const ssize_t taken = ::read(open.number(), bytes.data() + size, bytes.size() - size);
    if (taken < 0 && errno == EINTR) continue;
    if (taken < 0) return {std::nullopt, fault(file)};
    if (taken == 0) break;
    size += static_cast<std::size_t>(taken);
  }
  bytes.resize(size);
  return {std::move(bytes), {}};
}

}  // namespace rink::rti
