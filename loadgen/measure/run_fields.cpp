// A record as JSON, by its list of fields.
#include "loadgen/measure/run_fields.h"

#include <nlohmann/json.hpp>
#include <utility>

namespace rink::loadgen {
namespace {

/// Writes what visit_fields() names; absent figures become null.
class LineWriter {
 public:
  template <class Value>
  void field(const char* key, const Value& value) {
    line[key] = value;
  }
  template <class Value>
  void field(const char* key, const std::optional<Value>& value) {
    line[key] = or_null(value);
  }
  void field(const char* key, const Percentiles& percentiles) {
    line[key] = percentiles_json(percentiles);
  }
  void field(const char* key, const ErrorFigures& error) {
    line[key] = {{"rms", or_null(error.rms)},
                 {"p50", or_null(error.p50)},
                 {"p90", or_null(error.p90)},
                 {"p99", or_null(error.p99)},
                 {"max", or_null(error.max)},
                 {"replaced_samples", or_null(error.replaced_samples)},
                 {"replaced_rms", or_null(error.replaced_rms)}};
  }
  void text_or_null(const char* key, const std::string& text) {
    line[key] = text.empty() ? nlohmann::ordered_json(nullptr) : nlohmann::ordered_json(text);
  }

  nlohmann::ordered_json line;

 private:
  template <class Value>
  static nlohmann::ordered_json or_null(const std::optional<Value>& value) {
    return value ? nlohmann::ordered_json(*value) : nlohmann::ordered_json(nullptr);
  }
};

}  // namespace

nlohmann::ordered_json to_json(const RunRecord& record) {
  LineWriter writer;
  visit_fields(writer, record);
  return std::move(writer.line);
}

}  // namespace rink::loadgen
