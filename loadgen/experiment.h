// What an experiment file says, and the cells of the matrix it spans.
#pragma once

#include <cstdint>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace rink::loadgen {

/// An experiment that cannot be run; the message names file, line, key, what stands there and what is allowed.
class ExperimentError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// `fixed`: the scene as it is; clients play its first bats, and the plan moves all of its bats, so that every cell of one seed plays the very same game.
/// `per_client`: the scene scaled to one bat per client at constant density.
enum class Population { fixed, per_client };

/// `replay`: the server applies the planned keys at their exact times and the bots send them for the record. `live`: only what the bots send counts.
enum class KeySource { replay, live };

/// The names that an experiment may use.
struct Vocabulary {
  std::vector<std::string> modes{"client-server"};
  std::vector<std::string> schemes{"none", "grid", "region"};
  std::vector<std::string> policies{"periodic"};
};

/// An experiment file's content; every key but `name` and `scene` has the default given here.
struct Experiment {
  std::string name;
  std::string scene;  ///< a preset's name, or a path that is absolute or relative to the working directory
  std::vector<std::string> modes{"client-server"};
  std::vector<std::string> schemes{"none", "grid", "region"};
  std::vector<std::string> policies{"periodic"};
  std::vector<std::uint32_t> clients{10};
  std::vector<std::uint64_t> seeds{1};
  double tick_rate_hz = 30.0;    ///< 1 to 1000
  double duration_s = 3.0;       ///< [s] measured, after the warm-up; 0.1 to 3600
  double warm_up_s = 0.5;        ///< [s] played but not measured; 0 to 600
  double view_fraction = 0.05;   ///< area of a client's subscription region / area of the field, above 0 to 1
  double cell_size = 0.0;        ///< side of a grid cell [m]; 0 lets the scheme choose
  Population population = Population::fixed;
  KeySource keys = KeySource::replay;
  std::string text;  ///< the file as read
};

/// Reads `file`. Throws ExperimentError.
Experiment load_experiment(const std::filesystem::path& file, const Vocabulary& vocabulary);

/// The same from `text`; `file` is named in errors, and a scene given as a path is relative to its folder. Throws ExperimentError.
Experiment parse_experiment(std::string_view text, const std::filesystem::path& file, const Vocabulary& vocabulary);

/// One point of the matrix: one start of a server and its bots.
struct Cell {
  std::string mode, scheme, policy;
  std::uint32_t clients = 0;
  std::uint64_t seed = 0;
  friend bool operator==(const Cell&, const Cell&) = default;
};

/// All cells in the order in which they run: schemes innermost, so that what is compared runs side by side and a slow drift of the machine hits all
/// schemes alike; seeds outermost, so that an interrupted experiment has whole replications.
std::vector<Cell> cells_of(const Experiment& experiment);

/// A cell's name for files and progress, e.g. `client-server-grid-periodic-30-seed1`.
std::string name_of(const Cell& cell);

}  // namespace rink::loadgen
