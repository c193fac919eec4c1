// The project's own files, read line by line, for the tests that judge them.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <regex>
#include <string>
#include <vector>

#include "tests/places.h"

namespace rink::house {

/// `path` is relative to the project's root, with forward slashes.
struct SourceFile {
  std::string path;
  std::vector<std::string> lines;

  bool is_in(const std::string& folder) const { return path.starts_with(folder + "/"); }
  bool is_header() const { return path.ends_with(".h"); }
  bool is_command() const { return path.ends_with("_main.cpp"); }
};

inline SourceFile read_source(const std::filesystem::path& root,
                              const std::filesystem::path& file) {
  SourceFile source{std::filesystem::relative(file, root).generic_string(), {}};
  std::ifstream stream(file);
  for (std::string line; std::getline(stream, line);) source.lines.push_back(line);
  return source;
}

/// All files below `folders` whose extension is one of `extensions`, in the order of their paths. A
/// folder that is missing fails the test: who moves it moves its rules too.
inline std::vector<SourceFile> read_sources(const std::vector<std::string>& folders,
                                            const std::vector<std::string>& extensions) {
  const std::filesystem::path root = test::source_folder();
  std::vector<SourceFile> sources;
  for (const std::string& folder : folders) {
    if (!std::filesystem::is_directory(root / folder)) {
      ADD_FAILURE() << "there is no folder " << folder << " to judge";
      continue;
    }
    for (const auto& entry : std::filesystem::recursive_directory_iterator(root / folder))
      if (entry.is_regular_file() &&
          std::ranges::find(extensions, entry.path().extension().string()) != extensions.end())
        sources.push_back(read_source(root, entry.path()));
  }
  std::ranges::sort(sources, {}, &SourceFile::path);
  return sources;
}

inline const std::vector<std::string> code_folders{"im",      "game",  "rti",
                                                   "loadgen", "bench", "tests"};
inline const std::vector<std::string> code_extensions{".h", ".cpp"};

/// Reports the file and line, in a form that editors can jump to.
inline void report(const SourceFile& source, std::size_t line_index, const std::string& what) {
  ADD_FAILURE() << source.path << ":" << line_index + 1 << ": " << what;
}

}  // namespace rink::house
