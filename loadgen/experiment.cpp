// Reads experiment files key by key, so that every complaint names its line.
#include "loadgen/experiment.h"

#include <toml++/toml.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <functional>
#include <optional>
#include <set>
#include <sstream>

#include "game/players/player.h"
#include "game/replication/update_policy.h"
#include "rti/federation_execution.h"

namespace rink::loadgen {
namespace {

std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : ", ") + word;
  return text;
}

/// A value as the user wrote it, for messages.
std::string written(const toml::node& node) {
  std::ostringstream text;
  node.visit([&text](const auto& value) { text << value; });
  return text.str();
}

/// Takes known keys out of a table one by one; what is left in the end is unknown.
class ExperimentReader {
 public:
  ExperimentReader(const toml::table& table, std::string file) : table_(table), file_(std::move(file)) {}

  std::string required_text(const char* key) {
    const toml::node* node = take(key);
    if (!node) throw ExperimentError(file_ + ": " + key + " is missing: a text is required");
    const auto text = node->value_exact<std::string>();
    if (!text || text->empty()) refuse(key, *node, "a text that is not empty");
    return *text;
  }

  void choose(const char* key, std::vector<std::string>& into, const std::vector<std::string>& allowed) {
    read_list(key, into, "one or more of " + joined(allowed), [&allowed](const toml::node& node) -> std::optional<std::string> {
      auto word = node.value_exact<std::string>();
      if (word && std::find(allowed.begin(), allowed.end(), *word) == allowed.end()) word.reset();
      return word;
    });
  }

  template <class Whole>
  void whole_numbers(const char* key, std::vector<Whole>& into, std::int64_t least, std::int64_t most) {
    const std::string allowed = "whole numbers from " + std::to_string(least) + " to " + std::to_string(most);
    read_list(key, into, allowed, [least, most](const toml::node& node) -> std::optional<Whole> {
      const auto number = node.value_exact<std::int64_t>();
      if (!number || *number < least || *number > most) return std::nullopt;
      return static_cast<Whole>(*number);
    });
  }

  void numbers(const char* key, std::vector<double>& into, const std::string& allowed, const std::function<bool(double)>& is_allowed) {
    read_list(key, into, allowed, [&is_allowed](const toml::node& node) -> std::optional<double> {
      const auto value = node.is_number() ? node.value<double>() : std::nullopt;
      if (!value || !std::isfinite(*value) || !is_allowed(*value)) return std::nullopt;
      return value;
    });
  }

  /// A text that may be missing; `is_allowed` judges it.
  void text(const char* key, std::string& into, const std::string& allowed, const std::function<bool(const std::string&)>& is_allowed) {
    const toml::node* node = take(key);
    if (!node) return;
    const auto value = node->value_exact<std::string>();
    if (!value || !is_allowed(*value)) refuse(key, *node, allowed);
    into = *value;
  }

  void number(const char* key, double& into, const std::string& allowed, const std::function<bool(double)>& is_allowed) {
    const toml::node* node = take(key);
    if (!node) return;
    const auto value = node->is_number() ? node->value<double>() : std::nullopt;
    if (!value || !std::isfinite(*value) || !is_allowed(*value)) refuse(key, *node, allowed);
    into = *value;
  }

  template <class Choice>
  void choice(const char* key, Choice& into, const std::vector<std::pair<std::string, Choice>>& allowed) {
    const toml::node* node = take(key);
    if (!node) return;
    const auto word = node->value_exact<std::string>();
    std::vector<std::string> words;
    for (const auto& [name, meaning] : allowed) {
      words.push_back(name);
      if (word && *word == name) return void(into = meaning);
    }
    refuse(key, *node, "one of " + joined(words));
  }

  void refuse_the_rest() const {
    for (const auto& [key, node] : table_) {
      if (taken_.contains(std::string(key.str()))) continue;
      const std::vector<std::string> known(taken_.begin(), taken_.end());
      throw ExperimentError(place(key.source().begin.line) + "unknown key " + std::string(key.str()) + ": allowed are " + joined(known));
    }
  }

 private:
  std::string place(std::uint32_t line) const { return file_ + ":" + std::to_string(line) + ": "; }

  [[noreturn]] void refuse(const char* key, const toml::node& node, const std::string& allowed) const {
    throw ExperimentError(place(node.source().begin.line) + key + " = " + written(node) + ": allowed is " + allowed);
  }

  const toml::node* take(const char* key) {
    taken_.insert(key);
    return table_.get(key);
  }

  /// A list or a single value; each value once.
  template <class Value, class Read>
  void read_list(const char* key, std::vector<Value>& into, const std::string& allowed, const Read& read) {
    const toml::node* node = take(key);
    if (!node) return;
    into.clear();
    const auto add = [&](const toml::node& entry) {
      const std::optional<Value> value = read(entry);
      if (!value) refuse(key, entry, allowed);
      if (std::find(into.begin(), into.end(), *value) != into.end()) refuse(key, entry, "each value once");
      into.push_back(*value);
    };
    if (const toml::array* list = node->as_array()) {
      for (const toml::node& entry : *list) add(entry);
      if (into.empty()) refuse(key, *node, allowed);
    } else {
      add(*node);
    }
  }

  const toml::table& table_;
  std::string file_;
  std::set<std::string> taken_;
};

toml::table parsed(std::string_view text, const std::string& file) {
  try {
    return toml::parse(text, file);
  } catch (const toml::parse_error& error) {
    throw ExperimentError(file + ":" + std::to_string(error.source().begin.line) + ": not TOML: " + std::string(error.description()));
  }
}

std::string scene_beside(const std::string& scene, const std::filesystem::path& file) {
  if (!scene.ends_with(".toml") || std::filesystem::path(scene).is_absolute()) return scene;
  return (file.parent_path() / scene).lexically_normal().string();
}

void read_matrix(ExperimentReader& reader, Experiment& result, const Vocabulary& vocabulary) {
  reader.choose("modes", result.modes, vocabulary.modes);
  reader.choose("schemes", result.schemes, vocabulary.schemes);
  reader.choose("policies", result.policies, vocabulary.policies);
  reader.whole_numbers("clients", result.clients, 1, 100'000);
  reader.whole_numbers("pucks", result.pucks, 0, 1'000'000);
  reader.whole_numbers("bats", result.bats, 0, 1'000'000);
  reader.whole_numbers("seeds", result.seeds, 0, 1'000'000'000);
  reader.whole_numbers("server_cores", result.server_cores, 1, 2);
  reader.whole_numbers("sweep_ticks", result.sweep_ticks, 0, 1000);
  reader.numbers("view_fraction", result.view_fractions, "numbers above 0 and at most 1", [](double v) { return v > 0.0 && v <= 1.0; });
  reader.numbers("view_margin", result.view_margins, "numbers from 0 to 1e6", [](double v) { return v >= 0.0 && v <= 1e6; });
  reader.numbers("cell_size", result.cell_sizes, "numbers from 0.001 to 1e6, or 0 (the scheme chooses)", [](double v) { return v == 0.0 || (v >= 1e-3 && v <= 1e6); });
}

void read_setting(ExperimentReader& reader, Experiment& result, const std::filesystem::path& file) {
  reader.number("tick_rate_hz", result.tick_rate_hz, "a number from 1 to 1000", [](double v) { return v >= 1.0 && v <= 1000.0; });
  reader.number("duration_s", result.duration_s, "a number from 0.1 to 3600", [](double v) { return v >= 0.1 && v <= 3600.0; });
  reader.number("warm_up_s", result.warm_up_s, "a number from 0 to 600", [](double v) { return v >= 0.0 && v <= 600.0; });
  reader.number("view_area", result.view_area, "a number from 0 (as view_fraction says) to 1e12, and above 0 only beside a single view_fraction",
                [&result](double v) { return v == 0.0 || (v > 0.0 && v <= 1e12 && result.view_fractions.size() == 1); });
  reader.number("delay_ms", result.delay_ms, "a number from 0 to 10000", [](double v) { return v >= 0.0 && v <= 10'000.0; });
  reader.choice<TransportKind>("transport", result.transport, {{"tcp", TransportKind::tcp}, {"virtual", TransportKind::virtual_time}});
  reader.choice<Relevance>("relevance", result.relevance, {{"rectangle", Relevance::rectangle}, {"disc", Relevance::disc}});
  reader.choice<Design>("design", result.design, {{"matrix", Design::matrix}, {"one_at_a_time", Design::one_at_a_time}});
  reader.choice<Population>("population", result.population, {{"fixed", Population::fixed}, {"per_client", Population::per_client}});
  reader.choice<KeySource>("keys", result.keys, {{"replay", KeySource::replay}, {"live", KeySource::live}});
  reader.text("players", result.players, "random, " + joined(game::player_kinds()) + ", or the path of a recorded key log, relative to the experiment's folder",
              [&file](const std::string& name) { return game::is_player_kind(name) || std::filesystem::is_regular_file(file.parent_path() / name); });
  if (!game::is_player_kind(result.players)) result.players = (file.parent_path() / result.players).lexically_normal().string();
}

void read_baseline(ExperimentReader& reader, Experiment& result) {
  const auto read = [&reader](const char* key, std::string& name, const std::vector<std::string>& compared) {
    const auto is_compared = [&compared](const std::string& word) { return std::find(compared.begin(), compared.end(), word) != compared.end(); };
    if (!is_compared(name)) name = compared.front();
    reader.text(key, name, "one that is compared: " + joined(compared), is_compared);
  };
  read("baseline_scheme", result.baseline_scheme, result.schemes);
  read("baseline_policy", result.baseline_policy, result.policies);
}

}  // namespace

std::vector<std::string> known_schemes() { return im::filter_names(); }

std::vector<std::string> known_policies() { return game::update_policy_names(); }

Experiment load_experiment(const std::filesystem::path& file, const Vocabulary& vocabulary) {
  std::ifstream stream(file);
  std::ostringstream text;
  if (std::filesystem::is_directory(file) || !stream || !(text << stream.rdbuf())) {
    throw ExperimentError(file.string() + ": cannot be read: expected an experiment file (TOML)");
  }
  return parse_experiment(text.str(), file, vocabulary);
}

Experiment parse_experiment(std::string_view text, const std::filesystem::path& file, const Vocabulary& vocabulary) {
  const toml::table table = parsed(text, file.string());
  ExperimentReader reader(table, file.string());
  Experiment result;
  result.text = text;
  result.name = reader.required_text("name");
  result.scene = scene_beside(reader.required_text("scene"), file);
  read_matrix(reader, result, vocabulary);
  read_setting(reader, result, file);
  read_baseline(reader, result);
  reader.refuse_the_rest();
  return result;
}

}  // namespace rink::loadgen
