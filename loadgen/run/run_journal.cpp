// A run's figures key by key, the inverse of to_json(RunRecord): both follow
// loadgen/measure/run_fields.h.
#include "loadgen/run/run_journal.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <sstream>
#include <type_traits>

#include "game/model/byte_hash.h"
#include "game/model/report_schema.h"
#include "loadgen/measure/results.h"
#include "loadgen/measure/run_fields.h"

namespace rink::loadgen {
namespace {

/// Takes values out of an object; the first that is missing or of another type is remembered.
class LineReader {
 public:
  explicit LineReader(const nlohmann::json& line) : line_(line) {}

  void field(const char* key, std::string& into) {
    const nlohmann::json* value = find(key);
    if (value && value->is_string()) into = value->get<std::string>();
    else if (value && value->is_null()) into.clear();
    else complain(key, "a text or null");
  }
  void field(const char* key, bool& into) {
    const nlohmann::json* value = find(key);
    if (value && value->is_boolean()) into = value->get<bool>();
    else complain(key, "true or false");
  }
  void field(const char* key, double& into) {
    const nlohmann::json* value = find(key);
    if (value && value->is_number()) into = value->get<double>();
    else complain(key, "a number");
  }
  template <class Count>
  requires std::is_unsigned_v<Count>
  void field(const char* key, Count& into) {
    const nlohmann::json* value = find(key);
    if (value && value->is_number_unsigned() &&
        value->get<std::uint64_t>() <= std::numeric_limits<Count>::max())
      into = value->get<Count>();
    else complain(key, "a count");
  }
  template <class Value>
  void field(const char* key, std::optional<Value>& into) {
    const nlohmann::json* value = find(key);
    if (value && value->is_null()) return into.reset();
    Value number{};
    field(key, number);
    into = number;
  }
  void field(const char* key, Percentiles& into) {
    if (LineReader part(object(key)); part.line_.is_object()) {
      part.field("p50", into.p50), part.field("p90", into.p90), part.field("p95", into.p95),
          part.field("p99", into.p99), part.field("p999", into.p999), part.field("max", into.max);
      adopt(key, part);
    }
  }
  void field(const char* key, ErrorFigures& into) {
    if (LineReader part(object(key)); part.line_.is_object()) {
      part.field("rms", into.rms), part.field("p50", into.p50), part.field("p90", into.p90),
          part.field("p99", into.p99), part.field("max", into.max);
      part.field("replaced_samples", into.replaced_samples),
          part.field("replaced_rms", into.replaced_rms);
      adopt(key, part);
    }
  }

  void text_or_null(const char* key, std::string& into) { field(key, into); }

  const std::string& complaint() const { return complaint_; }

 private:
  const nlohmann::json* find(const char* key) const {
    if (!line_.is_object()) return nullptr;
    const auto found = line_.find(key);
    return found == line_.end() ? nullptr : &*found;
  }
  const nlohmann::json& object(const char* key) {
    static const nlohmann::json nothing;
    const nlohmann::json* value = find(key);
    if (value && value->is_object()) return *value;
    complain(key, "an object");
    return nothing;
  }
  void adopt(const char* key, const LineReader& part) {
    if (complaint_.empty() && !part.complaint_.empty())
      complaint_ = std::string(key) + "." + part.complaint_;
  }
  void complain(const char* key, const char* expected) {
    if (complaint_.empty()) complaint_ = std::string(key) + " is missing or not " + expected;
  }

  const nlohmann::json& line_;
  std::string complaint_;
};

std::optional<JournalHead> head_of(const nlohmann::json& line) {
  if (!line.is_object() || !line.contains("provenance") || !line["provenance"].is_object())
    return std::nullopt;
  for (const char* name : {"experiment", "commit"})
    if (!line.contains(name) || !line[name].is_string()) return std::nullopt;
  JournalHead head{line["experiment"].get<std::string>(), line["commit"].get<std::string>(), {}};
  for (const auto& [name, fact] : line["provenance"].items())
    head.provenance.push_back({name, fact.is_string() ? fact.get<std::string>() : fact.dump()});
  return head;
}

}  // namespace

std::optional<RunRecord> run_record_from_json(const nlohmann::json& line, std::string& complaint) {
  RunRecord run;
  LineReader reader(line);
  visit_fields(reader, run);
  complaint = reader.complaint();
  if (!complaint.empty()) return std::nullopt;
  return run;
}

std::string identity_of(const Experiment& experiment) {
  std::string all = experiment.text;
  for (const std::string& file : {experiment.scene, experiment.players}) {
    std::ostringstream content;
    if (std::filesystem::is_regular_file(file))
      content << std::ifstream(file, std::ios::binary).rdbuf();
    all += '\0' + content.str();
  }
  return game::hexadecimal(game::hash_of(all));
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
