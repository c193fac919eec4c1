// Saved federations as files of one directory.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "rti/save/save_store.h"

namespace rink::rti {

/// A save is written beside its file, forced to disk and renamed: whoever reads meanwhile, or after
/// a crash, finds the former save or the new one.
class SaveDirectory final : public SaveStore {
 public:
  /// Makes the directory if there is none. Throws FileError naming it if nothing can be
  /// written there.
  explicit SaveDirectory(std::filesystem::path directory);

  std::string write(std::string_view federation, std::string_view label, Bytes bytes) override;
  Found read(std::string_view federation, std::string_view label) override;
  std::filesystem::path file_of(std::string_view federation, std::string_view label) const;

 private:
  std::filesystem::path directory_;
};

}  // namespace rink::rti
