// The house style as far as a program can judge it.
#include <map>

#include "tests/house/source_tree.h"
#include "tests/places.h"

namespace rink::house {
namespace {

constexpr std::size_t line_length_max = 100, file_length_max = 400;
/// About 25 are as many as a reader takes in.
constexpr std::size_t folder_size_max = 30;

std::vector<SourceFile> all_code() { return read_sources(code_folders, code_extensions); }

/// Words that this very test must be able to name are put together from halves.
std::string joined(const std::string& first, const std::string& second) { return first + second; }

template <class Judge>
void for_each_line(const std::vector<SourceFile>& sources, const Judge& judge) {
  for (const SourceFile& source : sources)
    for (std::size_t i = 0; i < source.lines.size(); ++i) judge(source, i, source.lines[i]);
}

/// UTF-8 characters, since docs and strings hold more than ASCII.
std::size_t character_count(const std::string& line) {
  return static_cast<std::size_t>(
      std::ranges::count_if(line, [](char byte) { return (byte & 0xC0) != 0x80; }));
}

TEST(Style, EveryFileOpensWithACommentThatSaysWhatItIsFor) {
  for (const SourceFile& source : all_code())
    if (source.lines.empty() || !source.lines[0].starts_with("// ") ||
        character_count(source.lines[0]) < 10)
      report(source, 0, "must open with a // comment: one sentence that says what the file is for");
}

TEST(Style, EveryHeaderIsIncludedOnce) {
  for (const SourceFile& source : all_code())
    if (source.is_header() && std::ranges::find(source.lines, "#pragma once") == source.lines.end())
      report(source, 0, "has no #pragma once");
}

/// Which lines of `source` belong to a raw string: text in another language, with lines of its own
/// length.
std::vector<bool> raw_text(const SourceFile& source) {
  const std::regex opens("R\"(\\w*)\\("), closes("\\)\\w*\"");
  std::vector<bool> is_raw;
  bool inside = false;
  for (const std::string& line : source.lines) {
    const bool opened = std::regex_search(line, opens);
    is_raw.push_back(inside || opened);
    if ((inside || opened) && std::regex_search(line, closes)) inside = false;
    else inside = inside || opened;
  }
  return is_raw;
}

/// `line` with its string literals emptied: a text is as long as it must be.
std::string without_texts(const std::string& line) {
  static const std::regex text(R"_("([^"\\]|\\.)*")_");
  return std::regex_replace(line, text, "\"\"");
}

TEST(Style, FilesStayReadable) {
  const auto sources = all_code();
  for (const SourceFile& source : sources)
    if (source.lines.size() > file_length_max)
      report(source, source.lines.size() - 1,
             "more than " + std::to_string(file_length_max) +
                 " lines: it has two subjects, find them");
  for_each_line(sources, [](const SourceFile& source, std::size_t i, const std::string& line) {
    if (line.find('\t') != std::string::npos)
      report(source, i, "holds a tab; indentation is two spaces");
    if (line.ends_with(' ') || line.ends_with('\r')) report(source, i, "ends in white space");
  });
}

TEST(Style, FoldersHoldWhatAReaderTakesIn) {
  std::map<std::string, std::size_t> sizes;
  for (const SourceFile& source : all_code())
    ++sizes[source.path.substr(0, source.path.find_last_of('/'))];
  for (const auto& [folder, size] : sizes) EXPECT_LE(size, folder_size_max) << folder;
}

TEST(Style, LinesFitTheScreen) {
  for (const SourceFile& source : all_code()) {
    const std::vector<bool> is_raw = raw_text(source);
    for (std::size_t i = 0; i < source.lines.size(); ++i)
      if (!is_raw[i] && character_count(without_texts(source.lines[i])) > line_length_max)
        report(source, i, "longer than " + std::to_string(line_length_max) + " characters");
  }
}

TEST(Style, NamesComeFromTheDomain) {
  const std::regex bag("(^|[/_])(" + joined("ut", "il") + "s?|" + joined("com", "mon") + "|" +
                       joined("hel", "per") + "s?|misc)(\\.|/)");
  const std::regex type("\\b(class|struct|enum class)\\s+\\w*(" + joined("Man", "ager") + "|" +
                        joined("Hel", "per") + "|" + joined("Ut", "il") + ")\\b");
  const auto sources = all_code();
  for (const SourceFile& source : sources)
    if (std::regex_search(source.path, bag))
      report(source, 0, "a name that says nothing: call it after what it is about");
  for_each_line(sources, [&](const SourceFile& source, std::size_t i, const std::string& line) {
    if (std::regex_search(line, type))
      report(source, i,
             "a type name that says nothing: nouns come from the rink, from physics and from HLA");
  });
}

TEST(Style, NothingIsLeftForLater) {
  const std::regex later("\\b(" + joined("TO", "DO") + "|" + joined("FIX", "ME") + "|" +
                         joined("XX", "X") + ")\\b");
  auto sources = all_code();
  for (SourceFile& document : read_sources({"docs", "scenes", "cmake"}, {".md", ".toml", ".cmake"}))
    sources.push_back(std::move(document));
  for_each_line(sources, [&](const SourceFile& source, std::size_t i, const std::string& line) {
    if (std::regex_search(line, later))
      report(source, i, "finish it, or state the limit in the docs");
  });
}

TEST(Style, DocumentsNameNoMachine) {
  const std::regex machine_path(R"((^|[\s`"'(=:])/(tmp|root|work|home)(/|\b))");
  auto documents = read_sources({"docs", "scenes"}, {".md", ".toml"});
  const std::filesystem::path root = test::source_folder();
  documents.push_back(read_source(root, root / "README.md"));
  EXPECT_FALSE(documents.back().lines.empty());
  for_each_line(documents, [&](const SourceFile& source, std::size_t i, const std::string& line) {
    if (std::regex_search(line, machine_path))
      report(source, i, "names a path of one machine; readers have others");
  });
}

}  // namespace
}  // namespace rink::house
