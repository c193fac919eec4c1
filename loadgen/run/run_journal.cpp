// Reads the journal line by line; only the last one may be cut off.
#include "loadgen/run/run_journal.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>
#include <sstream>
#include <vector>

#include "game/model/report_schema.h"
#include "im/basics/fnv_hash.h"
#include "im/basics/hexadecimal.h"
#include "loadgen/measure/results.h"
#include "loadgen/measure/run_fields.h"
#include "loadgen/mobility/trace_scene.h"

namespace rink::loadgen {
namespace {

std::optional<JournalHead> head_of(const nlohmann::json& line) {
  if (!line.is_object() || !line.contains("provenance") || !line["provenance"].is_object())
    return std::nullopt;
  for (const char* name : {"experiment", "commit"})
    if (!line.contains(name) || !line[name].is_string()) return std::nullopt;
  JournalHead head{line["experiment"].get<std::string>(), line["commit"].get<std::string>(), {}};
  for (const auto& [name, fact] : line["provenance"].items())
    head.provenance.emplace_back(name, fact.is_string() ? fact.get<std::string>() : fact.dump());
  return head;
}

/// A scene that is missing or faulty is refused where it is played.
std::optional<std::filesystem::path> trace_of(const Experiment& experiment) {
  try {
    return trace_file_of(experiment.scene);
  } catch (const game::SceneError&) {
    return std::nullopt;
  }
}

}  // namespace

std::string identity_of(const Experiment& experiment) {
  std::string all = experiment.text;
  std::vector<std::string> files{experiment.scene, experiment.players};
  if (const auto trace = trace_of(experiment)) files.push_back(trace->string());
  for (const std::string& file : files) {
    std::ostringstream content;
    if (std::filesystem::is_regular_file(file))
      content << std::ifstream(file, std::ios::binary).rdbuf();
    all += '\0' + content.str();
  }
  return hexadecimal(hash_of(all));
}

nlohmann::ordered_json to_json(const JournalHead& head) {
  nlohmann::ordered_json provenance = nlohmann::ordered_json::object();
  for (const auto& [name, fact] : head.provenance) provenance[name] = fact;
  return {{"schema", game::report_schema},
          {"provenance", provenance},
          {"experiment", head.experiment},
          {"commit", head.commit}};
}

Journal read_journal(const std::filesystem::path& file) {
  errno = 0;
  std::ifstream stream(file, std::ios::binary);
  std::ostringstream content;
  if (std::filesystem::is_directory(file) || !stream ||
      (stream.peek() != std::ifstream::traits_type::eof() && !(content << stream.rdbuf())))
    throw OutputError(file.string() + ": cannot be read: " +
                      (errno != 0 ? std::strerror(errno) : "not a journal of runs"));
  const std::string text = content.str();
  Journal journal;
  std::size_t number = 1;
  for (std::size_t end; (end = text.find('\n', journal.whole_bytes)) != std::string::npos;
       journal.whole_bytes = end + 1, ++number) {
    const auto line =
        nlohmann::json::parse(text.begin() + static_cast<std::ptrdiff_t>(journal.whole_bytes),
                              text.begin() + static_cast<std::ptrdiff_t>(end), nullptr, false);
    if (number == 1 && (journal.head = head_of(line))) {
      if (const std::string schema = line.contains("schema") ? line["schema"].dump() : "none";
          schema != std::to_string(game::report_schema))
        throw OutputError(file.string() + ":1: schema " + schema + "; this version reads schema " +
                          std::to_string(game::report_schema));
      continue;
    }
    std::string complaint = "not JSON";
    const auto run = line.is_discarded() ? std::nullopt : run_record_from_json(line, complaint);
    if (!run)
      throw OutputError(file.string() + ":" + std::to_string(number) + ": " + complaint +
                        "; expected a run as rink compare writes it");
    journal.runs.push_back(*run);
  }
  journal.is_truncated = journal.whole_bytes < text.size();
  return journal;
}

}  // namespace rink::loadgen
