// Writes a record as JSON and reads it back, by its list of fields.
#include "loadgen/measure/run_fields.h"

#include <limits>
#include <nlohmann/json.hpp>
#include <utility>

namespace rink::loadgen {
namespace {

/// Writes the fields that visit_fields() visits; absent figures become null.
class LineWriter {
 public:
  template <class Value>
  void field(const char* key, const Value& value) {
    line[key] = value;
  }
  template <class Value>
  void field(const char* key, const std::optional<Value>& value) {
    if (value) line[key] = *value;
    else line[key] = nullptr;
  }
  template <class Figures>
  requires std::same_as<Figures, Percentiles> || std::same_as<Figures, ErrorFigures>
  void field(const char* key, const Figures& figures) {
    LineWriter part;
    visit_fields(part, figures);
    line[key] = std::move(part.line);
  }
  void field(const char* key, const std::vector<FieldFigures>& fields) {
    line[key] = nullptr;
    for (const FieldFigures& each : fields)
      line[key].push_back({each.direction, each.channel, each.form, each.field,
                           each.bytes_per_client_per_s, each.times_per_client_per_s});
  }
  void text_or_null(const char* key, const std::string& text) {
    line[key] = text.empty() ? nlohmann::ordered_json(nullptr) : nlohmann::ordered_json(text);
  }

  nlohmann::ordered_json line;
};

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
  template <class Figures>
  requires std::same_as<Figures, Percentiles> || std::same_as<Figures, ErrorFigures>
  void field(const char* key, Figures& into) {
    LineReader part(object(key));
    if (!part.line_.is_object()) return;
    visit_fields(part, into);
    if (complaint_.empty() && !part.complaint_.empty())
      complaint_ = std::string(key) + "." + part.complaint_;
  }

  /// Lines of before there were any have none.
  void field(const char* key, std::vector<FieldFigures>& into) {
    const nlohmann::json* value = find(key);
    if (value == nullptr || value->is_null()) return into.clear();
    if (!value->is_array()) return complain(key, "an array or null");
    into.reserve(value->size());
    for (const nlohmann::json& row : *value) {
      const auto is_text = [&row](std::size_t k) { return row[k].is_string(); };
      if (!row.is_array() || row.size() != 6 || !is_text(0) || !is_text(1) || !is_text(2) ||
          !is_text(3) || !row[4].is_number() || !row[5].is_number())
        return complain(key, "rows of four texts and two numbers");
      into.push_back({row[0], row[1], row[2], row[3], row[4], row[5]});
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
  void complain(const char* key, const char* expected) {
    if (complaint_.empty()) complaint_ = std::string(key) + " is missing or not " + expected;
  }

  const nlohmann::json& line_;
  std::string complaint_;
};

}  // namespace

nlohmann::ordered_json to_json(const RunRecord& record) {
  LineWriter writer;
  visit_fields(writer, record);
  return std::move(writer.line);
}

std::optional<RunRecord> run_record_from_json(const nlohmann::json& line, std::string& complaint) {
  RunRecord run;
  LineReader reader(line);
  visit_fields(reader, run);
  complaint = reader.complaint();
  if (!complaint.empty()) return std::nullopt;
  return run;
}

}  // namespace rink::loadgen
