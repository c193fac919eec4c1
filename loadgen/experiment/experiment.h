// The content of an experiment file, and the cells of the matrix that it spans.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "rti/transport/modelled/network_conditions.h"

namespace rink::loadgen {

/// An experiment that cannot be run; the message names file, line, key, the value there and what is
/// allowed.
class ExperimentError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A baseline that no cell has.
class BaselineError : public ExperimentError {
 public:
  using ExperimentError::ExperimentError;
};

/// A relevance expression that is faulty, or that cannot decide relevance at an instant.
class RelevanceError : public ExperimentError {
 public:
  using ExperimentError::ExperimentError;
};

/// `fixed`: the scene as it is; clients play its first bats, and the plan moves all of its bats, so
/// that every cell of one seed plays the very same game. `per_client`: the scene scaled to one bat
/// per client at constant density.
enum class Population { fixed, per_client };

/// `replay`: the server applies the planned keys at their exact times and the bots send them for
/// the record. `live`: only what the bots send counts.
enum class KeySource { replay, live };

/// `matrix`: every combination. `one_at_a_time`: of clients, pucks, bats and the parameters at most
/// one differs from the first of its list, so that growth with each, or what each does, can be read
/// from few runs.
enum class Design { matrix, one_at_a_time };

/// `tcp`, `udp` beside it, `shared_memory`: a server process and a bots process of this machine.
/// `virtual_time`: both in this process, over a modelled network and under a virtual clock.
enum class TransportKind { tcp, udp, shared_memory, bundle, virtual_time };
const char* to_string(TransportKind kind);  ///< as experiments name it

/// The definition of true relevance to a player; h is half the view's side. `rectangle`: an entity
/// whose box touches the square of half side h around the bat's true centre. `disc`: one whose
/// centre is within h of it. `contact`: every entity that can touch the bat, or a puck that can
/// touch it, within `contact_s` (loadgen/measure/truth/encounters.h). `filter`: every entity that
/// an expression of the filters lets through (loadgen/measure/truth/filter_relevance.h).
enum class Relevance { rectangle, disc, contact, filter };

/// Parameters of a scheme or a client: one value each in a cell, a list each in an experiment.
struct Parameters {
  double view_fraction = 0.05;  ///< area of the view / area of the field, above 0 to 1
  double view_margin = 0.3;     ///< [m] by which the declared region exceeds the view on each side
                                ///< (game::ClientSettings)
  std::uint32_t sweep_ticks =
      0;                   ///< ticks ahead over which update regions are swept (game::RegionSweep)
  double cell_size = 0.0;  ///< side of a scheme's cells [m]; 0 lets the scheme choose
  double tick_rate_hz =
      30.0;  ///< ticks of the server per second, 1 to 1000: decisions are as old as their inverse
  double threshold = 0.005;     ///< [m] of the dead-reckoning policies (game::UpdatePolicySettings)
  bool extrapolates = true;     ///< whether clients extrapolate entities of which they receive
                                ///< positions; without it `periodic` is the paper's
  std::uint32_t nodes = 1;      ///< servers that share the simulation (game/node), 1 to 64
  double output_rate_hz = 0.0;  ///< times a second that a client is told, at most the ticks; 0: at
                                ///< each tick (rti/update_rate.h)
  friend bool operator==(const Parameters&, const Parameters&) = default;
};

/// The mode in which each client is a peer that simulates its part of the field.
inline constexpr const char* peer_mode = "peer-to-peer";
/// The mode in which a server publishes all bodies over DDS instead of Rink's RTI, a partition per
/// cell under `grid` and one for all under `none` (docs/experiments.md, "DDS").
inline constexpr const char* dds_mode = "dds";

/// The update policies that the server knows.
std::vector<std::string> known_policies();

/// The names that an experiment may use; schemes are expressions that the RTI's filters check
/// (docs/im.md).
struct Vocabulary {
  std::vector<std::string> modes{"client-server", peer_mode, dds_mode};
  std::vector<std::string> policies = known_policies();
};

/// The baseline of ratios: the cell that differs only in what is named here.
struct Baseline {
  std::string scheme = "none", policy = "periodic";  ///< empty: each cell's own
  std::vector<std::pair<std::string, std::string>>
      others{};  ///< keys of a cell (loadgen/experiment/cell_key.h) and their values, as written
  std::string words() const;  ///< for a reader, e.g. "none with periodic"
};

/// An experiment file's content; every key but `name` and `scene` has the default given here.
struct Experiment {
  std::string name;
  std::string
      scene;  ///< a preset's name, or a path that is absolute or relative to the working directory
  std::vector<std::string> modes{"client-server"};
  std::vector<std::string> schemes{"none", "grid", "region"};
  std::vector<std::string> policies{"periodic"};
  std::vector<std::uint32_t> clients{10};
  std::vector<std::uint64_t> seeds{1};
  double start_s = 0.0;     ///< [s] of the game played before a run begins, without network and
                            ///< measurement; 0 to 600
  double duration_s = 3.0;  ///< [s] measured, after the warm-up; 0.1 to 3600
  double warm_up_s = 0.5;   ///< [s] played but not measured; 0 to 600
  std::vector<double> view_fractions{0.05}, view_margins{0.3}, sweep_ticks{0.0}, cell_sizes{0.0},
      tick_rates_hz{30.0};  ///< see Parameters, and parameter.h
  std::vector<double> thresholds{0.005}, extrapolates{1.0}, nodes{1.0},
      output_rates_hz{0.0};  ///< see Parameters, and parameter.h
  std::vector<std::uint32_t> pucks{0},
      bats{0};             ///< number on the scene's own field; 0: the scene's number
  double view_area = 0.0;  ///< of a client's view [m^2], for any field; 0: view_fraction decides
  TransportKind transport = TransportKind::tcp;
  std::uint32_t bundles = 1;  ///< sockets that the clients share where `transport` is a bundle
  double delay_ms =
      10.0;  ///< one way, in virtual time; 0 to 10,000; with a network the greater of its latencies
  rti::NetworkConditions network;  ///< in virtual time; partitions count from the run's start.
                                   ///< Without [network] `delay_ms` and nothing else
  bool network_is_modelled = false, network_carries_datagrams = false;
  std::string players =
      "random";  ///< the source of keys: a kind of player, or the path of a recorded key log
  std::string
      players_as_named{};  ///< the path of the log as the file has it; empty for a kind of player
  Relevance relevance = Relevance::rectangle;
  double contact_s = 0.5;  ///< [s] of `contact`; above 0 to 10
  std::string
      relevant{};  ///< of `filter`: the expression, in which im::fault_in_momentary finds nothing
  std::vector<std::string> also_relevant;  ///< relevant besides: `team`, bats of the player's side;
                                           ///< `always`, kinds that are always relevant
  std::vector<std::string> always;  ///< kinds of bodies that are always relevant; none: as the
                                    ///< scene has it (game::relevant_kinds_of)
  /// The baseline of ratios; if the file compares neither, the first of its lists; empty beside a
  /// table of other baseline keys that does not name them.
  std::string baseline_scheme = "none", baseline_policy = "periodic";
  std::vector<std::pair<std::string, std::string>> baseline_others{};  ///< other keys of the
                                                                       ///< baseline
  Baseline baseline() const { return {baseline_scheme, baseline_policy, baseline_others}; }
  std::vector<std::uint32_t> server_cores{1};  ///< 1: the server on a processor of its own, the
                                               ///< bots on the others; 2: both wherever they like
  /// Whether runs say where their payload goes, by message and field. Unless the file says so, in
  /// virtual time, where it costs no run anything.
  bool counts_fields = false;
  Design design = Design::matrix;
  Population population = Population::fixed;
  KeySource keys = KeySource::replay;
  std::string text;                                                    ///< the file as read
  double measured_from_s() const { return start_s + warm_up_s; }       ///< of the game [s]
  double end_s() const { return start_s + (warm_up_s + duration_s); }  ///< of the game [s]
  /// The parts of an experiment of several: each is an experiment with the same name, scene and
  /// baseline, and every key that it does not set itself. The cells are those of the parts.
  std::vector<Experiment> parts{};
  std::string part{};         ///< of a part: its name
  bool is_of_curves = false;  ///< of a part: its cells are points of curves along which rivals are
                              ///< compared at equal error, and rows of no table
};

/// The part of the experiment that `cell` belongs to; the experiment itself if it has no parts.
const Experiment& part_of(const Experiment& experiment, const std::string& part);

/// Name of the file of a report folder that holds the recorded key log which its experiment calls
/// `as_named`. An experiment prefers such a file in its own folder to the one that it names, so
/// that a copied report is complete.
std::string kept_log_name(const std::string& as_named);

/// One point of the matrix: one start of a server and its bots.
struct Cell {
  std::string mode, scheme, policy;
  std::uint32_t clients = 0;
  std::uint64_t seed = 0;
  Parameters parameters{};
  std::uint32_t pucks = 0, bats = 0;  ///< 0: the scene's own
  std::uint32_t server_cores = 1;
  std::string part{};  ///< of the experiment; empty if it has none
  friend bool operator==(const Cell&, const Cell&) = default;
};

/// All cells in the order in which tables list them, seeds outermost. Cells that differ only in
/// what their scheme does not have run once; of the mode dds there are those that it has.
std::vector<Cell> cells_of(const Experiment& experiment);

/// `cell` without the parameters that its scheme ignores: a cell size is for schemes with cells,
/// and with `none` neither margin nor sweep changes anything.
Cell without_idle_parameters(Cell cell);

/// The cell common to all its replications.
inline Cell without_seed(Cell cell) {
  cell.seed = 0;
  return cell;
}

/// The name of the cell's policy: `periodic` without extrapolation is `periodic (paper)`.
std::string policy_name(const Cell& cell);

/// The cell that the ratios of `cell` refer to: it differs only in what `baseline` names.
Cell baseline_of(Cell cell, const Baseline& baseline);
/// `cell` with another scheme and policy; an empty text keeps its own.
Cell baseline_of(Cell cell, const std::string& scheme, const std::string& policy);

/// The one of `cells` that the ratios of `cell` refer to; of a parameter that `cell` lacks and the
/// baseline has, the first value among `cells` counts. Seeds must agree.
std::optional<Cell> baseline_among(std::span<const Cell> cells, const Cell& cell,
                                   const Baseline& baseline);

/// The order in which `cells_of(experiment)` run, shuffled by the seed of each replication so that
/// no cell always follows the same other; replications still follow one after the other, part by
/// part.
std::vector<Cell> running_order(const Experiment& experiment);

/// A cell's name for files and progress, e.g. `client-server-grid-periodic-30-seed1` or, with what
/// is not the default, `...-30-pucks500-margin0.5-seed1`. No two cells of an experiment share a
/// name.
std::string name_of(const Cell& cell);
/// The part of this name that is neither seed nor default, in words for a reader, e.g. "500 pucks,
/// margin 0.5 m"; empty if all is default.
std::string variant_of(const Cell& cell);

/// The name of the game that `cell` plays; cells with the same name play the very same one, as long
/// as keys are replayed.
std::string game_of(const Cell& cell, Population population);

}  // namespace rink::loadgen
