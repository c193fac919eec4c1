// What searches for saturation found, as table, CSV and JSON.
#include <array>
#include <nlohmann/json.hpp>

#include "game/model/report_schema.h"
#include "loadgen/experiment/csv_number.h"
#include "loadgen/experiment/parameter.h"
#include "loadgen/measure/formatted.h"
#include "loadgen/measure/summary.h"
#include "loadgen/run/saturation/saturate_command.h"

namespace rink::loadgen {
namespace {

const char* name_of(SearchEnd end) {
  switch (end) {
    case SearchEnd::bracketed:
      return "bracketed";
    case SearchEnd::most_holds:
      return "most_holds";
    case SearchEnd::one_fails:
      return "one_fails";
    case SearchEnd::not_valid:
      return "not_valid";
    case SearchEnd::interrupted:
      return "interrupted";
  }
  return "";
}

const char* name_of(Verdict verdict) {
  return verdict == Verdict::holds ? "holds" : (verdict == Verdict::fails ? "fails" : "invalid");
}

std::optional<double> age_p99_of(const RunRecord& run) { return run.update_age_ms.p99; }

constexpr std::array edge_figures{
    Figure{"ticks_on_time_fraction",
           [](const RunRecord& run) { return run.ticks_on_time_fraction; }},
    Figure{"update_age_ms_p99", age_p99_of},
    Figure{"physics_us_per_tick", [](const RunRecord& run) { return run.physics_us_per_tick; }},
    Figure{"filter_us_per_tick", [](const RunRecord& run) { return run.filter_us_per_tick; }},
    Figure{"send_us_per_tick", [](const RunRecord& run) { return run.send_us_per_tick; }},
    Figure{"down_bytes_per_client_per_s",
           [](const RunRecord& run) { return run.down_bytes_per_client_per_s; }},
    Figure{"wire_bytes_per_client_per_s",
           [](const RunRecord& run) { return run.wire_bytes_per_client_per_s; }},
    Figure{"bots_cpu_share", [](const RunRecord& run) { return run.health.bots_cpu_share; }},
};

std::optional<double> at_edge(const Saturation& saturation, const Figure& figure) {
  return saturation.edge ? figure.of(*saturation.edge) : std::nullopt;
}

std::string whole(std::optional<std::uint32_t> value) {
  return value ? std::to_string(*value) : std::string();
}

std::string quoted(const std::string& text) {
  std::string result = "\"";
  for (const char letter : text)
    result += letter == '"' ? std::string("\"\"") : std::string(1, letter);
  return result + '"';
}

std::string shortened(const std::string& text) {
  constexpr std::size_t width = 120;
  return text.size() <= width ? text : text.substr(0, width - 3) + "...";
}

std::string thousand(std::optional<double> value) {
  return value ? formatted("%.3g", *value / 1'000.0) : "-";
}

}  // namespace

std::string held_text(const Search& search) {
  const std::string held = search.held ? std::to_string(*search.held) : "none";
  switch (search.end) {
    case SearchEnd::bracketed:
    case SearchEnd::one_fails:
      return held;
    case SearchEnd::most_holds:
      return "at least " + held;
    case SearchEnd::not_valid:
      return search.held ? "at least " + held : "unknown";
    case SearchEnd::interrupted:
      return search.held ? "interrupted, at least " + held : "interrupted";
  }
  return held;
}

std::string predicted_text(const Saturation& saturation) {
  return saturation.predicted
             ? formatted("%.0f (%u)", *saturation.predicted, saturation.predicted_from)
             : "-";
}

std::string to_csv(std::span<const Saturation> found) {
  std::string csv = "mode,scheme,policy,pucks,server_cores";
  for (const ParameterKind& kind : parameter_kinds()) csv += std::string(",") + kind.key;
  csv += ",end,held_clients,failed_clients,foretold_clients,foretold_from_clients,why,probes";
  for (const Figure& figure : edge_figures) csv += std::string(",") + figure.name;
  csv += "\n";
  for (const Saturation& saturation : found) {
    const Cell& cell = saturation.cell;
    csv += cell.mode + "," + cell.scheme + "," + cell.policy + "," + std::to_string(cell.pucks) +
           "," + std::to_string(cell.server_cores);
    for (const ParameterKind& kind : parameter_kinds())
      csv += "," + csv_number(kind.of(cell.parameters));
    csv += std::string(",") + name_of(saturation.search.end) + "," + whole(saturation.search.held) +
           "," + whole(saturation.search.failed) + "," + csv_number(saturation.predicted) + "," +
           (saturation.predicted ? std::to_string(saturation.predicted_from) : "") + "," +
           quoted(saturation.why) + "," + std::to_string(saturation.search.trials.size());
    for (const Figure& figure : edge_figures) csv += "," + csv_number(at_edge(saturation, figure));
    csv += "\n";
  }
  return csv;
}

std::string to_json_text(std::span<const Saturation> found, const ServiceLevel& level,
                         const SearchLimits& limits) {
  using Json = nlohmann::ordered_json;
  const auto or_null = [](const auto& value) { return value ? Json(*value) : Json(nullptr); };
  Json searches = Json::array();
  for (const Saturation& saturation : found) {
    Json probes = Json::array(), edge = nullptr;
    for (const Trial& trial : saturation.search.trials)
      probes.push_back({{"clients", trial.clients},
                        {"attempt", trial.attempt},
                        {"verdict", name_of(trial.verdict)}});
    if (saturation.edge) {
      edge = Json::object();
      for (const Figure& figure : edge_figures)
        edge[figure.name] = or_null(figure.of(*saturation.edge));
    }
    const Cell& cell = saturation.cell;
    Json search{{"mode", cell.mode},
                {"scheme", cell.scheme},
                {"policy", cell.policy},
                {"pucks", cell.pucks},
                {"server_cores", cell.server_cores}};
    for (const ParameterKind& kind : parameter_kinds()) search[kind.key] = kind.of(cell.parameters);
    search.update(Json{{"end", name_of(saturation.search.end)},
                       {"held_clients", or_null(saturation.search.held)},
                       {"failed_clients", or_null(saturation.search.failed)},
                       {"foretold_clients", or_null(saturation.predicted)},
                       {"why", saturation.why},
                       {"edge", edge},
                       {"probes", probes}});
    searches.push_back(std::move(search));
  }
  const Json whole_text = {
      {"schema", game::report_schema},
      {"service_level",
       {{"on_time_fraction_min", level.on_time_fraction_min},
        {"age_p99_ms_max", level.age_p99_ms_max}}},
      {"limits",
       {{"first", limits.first}, {"most", limits.most}, {"resolution", limits.resolution}}},
      {"searches", searches}};
  return whole_text.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string table_of(std::span<const Saturation> found, const ServiceLevel& level) {
  std::string text = formatted(
      "largest number of clients with %g %% of ticks on time and p99 update age below %g ms\n",
      100.0 * level.on_time_fraction_min, level.age_p99_ms_max);
  text += formatted("%-12s %-13s %5s %13s %6s %15s %7s %7s %7s %9s\n", "scheme", "policy", "cores",
                    "held", "failed", "foretold", "physics", "filter", "send", "down kB/s");
  for (const Saturation& saturation : found) {
    const auto part = [&saturation](std::size_t figure) {
      return thousand(at_edge(saturation, edge_figures[figure]));
    };
    text += formatted("%-12.12s %-13.13s %5u %13s %6s %15s %7s %7s %7s %9s\n",
                      saturation.cell.scheme.c_str(), saturation.cell.policy.c_str(),
                      saturation.cell.server_cores, held_text(saturation.search).c_str(),
                      whole(saturation.search.failed).c_str(), predicted_text(saturation).c_str(),
                      part(2).c_str(), part(3).c_str(), part(4).c_str(), part(5).c_str());
  }
  for (const Saturation& saturation : found)
    if (!saturation.why.empty())
      text += shortened(whole(saturation.search.failed) + " of " + saturation.cell.scheme + ", " +
                        saturation.cell.policy + " do not hold: " + saturation.why) +
              "\n";
  return text +
         "physics, filter, send: ms per tick at the edge; down: payload per client at the edge; "
         "foretold: by the cost of the\n"
         "probes of fewer clients (up to the number in brackets), as the better of a + b n and a "
         "n^b; docs/scaling.md\n";
}

}  // namespace rink::loadgen
