// The loop over cells.
#include "loadgen/run/campaign.h"

#include <algorithm>
#include <chrono>
#include <deque>
#include <future>
#include <map>
#include <optional>
#include <semaphore>
#include <thread>
#include <utility>
#include <vector>

#include "loadgen/experiment/parameter.h"
#include "loadgen/run/peers/peer_processes.h"
#include "loadgen/run/peers/peer_run.h"
#include "loadgen/run/virtual_run.h"

namespace rink::loadgen {
namespace {

/// A game of a part lasts as long as its cells do, and is saved where they begin.
std::string played_game(const Experiment& experiment, const Cell& cell) {
  const Experiment& part = part_of(experiment, cell.part);
  const Experiment& first = experiment.parts.empty() ? part : experiment.parts.front();
  std::string name = game_of(cell, part.population);
  if (part.start_s != first.start_s) name += "-from" + shortest(part.start_s) + "s";
  if (part.end_s() != first.end_s()) name += "-" + shortest(part.end_s()) + "s";
  return name;
}

/// Game name to key log, all written before the first cell starts, so that an impossible one is
/// found at once.
std::map<std::string, std::filesystem::path> write_key_logs(const Campaign& campaign) {
  std::map<std::string, std::filesystem::path> logs;
  const std::filesystem::path folder = campaign.results.subdirectory("keys");
  for (const Cell& cell : cells_of(campaign.experiment)) {
    const std::string game = played_game(campaign.experiment, cell);
    const auto [log, is_new] = logs.try_emplace(game, folder / (game + ".keys"));
    if (is_new) campaign.write_key_log(cell, log->second);
  }
  return logs;
}

bool has_run_of(const Cell& cell, const std::vector<RunRecord>& runs) {
  return std::any_of(runs.begin(), runs.end(),
                     [&cell](const RunRecord& run) { return run.cell == cell; });
}

}  // namespace

std::vector<RunRecord> runs_to_keep(const Experiment& experiment,
                                    const std::vector<RunRecord>& runs) {
  const std::vector<Cell> cells = cells_of(experiment);
  std::vector<RunRecord> kept;
  for (const RunRecord& run : runs) {
    if (std::find(cells.begin(), cells.end(), run.cell) != cells.end() &&
        !has_run_of(run.cell, kept))
      kept.push_back(run);
  }
  return kept;
}

namespace {

/// Larger crowds in virtual time run one after the other, for each takes much of the memory.
constexpr std::uint32_t clients_beside_others_max = 300;

using Clock = std::chrono::steady_clock;

/// Runs cells and takes their records in the order in which they were started: those in virtual
/// time beside each other on all processors, for nothing in them depends on how fast they run; all
/// others alone. Finished runs of processes are compared with truth once there are as many of them
/// as processors.
class CellQueue {
 public:
  CellQueue(const Campaign& campaign, Progress& progress, CampaignResult& outcome)
      : experiment_(campaign.experiment),
        settings_(campaign.settings),
        results_(campaign.results),
        progress_(progress),
        outcome_(outcome) {}

  /// False once it was interrupted.
  bool run(const Cell& cell, const std::filesystem::path& key_log) {
    const Experiment& part = part_of(experiment_, cell.part);
    const bool is_virtual = part.transport == TransportKind::virtual_time,
               has_peers = cell.mode == peer_mode;
    if (!is_virtual && !has_peers) return run_alone(part, cell, key_log);
    const auto run =
        has_peers ? (is_virtual ? run_virtual_peers : run_peer_processes) : run_virtual_cell;
    if (!is_virtual || cell.clients > clients_beside_others_max) {
      if (!finish()) return false;
      progress_.starts(cell);
      return take(run(settings_, part, cell, key_log));
    }
    if (!judge_what_ran()) return false;
    idle_workers_.acquire();  // for the first cell to end, in any order: cells take from 0.05 to 1
                              // s
    while (is_first_done())
      if (!take_first()) return false;
    progress_.starts(cell);
    under_way_.push_back(std::async(std::launch::async, [this, run, &part, cell, key_log] {
      const Worker worker{idle_workers_};
      RunnerSettings settings = settings_;
      settings.keeps_traces = !part.is_of_curves || settings.keeps_traces_of_curves;
      return run(settings, part, cell, key_log);
    }));
    return true;
  }

  /// Takes the records of all cells that still run.
  bool finish() { return judge_what_ran() && take_all(); }

 private:
  using Record = std::optional<RunRecord>;
  using Workers = std::counting_semaphore<>;
  struct Worker {
    Workers& others;
    ~Worker() { others.release(); }
  };

  bool take_all() {
    while (!under_way_.empty())
      if (!take_first()) return false;
    return true;
  }

  bool run_alone(const Experiment& part, const Cell& cell, const std::filesystem::path& key_log) {
    if (!take_all()) return false;
    progress_.starts(cell);
    std::optional<ProcessRun> run = run_processes(settings_, part, cell, key_log);
    const bool was_interrupted = !run;
    if (run) ran_.push_back(std::move(*run));
    if ((was_interrupted || ran_.size() >= processors_) && !judge_what_ran()) return false;
    return !was_interrupted || take({});
  }

  /// Adds the figures of truth to finished runs of processes, several at once.
  bool judge_what_ran() {
    if (ran_.empty()) return true;
    for (ProcessRun& run : std::exchange(ran_, {}))
      under_way_.push_back(std::async(std::launch::async, [this, run = std::move(run)] {
        return Record(judged(settings_, part_of(experiment_, run.record.cell.part), run));
      }));
    return take_all();
  }

  bool is_first_done() const {
    return !under_way_.empty() &&
           under_way_.front().wait_for(std::chrono::seconds(0)) == std::future_status::ready;
  }

  bool take_first() {
    std::future<Record> first = std::move(under_way_.front());
    under_way_.pop_front();
    return take(first.get());
  }

  bool take(const Record& record) {
    if (!record || outcome_.was_interrupted) {
      outcome_.was_interrupted = true;
      return false;
    }
    outcome_.runs.push_back(*record);
    const Clock::time_point now = Clock::now();
    progress_.finished(*record, std::chrono::duration<double>(now - last_).count());
    last_ = now;
    results_.append(*record);
    return true;
  }

  const Experiment& experiment_;
  const RunnerSettings& settings_;
  ResultsDirectory& results_;
  Progress& progress_;
  CampaignResult& outcome_;
  const std::size_t processors_ = std::max(1u, std::thread::hardware_concurrency());
  Workers idle_workers_{static_cast<std::ptrdiff_t>(processors_)};
  Clock::time_point last_ = Clock::now();
  std::deque<std::future<Record>> under_way_;
  std::vector<ProcessRun> ran_;  ///< as processes, and not yet judged
};

}  // namespace

CampaignResult run_campaign(const Campaign& campaign, Progress& progress,
                            std::vector<RunRecord> kept) {
  const Experiment& experiment = campaign.experiment;
  CampaignResult outcome;
  const std::vector<RunRecord> before = std::move(kept);
  outcome.runs = before;
  try {
    const auto key_logs = write_key_logs(campaign);
    CellQueue queue(campaign, progress, outcome);
    for (const Cell& cell : running_order(experiment))
      if (!has_run_of(cell, before) && !queue.run(cell, key_logs.at(played_game(experiment, cell))))
        break;
    queue.finish();
  } catch (const OutputError& error) {
    outcome.output_failure = error.what();
  }
  progress.clear();
  const std::vector<Cell> cells = cells_of(experiment);
  std::ranges::stable_sort(outcome.runs, {}, [&cells](const RunRecord& run) {
    return std::ranges::find(cells, run.cell) - cells.begin();
  });
  return outcome;
}

}  // namespace rink::loadgen
