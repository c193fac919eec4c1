// Writes and checks the manifest, reads an experiment back, compares runs.
#include "loadgen/report/artefact.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "game/model/report_schema.h"
#include "game/model/scene_file.h"
#include "game/version/version.h"
#include "im/basics/fnv_hash.h"
#include "im/basics/hexadecimal.h"
#include "loadgen/experiment/experiment_file.h"
#include "loadgen/measure/formatted.h"
#include "loadgen/measure/run_fields.h"
#include "loadgen/mobility/trace_scene.h"

namespace rink::loadgen {
namespace {

constexpr const char* manifest_name = "manifest.json";

struct Seal {
  std::uint64_t bytes = 0;
  std::string hash;
  friend bool operator==(const Seal&, const Seal&) = default;
};

Seal seal_of(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  Fnv64 hash;
  Seal seal;
  std::array<char, 1 << 16> block;
  while (stream.read(block.data(), block.size()) || stream.gcount() > 0) {
    const auto count = static_cast<std::size_t>(stream.gcount());
    hash.add(std::string_view(block.data(), count));
    seal.bytes += count;
  }
  seal.hash = hexadecimal(hash.value());
  return seal;
}

std::string text_in(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::ostringstream text;
  if (std::filesystem::is_directory(file) || !stream || !(text << stream.rdbuf()))
    throw ReportFolderError(file.string() + ": cannot be read: expected a file of a report folder");
  return text.str();
}

bool has_installed_scene(const std::string& name, const std::string& text) {
  try {
    return !name.ends_with(".toml") && game::scene_text(name) == text;
  } catch (const game::SceneError&) {
    return false;
  }
}

/// True if a name of a manifest lies below its folder.
bool is_inside(const std::string& file) {
  const std::filesystem::path path(file);
  return path.is_relative() && !file.empty() && file.find('\0') == std::string::npos &&
         std::ranges::none_of(path, [](const std::filesystem::path& step) { return step == ".."; });
}

/// Sets the seeds of the runs, which `--seeds` and `--until-width` may have chosen; the file's own
/// where no run is left.
void set_seeds(Experiment& experiment, std::span<const RunRecord> runs) {
  const auto those_of = [runs](const std::string& part, std::vector<std::uint64_t>& seeds) {
    std::vector<std::uint64_t> found;
    for (const RunRecord& run : runs)
      if (run.cell.part == part && !(std::ranges::find(found, run.cell.seed) != found.end()))
        found.push_back(run.cell.seed);
    if (!found.empty()) seeds = found;
  };
  those_of({}, experiment.seeds);
  for (Experiment& part : experiment.parts) those_of(part.part, part.seeds);
}

void set_scene(Experiment& experiment, const std::string& scene) {
  experiment.scene = scene;
  for (Experiment& part : experiment.parts) part.scene = scene;
}

}  // namespace

void keep_inputs(const ResultsDirectory& results, const Experiment& experiment) {
  results.write("experiment.toml", experiment.text);
  results.write("scene.toml", game::scene_text(experiment.scene));
  if (const auto trace = trace_file_of(experiment.scene))
    results.write(kept_trace_name(*trace), text_in(*trace));
  std::vector<const Experiment*> all{&experiment};
  for (const Experiment& part : experiment.parts) all.push_back(&part);
  for (const Experiment* each : all)
    if (!each->players_as_named.empty())
      results.write(kept_log_name(each->players_as_named), text_in(each->players));
}

void write_manifest(const ResultsDirectory& results) {
  nlohmann::ordered_json files = nlohmann::ordered_json::object();
  std::vector<std::filesystem::path> found;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(results.path()))
    if (entry.is_regular_file())
      found.push_back(std::filesystem::relative(entry.path(), results.path()));
  std::ranges::sort(found);
  for (const std::filesystem::path& name : found) {
    if (name == manifest_name) continue;
    const Seal seal = seal_of(results.path() / name);
    files[name.generic_string()] = {{"bytes", seal.bytes}, {"fnv1a", seal.hash}};
  }
  const nlohmann::ordered_json manifest{
      {"schema", game::report_schema}, {"version", game::built_version()}, {"files", files}};
  results.write(manifest_name,
                manifest.dump(1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n");
}

void check_manifest(const std::filesystem::path& folder) {
  const std::string name = (folder / manifest_name).string();
  const auto manifest = nlohmann::json::parse(text_in(folder / manifest_name), nullptr, false);
  if (!manifest.is_object() || !manifest.contains("schema") ||
      !manifest["schema"].is_number_integer() || !manifest.contains("files") ||
      !manifest["files"].is_object())
    throw ReportFolderError(name + ": not a manifest of a report folder");
  if (manifest["schema"] != game::report_schema)
    throw ReportFolderError(
        name + ": of schema " + manifest["schema"].dump() +
        (manifest.contains("version") ? ", written by version " + manifest["version"].dump() : "") +
        "; this program reads schema " + std::to_string(game::report_schema));
  if (manifest.value("version", nlohmann::json()) != game::built_version())
    throw ReportFolderError(
        name + ": written by " +
        (manifest.contains("version") ? "version " + manifest["version"].dump()
                                      : std::string("a program without a version")) +
        "; this is version " + game::built_version() + ", whose figures may mean something else");
  for (const auto& [file, sealed] : manifest["files"].items()) {
    if (!sealed.is_object() || !sealed.contains("bytes") || !sealed["bytes"].is_number_unsigned() ||
        !sealed.contains("fnv1a") || !sealed["fnv1a"].is_string())
      throw ReportFolderError(name + ": " + file + " has neither length nor hash");
    if (!is_inside(file))
      throw ReportFolderError(name + ": " + nlohmann::json(file).dump() +
                              " is no file below the folder");
    std::error_code failure;
    if (!std::filesystem::is_regular_file(folder / file, failure))
      throw ReportFolderError((folder / file).string() + ": missing, but named in the manifest");
    if (seal_of(folder / file) !=
        Seal{sealed["bytes"].get<std::uint64_t>(), sealed["fnv1a"].get<std::string>()})
      throw ReportFolderError((folder / file).string() + ": altered since the report was written");
  }
  for (const char* needed : {"experiment.toml", "scene.toml", "runs.jsonl"})
    if (!manifest["files"].contains(needed)) throw ReportFolderError(name + ": names no " + needed);
}

Experiment experiment_of_report(const std::filesystem::path& folder) {
  Experiment experiment =
      parse_experiment(text_in(folder / "experiment.toml"), folder / "experiment.toml", {});
  if (!has_installed_scene(experiment.scene, text_in(folder / "scene.toml")))
    set_scene(experiment, (folder / "scene.toml").string());
  set_seeds(experiment, journal_of_report(folder).runs);
  return experiment;
}

Journal journal_of_report(const std::filesystem::path& folder) {
  try {
    return read_journal(folder / "runs.jsonl");
  } catch (const OutputError& error) {
    throw ReportFolderError(error.what());
  }
}

Repetition repetition_of(std::span<const RunRecord> before, std::span<const RunRecord> again) {
  Repetition result;
  const auto is_repeated = [again](const RunRecord& run) {
    return std::ranges::any_of(again,
                               [&run](const RunRecord& other) { return other.cell == run.cell; });
  };
  result.left_out =
      before.size() - static_cast<std::size_t>(std::ranges::count_if(before, is_repeated));
  for (const RunRecord& run : again) {
    const auto twin = std::ranges::find_if(
        before, [&run](const RunRecord& other) { return other.cell == run.cell; });
    if (twin == before.end()) continue;
    if (run.transport == "virtual" && twin->valid != run.valid)
      result.differing.push_back(name_of(run.cell) + (run.valid
                                                          ? ": counts, and did not before"
                                                          : ": does not count, and did before"));
    if (!twin->valid || !run.valid) continue;
    ++result.compared;
    if (run.transport == "virtual") {
      RunRecord other = *twin;
      other.scene = run.scene, other.players = run.players;  // where they lie
      ++result.virtual_runs;
      if (to_json(other).dump() == to_json(run).dump()) ++result.virtual_same;
      else result.differing.push_back(name_of(run.cell) + ": other figures in virtual time");
      continue;
    }
    if (run.keys == "replay") {
      ++result.games;
      if (twin->state_hash == run.state_hash) ++result.games_same;
      else
        result.differing.push_back(name_of(run.cell) + ": ends in state " + run.state_hash +
                                   " instead of " + twin->state_hash);
    }
    if (run.down_bytes_per_client_per_s && twin->down_bytes_per_client_per_s &&
        *twin->down_bytes_per_client_per_s > 0.0)
      result.payload_apart = std::max(
          result.payload_apart,
          std::abs(*run.down_bytes_per_client_per_s / *twin->down_bytes_per_client_per_s - 1.0));
  }
  return result;
}

std::string words_for(const Repetition& repetition, const std::filesystem::path& folder) {
  std::string text = "repeats " + folder.string() + ":";
  const auto count = [](std::size_t same, std::size_t all) {
    return std::to_string(same) + " of " + std::to_string(all);
  };
  if (repetition.virtual_runs > 0)
    text += " " + count(repetition.virtual_same, repetition.virtual_runs) +
            " runs in virtual time agree in every figure;";
  if (repetition.games > 0)
    text += " " + count(repetition.games_same, repetition.games) +
            " runs by the clock end in the same state, their payloads at most " +
            formatted("%.2g %% apart;", 100.0 * repetition.payload_apart);
  if (repetition.virtual_runs + repetition.games == 0) text += " no run of both can be compared;";
  if (repetition.left_out > 0)
    text += " " + std::to_string(repetition.left_out) + " of its runs were not repeated;";
  text.back() = '\n';
  for (const std::string& difference : repetition.differing) text += "  " + difference + "\n";
  return text;
}

std::string commit_words(const Journal& journal, const std::filesystem::path& folder) {
  const std::string before = journal.head ? journal.head->commit : "unknown",
                    now = game::built_commit();
  return before == now ? ""
                       : folder.string() + ": made by commit " + before + ", repeated by commit " +
                             now + "\n";
}

}  // namespace rink::loadgen
