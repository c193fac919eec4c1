// A run's figures key by key, the inverse of to_json(RunRecord); tests hold the two together.
#include "loadgen/run_journal.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <sstream>
#include <type_traits>

#include "loadgen/results.h"

namespace rink::loadgen {
namespace {

/// Takes values out of an object; the first that is missing or of another type is remembered.
class LineReader {
 public:
  explicit LineReader(const nlohmann::json& line) : line_(line) {}

  void read(const char* key, std::string& into) {
    const nlohmann::json* value = find(key);
    if (value && value->is_string()) into = value->get<std::string>();
    else if (value && value->is_null()) into.clear();
    else complain(key, "a text or null");
  }
  void read(const char* key, bool& into) {
    const nlohmann::json* value = find(key);
    if (value && value->is_boolean()) into = value->get<bool>();
    else complain(key, "true or false");
  }
  void read(const char* key, double& into) {
    const nlohmann::json* value = find(key);
    if (value && value->is_number()) into = value->get<double>();
    else complain(key, "a number");
  }
  template <class Count>
    requires std::is_unsigned_v<Count>
  void read(const char* key, Count& into) {
    const nlohmann::json* value = find(key);
    if (value && value->is_number_unsigned() && value->get<std::uint64_t>() <= std::numeric_limits<Count>::max()) into = value->get<Count>();
    else complain(key, "a count");
  }
  template <class Value>
  void read(const char* key, std::optional<Value>& into) {
    const nlohmann::json* value = find(key);
    if (value && value->is_null()) return into.reset();
    Value number{};
    read(key, number);
    into = number;
  }
  void read(const char* key, Percentiles& into) {
    if (LineReader part(object(key)); part.line_.is_object()) {
      part.read("p50", into.p50), part.read("p90", into.p90), part.read("p95", into.p95), part.read("p99", into.p99), part.read("p999", into.p999), part.read("max", into.max);
      adopt(key, part);
    }
  }
  void read(const char* key, ErrorFigures& into) {
    if (LineReader part(object(key)); part.line_.is_object()) {
      part.read("rms", into.rms), part.read("p99", into.p99), part.read("max", into.max);
      adopt(key, part);
    }
  }

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
    if (complaint_.empty() && !part.complaint_.empty()) complaint_ = std::string(key) + "." + part.complaint_;
  }
  void complain(const char* key, const char* expected) {
    if (complaint_.empty()) complaint_ = std::string(key) + " is missing or not " + expected;
  }

  const nlohmann::json& line_;
  std::string complaint_;
};

void read_cell(LineReader& line, Cell& cell) {
  line.read("mode", cell.mode);
  line.read("scheme", cell.scheme);
  line.read("policy", cell.policy);
  line.read("clients", cell.clients);
  line.read("seed", cell.seed);
  line.read("view_fraction", cell.parameters.view_fraction);
  line.read("view_margin", cell.parameters.view_margin);
  line.read("sweep_ticks", cell.parameters.sweep_ticks);
  line.read("cell_size", cell.parameters.cell_size);
  line.read("pucks", cell.pucks);
  line.read("bats", cell.bats);
  line.read("server_cores", cell.server_cores);
}

void read_setting(LineReader& line, RunRecord& run) {
  line.read("tick_rate_hz", run.tick_rate_hz);
  line.read("scene", run.scene);
  line.read("population", run.population);
  line.read("keys", run.keys);
  line.read("duration_s", run.duration_s);
  line.read("warm_up_s", run.warm_up_s);
  line.read("transport", run.transport);
  line.read("delay_ms", run.delay_ms);
  line.read("players", run.players);
  line.read("view_area", run.view_area);
}

void read_cost(LineReader& line, RunRecord& run) {
  line.read("entities", run.entities);
  line.read("ticks", run.ticks);
  line.read("ticks_on_time_fraction", run.ticks_on_time_fraction);
  line.read("down_bytes_per_client_per_s", run.down_bytes_per_client_per_s);
  line.read("up_bytes_per_client_per_s", run.up_bytes_per_client_per_s);
  line.read("wire_bytes_per_client_per_s", run.wire_bytes_per_client_per_s);
  line.read("messages_per_s", run.messages_per_s);
  line.read("update_age_ms", run.update_age_ms);
  line.read("key_to_effect_ms", run.key_to_effect_ms);
  line.read("physics_us_per_tick", run.physics_us_per_tick);
  line.read("filter_us_per_tick", run.filter_us_per_tick);
  line.read("send_us_per_tick", run.send_us_per_tick);
  line.read("server_rss_bytes", run.server_rss_bytes);
  line.read("state_hash", run.state_hash);
  line.read("valid", run.valid);
  line.read("why_invalid", run.why_invalid);
  line.read("measured_s", run.measured_s);
  line.read("segments_per_s", run.segments_per_s);
  line.read("writes_per_s", run.writes_per_s);
  line.read("keys_due", run.keys_due);
  line.read("keys_sent", run.keys_sent);
  line.read("late_sends_fraction", run.late_sends_fraction);
  line.read("server_cpu_s", run.server_cpu_s);
  line.read("bots_cpu_s", run.bots_cpu_s);
  line.read("bots_cpu_share", run.health.bots_cpu_share);
  line.read("histogram_ns_per_record", run.health.histogram_ns_per_record);
  line.read("tick_us", run.tick_us);
}

void read_truth(LineReader& line, TruthFigures& truth) {
  line.read("filter_precision", truth.filter_precision);
  line.read("filter_recall", truth.filter_recall);
  line.read("delivered_precision", truth.delivered_precision);
  line.read("delivered_recall", truth.delivered_recall);
  line.read("missed_interactions", truth.missed_interactions);
  line.read("late_entry_ms", truth.late_entry_ms);
  line.read("position_error_mm", truth.position_error_mm);
  line.read("displayed_error_mm", truth.displayed_error_mm);
  line.read("churn_per_client_per_s", truth.churn_per_client_per_s);
  line.read("flapping_fraction", truth.flapping_fraction);
  line.read("wasted_bytes_fraction", truth.wasted_bytes_fraction);
  line.read("control_bytes_fraction", truth.control_bytes_fraction);
  line.read("fairness_jain", truth.fairness_jain);
  line.read("interactions", truth.interactions);
  line.read("truth_trouble", truth.trouble);
  line.read("relevance", truth.relevance);
}

std::optional<JournalHead> head_of(const nlohmann::json& line) {
  if (!line.is_object() || !line.contains("provenance") || !line["provenance"].is_object()) return std::nullopt;
  for (const char* name : {"experiment", "commit"})
    if (!line.contains(name) || !line[name].is_string()) return std::nullopt;
  JournalHead head{line["experiment"].get<std::string>(), line["commit"].get<std::string>(), {}};
  for (const auto& [name, fact] : line["provenance"].items()) head.provenance.push_back({name, fact.is_string() ? fact.get<std::string>() : fact.dump()});
  return head;
}

}  // namespace

std::optional<RunRecord> run_record_from_json(const nlohmann::json& line, std::string& complaint) {
  RunRecord run;
  LineReader reader(line);
  read_cell(reader, run.cell);
  read_setting(reader, run);
  read_cost(reader, run);
  read_truth(reader, run.truth);
  complaint = reader.complaint();
  if (!complaint.empty()) return std::nullopt;
  return run;
}

std::string identity_of(const Experiment& experiment) {
  std::string all = experiment.text;
  for (const std::string& file : {experiment.scene, experiment.players}) {
    std::ostringstream content;
    if (std::filesystem::is_regular_file(file)) content << std::ifstream(file, std::ios::binary).rdbuf();
    all += '\0' + content.str();
  }
  std::uint64_t hash = 0xcbf29ce484222325u;
  for (const char letter : all) hash = (hash ^ static_cast<unsigned char>(letter)) * 0x100000001b3u;
  char digits[17];
  std::snprintf(digits, sizeof digits, "%016llx", static_cast<unsigned long long>(hash));
  return digits;
}

nlohmann::ordered_json to_json(const JournalHead& head) {
  nlohmann::ordered_json provenance = nlohmann::ordered_json::object();
  for (const auto& [name, fact] : head.provenance) provenance[name] = fact;
  return {{"provenance", provenance}, {"experiment", head.experiment}, {"commit", head.commit}};
}

Journal read_journal(const std::filesystem::path& file) {
  errno = 0;
  std::ifstream stream(file, std::ios::binary);
  std::ostringstream content;
  if (std::filesystem::is_directory(file) || !stream || (stream.peek() != std::ifstream::traits_type::eof() && !(content << stream.rdbuf())))
    throw OutputError(file.string() + ": cannot be read: " + (errno != 0 ? std::strerror(errno) : "not a journal of runs"));
  const std::string text = content.str();
  Journal journal;
  std::size_t number = 1;
  for (std::size_t end; (end = text.find('\n', journal.whole_bytes)) != std::string::npos; journal.whole_bytes = end + 1, ++number) {
    const auto line = nlohmann::json::parse(text.begin() + static_cast<std::ptrdiff_t>(journal.whole_bytes), text.begin() + static_cast<std::ptrdiff_t>(end), nullptr, false);
    if (number == 1 && (journal.head = head_of(line))) continue;
    std::string complaint = "not JSON";
    const auto run = line.is_discarded() ? std::nullopt : run_record_from_json(line, complaint);
    if (!run) throw OutputError(file.string() + ":" + std::to_string(number) + ": " + complaint + "; expected a run as rink compare writes it");
    journal.runs.push_back(*run);
  }
  journal.is_truncated = journal.whole_bytes < text.size();
  return journal;
}

}  // namespace rink::loadgen
