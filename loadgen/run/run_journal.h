// Reads runs.jsonl back: the runs that an interrupted campaign had finished.
#pragma once

#include <cstddef>
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "loadgen/measure/run_record.h"

namespace rink::loadgen {

/// Sixteen hexadecimal digits that change with the experiment's text, its scene's file and its
/// recorded keys (FNV-1a).
std::string identity_of(const Experiment& experiment);

/// The first line of a journal: the conditions of all its runs.
struct JournalHead {
  std::string experiment;  ///< see `identity_of`
  std::string commit;      ///< of the program, with a mark if it had been changed since
  std::vector<std::pair<std::string, std::string>> provenance;
};

nlohmann::ordered_json to_json(const JournalHead& head);

/// The content of a journal.
struct Journal {
  std::optional<JournalHead> head;  ///< absent in files that start with a run
  std::vector<RunRecord> runs;
  std::size_t whole_bytes = 0;  ///< length of the file up to the end of its last whole line
  bool is_truncated = false;    ///< something follows that: the line at which the writer was killed
};

/// Reads the journal at `file`. Throws OutputError, which names the line, if it cannot be read or a
/// whole line is malformed.
Journal read_journal(const std::filesystem::path& file);

}  // namespace rink::loadgen
