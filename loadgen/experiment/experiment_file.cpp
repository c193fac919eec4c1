// Reads experiments key by key, so that every error names its line.
#include "loadgen/experiment/experiment_file.h"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <sstream>

#include "game/model/listed.h"
#include "game/net/plugins.h"
#include "game/net/relevant_kinds.h"
#include "game/players/player_kinds.h"
#include "loadgen/experiment/cell_key.h"
#include "loadgen/experiment/experiment_limits.h"
#include "loadgen/experiment/experiment_network.h"
#include "loadgen/experiment/experiment_reader.h"
#include "loadgen/experiment/parameter.h"
#include "rti/federation_execution.h"

namespace rink::loadgen {
namespace {

toml::table parsed(std::string_view text, const std::string& file) {
  try {
    return toml::parse(text, file);
  } catch (const toml::parse_error& error) {
    throw ExperimentError(file + ":" + std::to_string(error.source().begin.line) +
                          ": not TOML: " + std::string(error.description()));
  }
}

std::string scene_beside(const std::string& scene, const std::filesystem::path& file) {
  if (!scene.ends_with(".toml") || std::filesystem::path(scene).is_absolute()) return scene;
  return (file.parent_path() / scene).lexically_normal().string();
}

std::filesystem::path recorded_log(const std::string& as_named,
                                   const std::filesystem::path& folder) {
  const std::filesystem::path kept = folder / kept_log_name(as_named);
  return std::filesystem::is_regular_file(kept) ? kept : folder / as_named;
}

void read_matrix(ExperimentReader& reader, Experiment& result, const Vocabulary& vocabulary) {
  reader.choose("modes", result.modes, vocabulary.modes);
  reader.judged(
      "schemes", result.schemes,
      [](const std::string& text) {
        return im::complaint_about(text, {.plugins = game::loaded_plugins()});
      },
      im::are_equivalent);
  reader.choose("policies", result.policies, vocabulary.policies);
  reader.whole_numbers("clients", result.clients, 1, 100'000);
  reader.whole_numbers("pucks", result.pucks, 0, 1'000'000);
  reader.whole_numbers("bats", result.bats, 0, 1'000'000);
  reader.whole_numbers("seeds", result.seeds, 0, 1'000'000'000);
  reader.whole_numbers("server_cores", result.server_cores, 1, 2);
  for (const ParameterKind& kind : parameter_kinds()) {
    if (kind.is_switch) reader.switches(kind.key, result.*kind.values);
    else
      reader.numbers(kind.key, result.*kind.values, kind.allowed, kind.is_allowed, kind.is_whole);
  }
}

void read_setting(ExperimentReader& reader, Experiment& result, const std::filesystem::path& file) {
  reader.number("start_s", result.start_s, "a number from 0 to 600",
                [](double v) { return v >= 0.0 && v <= 600.0; });
  reader.number("duration_s", result.duration_s, "a number from 0.1 to 3600",
                [](double v) { return v >= 0.1 && v <= 3600.0; });
  reader.number("warm_up_s", result.warm_up_s, "a number from 0 to 600",
                [](double v) { return v >= 0.0 && v <= 600.0; });
  reader.number("view_area", result.view_area,
                "a number from 0 (use view_fraction) to 1e12, and above 0 only beside a single "
                "view_fraction",
                [&result](double v) {
                  return v == 0.0 || (v > 0.0 && v <= 1e12 && result.view_fractions.size() == 1);
                });
  reader.number("delay_ms", result.delay_ms, "a number from 0 to 10000",
                [](double v) { return v >= 0.0 && v <= 10'000.0; });
  reader.choice<TransportKind>("transport", result.transport,
                               {{"tcp", TransportKind::tcp},
                                {"udp", TransportKind::udp},
                                {"shm", TransportKind::shared_memory},
                                {"bundle", TransportKind::bundle},
                                {"virtual", TransportKind::virtual_time}});
  std::vector<double> counts_fields{result.transport == TransportKind::virtual_time ? 1.0 : 0.0};
  reader.switches("bytes_by_field", counts_fields);
  result.counts_fields = counts_fields.front() != 0.0;
  if (result.transport != TransportKind::bundle)
    reader.refuse_idle("bundles", "clients share sockets under transport = \"bundle\" alone");
  if (const auto bundles = reader.whole_number("bundles", 1, 10'000))
    result.bundles = static_cast<std::uint32_t>(*bundles);
  reader.choice<Relevance>("relevance", result.relevance,
                           {{"rectangle", Relevance::rectangle},
                            {"disc", Relevance::disc},
                            {"contact", Relevance::contact},
                            {"filter", Relevance::filter}});
  reader.number("contact_s", result.contact_s, "a number above 0 and at most 10",
                [](double v) { return v > 0.0 && v <= 10.0; });
  reader.momentary("relevant", result.relevant);
  if (reader.has("also_relevant"))
    reader.choose("also_relevant", result.also_relevant, {"team", "always"});
  if (reader.has("always")) reader.choose("always", result.always, game::relevant_kind_names);
  reader.choice<Design>("design", result.design,
                        {{"matrix", Design::matrix}, {"one_at_a_time", Design::one_at_a_time}});
  reader.choice<Population>("population", result.population,
                            {{"fixed", Population::fixed}, {"per_client", Population::per_client}});
  reader.choice<KeySource>("keys", result.keys,
                           {{"replay", KeySource::replay}, {"live", KeySource::live}});
  reader.text("players", result.players,
              "random, " + game::listed(game::player_kinds()) +
                  ", or the path of a recorded key log, relative to the experiment's folder",
              [&file](const std::string& name) {
                return game::is_player_kind(name) ||
                       std::filesystem::is_regular_file(recorded_log(name, file.parent_path()));
              });
  if (game::is_player_kind(result.players)) return;
  result.players_as_named = result.players;
  result.players = recorded_log(result.players, file.parent_path()).lexically_normal().string();
}

/// With several parts the baseline may be of any of them.
void read_baseline(ExperimentReader& reader, Experiment& result) {
  const auto read = [&reader](const char* key, std::string& name,
                              const std::vector<std::string>& compared) {
    const auto is_compared = [&compared](const std::string& word) {
      return std::find(compared.begin(), compared.end(), word) != compared.end();
    };
    if (!is_compared(name)) name = compared.front();
    try {
      reader.text(key, name, "one that is compared: " + game::listed(compared), is_compared);
    } catch (const ExperimentError& error) {
      throw BaselineError(error.what());
    }
  };
  std::vector<std::string> schemes =
                               result.parts.empty() ? result.schemes : std::vector<std::string>(),
                           policies = result.parts.empty() ? result.policies : schemes;
  for (const Experiment& part : result.parts) {
    std::ranges::copy(part.schemes, std::back_inserter(schemes));
    std::ranges::copy(part.policies, std::back_inserter(policies));
  }
  read("baseline_scheme", result.baseline_scheme, schemes);
  read("baseline_policy", result.baseline_policy, policies);
  if (reader.has("baseline")) {  // cells differ from it in what it names alone
    if (!reader.has("baseline_scheme")) result.baseline_scheme.clear();
    if (!reader.has("baseline_policy")) result.baseline_policy.clear();
  }
  for (auto& [key, value] : reader.texts_of("baseline")) {
    if ((key == "scheme" || key == "policy") && reader.has(("baseline_" + key).c_str()))
      reader.refuse_all("baseline_" + key + " and baseline." + key + " name a baseline twice");
    if (key == "scheme") result.baseline_scheme = value;
    else if (key == "policy") result.baseline_policy = value;
    else result.baseline_others.emplace_back(key, value);
  }
}

/// Values of any axis, of which some cell has all.
void expect_baseline(const ExperimentReader& reader, const Experiment& experiment,
                     const std::string& file) {
  if (!reader.has("baseline")) return;
  Cell any;
  for (const auto& [name, value] : experiment.baseline_others) {
    std::vector<std::string> names;
    for (const CellKey& key : cell_keys()) names.push_back(key.name);
    const CellKey* key = key_called(name);
    if (!key || !key->set(any, value))
      throw BaselineError(file + ": baseline." + name + " = " + value + ": " +
                          (key ? "no value of that key" : "allowed are " + game::listed(names)));
  }
  const std::vector<Cell> cells = cells_of(experiment);
  // A cell that lacks a parameter is the baseline partner of all its values, and of a value that
  // does not occur.
  for (const auto& [name, value] : experiment.baseline_others) {
    const auto has_it = [&name = name, &value = value](const Cell& cell) {
      Cell with_it = cell;
      return key_called(name)->set(with_it, value) && with_it == cell;
    };
    if (std::ranges::none_of(cells, has_it))
      throw BaselineError(file + ": baseline: no cell of the experiment is " + name + " " + value);
  }
  const Baseline baseline = experiment.baseline();
  if (std::ranges::none_of(cells,
                           [&](const Cell& cell) { return baseline_of(cell, baseline) == cell; }))
    throw BaselineError(file + ": baseline: no cell of the experiment is " + baseline.words());
}

/// Refuses a key for a kind of relevance that no cell of `experiment` uses; a key for a part's kind
/// may stand in the whole.
void expect_use_of_relevance(const ExperimentReader& reader, const Experiment& experiment,
                             const std::string& file) {
  const auto is_used = [&experiment](Relevance relevance) {
    if (experiment.parts.empty()) return experiment.relevance == relevance;
    return std::ranges::any_of(experiment.parts, [relevance](const Experiment& part) {
      return part.relevance == relevance;
    });
  };
  if (!is_used(Relevance::contact)) reader.refuse_idle("contact_s", "relevance is not contact");
  if (!is_used(Relevance::filter)) reader.refuse_idle("relevant", "relevance is not filter");
  if (experiment.parts.empty() && experiment.relevance == Relevance::filter &&
      experiment.relevant.empty())
    throw RelevanceError(file +
                         ": relevance = filter: relevant is missing: expected an expression of "
                         "schemes, such as relevant = \"aura and not sight\" (docs/im.md)");
}

bool is_part_name(const std::string& name) {
  return !name.empty() && name.size() <= 40 && std::ranges::all_of(name, [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' ||
           c == '_';
  });
}

}  // namespace

Experiment load_experiment(const std::filesystem::path& file, const Vocabulary& vocabulary) {
  std::ifstream stream(file);
  std::ostringstream text;
  if (std::filesystem::is_directory(file) || !stream || !(text << stream.rdbuf())) {
    throw ExperimentError(file.string() + ": cannot be read: expected an experiment file (TOML)");
  }
  return parse_experiment(text.str(), file, vocabulary);
}

namespace {

/// A part with its own keys, and those of the whole experiment where it has none.
Experiment part_in(ExperimentReader& reader, const Experiment& whole,
                   const std::filesystem::path& file, const Vocabulary& vocabulary) {
  Experiment result;
  result.name = whole.name, result.scene = whole.scene;
  reader.text("name", result.part, "a name of at most 40 letters, digits, - and _", is_part_name);
  if (std::ranges::any_of(whole.parts,
                          [&result](const Experiment& other) { return other.part == result.part; }))
    reader.refuse_all("the name " + result.part + " is that of another part");
  std::vector<double> is_of_curves{0.0};
  reader.switches("curves", is_of_curves);
  result.is_of_curves = is_of_curves.front() != 0.0;
  read_matrix(reader, result, vocabulary);
  read_setting(reader, result, file);
  read_network(reader, result);
  reader.refuse_the_rest();
  expect_use_of_relevance(reader, result, file.string());
  expect_what_can_run(result, file.string());
  return result;
}

}  // namespace

Experiment parse_experiment(std::string_view text, const std::filesystem::path& file,
                            const Vocabulary& vocabulary) {
  const toml::table table = parsed(text, file.string());
  ExperimentReader reader(table, file.string());
  Experiment result;
  result.text = text;
  result.name = reader.required_text("name");
  result.scene = scene_beside(reader.required_text("scene"), file);
  read_matrix(reader, result, vocabulary);
  read_setting(reader, result, file);
  for (ExperimentReader& part : reader.tables("parts")) {
    if (!part.has("name"))
      part.refuse_all("name is missing: a name of at most 40 letters, digits, - and _ is required");
    part.fall_back_on(table);
    result.parts.push_back(part_in(part, result, file, vocabulary));
  }
  read_baseline(reader, result);
  for (Experiment& part : result.parts)
    part.baseline_scheme = result.baseline_scheme, part.baseline_policy = result.baseline_policy,
    part.baseline_others = result.baseline_others;
  if (result.parts.empty()) read_network(reader, result);
  else if (reader.table("network")) {
  }  // each part has read it
  reader.refuse_the_rest();
  expect_use_of_relevance(reader, result, file.string());
  expect_baseline(reader, result, file.string());
  if (!result.parts.empty()) return result;
  expect_what_can_run(result, file.string());
  return result;
}

}  // namespace rink::loadgen
