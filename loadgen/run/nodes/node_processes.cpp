// Starts the first node, all others, then bots at each; waits for all within limits.
#include "loadgen/run/nodes/node_processes.h"

#include <algorithm>
#include <cassert>
#include <charconv>
#include <chrono>
#include <cstdint>
#include <deque>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "game/control/key_log_file.h"
#include "game/control/replay.h"
#include "game/model/scene.h"
#include "game/process/process.h"
#include "im/basics/hexadecimal.h"
#include "loadgen/measure/judge_run.h"
#include "loadgen/run/game_plan.h"
#include "loadgen/run/nodes/node_reports.h"
#include "loadgen/run/process_run.h"
#include "loadgen/run/virtual_parts.h"

namespace rink::loadgen {
namespace {

using std::chrono::milliseconds;

constexpr int node_is_gone = 16;  // rink serve's exit status when it ends for another node's sake

/// Gives a flag that is there already another value.
void set_flag(std::vector<std::string>& arguments, const char* flag, const std::string& value) {
  const auto at = std::ranges::find(arguments, flag);
  assert(at != arguments.end() && at + 1 != arguments.end());
  *(at + 1) = value;
}

/// The number in front of `text`, which is cut off with what follows up to `until`.
std::uint32_t take_number(std::string_view& text, std::string_view until) {
  std::uint32_t number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  const std::size_t next = text.find(until);
  if (error != std::errc() || next == std::string_view::npos)
    throw Failure{"a node did not say which one it is"};
  text.remove_prefix(next + until.size());
  return number;
}

class NodeProcesses {
 public:
  NodeProcesses(const RunnerSettings& settings, const Experiment& experiment,
                const std::filesystem::path& key_log, const Cell& cell)
      : settings_(settings), experiment_(experiment), key_log_(key_log), cell_(cell) {}

  void run(RunRecord& record);

 private:
  /// A process, and what it is called in reasons.
  struct Named {
    Named(std::string name, const std::filesystem::path& program,
          const std::vector<std::string>& arguments)
        : who(std::move(name)), process(program, arguments) {}
    bool runs() const { return !process.ending(); }
    bool has_failed() const { return process.ending() && !process.ending()->is_success(); }

    std::string who;
    game::Process process;
    bool is_of_bots = false, is_noted = false;  ///< the latter: in `failed_`
  };

  std::uint32_t count() const { return cell_.parameters.nodes; }
  std::filesystem::path file_of(std::size_t node, const char* ending) const {
    return settings_.directory / (name_of(cell_) + ".node" + std::to_string(node) + ending);
  }
  void start_node(const std::string& first);
  void start_bots(std::size_t node);
  void await();
  void note_failures();
  [[noreturn]] void name_failure() const;
  void add_processor_times(RunRecord& record) const;
  std::vector<NodeResults> results() const;
  void expect_one_game(const std::vector<NodeResults>& results) const;

  const RunnerSettings& settings_;
  const Experiment& experiment_;
  const std::filesystem::path& key_log_;
  const Cell& cell_;
  std::deque<Named> processes_;         ///< the nodes', then in the same order those of their bots
  std::vector<const Named*> failed_;    ///< in the order in which that was seen
  std::vector<std::uint32_t> numbers_;  ///< of nodes, by process
};

/// The first one, or if `first` is not empty one that joins the node there (ADDRESS:PORT).
void NodeProcesses::start_node(const std::string& first) {
  const std::size_t node = processes_.size();
  std::error_code ignored;
  for (const char* ending : {".server.json", ".bots.json", ".keys"})
    std::filesystem::remove(file_of(node, ending), ignored);
  std::vector<std::string> arguments =
      serve_arguments(experiment_, cell_, key_log_, file_of(node, ".server.json"));
  set_flag(
      arguments, "--clients",
      std::to_string(clients_of_node(cell_.clients, count(), static_cast<std::uint32_t>(node))));
  arguments.insert(arguments.end(), {"--node-listen", "127.0.0.1:0"});
  if (first.empty())
    arguments.insert(arguments.end(), {"--nodes", std::to_string(count()), "--record",
                                       file_of(node, ".keys").string()});
  else arguments.insert(arguments.end(), {"--join", first});
  processes_.emplace_back("node process " + std::to_string(node), settings_.serve, arguments);
}

/// Nodes number themselves in the order in which they meet, and their players with them.
void NodeProcesses::start_bots(std::size_t node) {
  Named& server = processes_[node];
  const std::string said = awaited_line(settings_, server.process, "this is node ", server.who),
                    address = awaited_line(settings_, server.process, "listening on ", server.who);
  std::string_view words = said;
  numbers_.push_back(take_number(words, " of "));
  take_number(words, ", with ");
  const std::uint32_t clients = take_number(words, " players from bat "),
                      first = take_number(words, " on");
  std::vector<std::string> arguments =
      bots_arguments(experiment_, cell_, key_log_, address, file_of(node, ".bots.json"));
  set_flag(arguments, "--count", std::to_string(clients));
  arguments.insert(arguments.end(), {"--first", std::to_string(first)});
  processes_.emplace_back("the bots of " + server.who, settings_.bots, arguments).is_of_bots = true;
}

/// Returns when all have ended well.
void NodeProcesses::await() {
  const double limit_s = experiment_.warm_up_s + experiment_.duration_s + settings_.join_limit_s;
  auto deadline = after(limit_s);
  const auto running = [this] { return std::ranges::find_if(processes_, &Named::runs); };
  for (auto next = running(); next != processes_.end() && Clock::now() <= deadline;
       next = running()) {
    settings_.heed_interrupt();
    next->process.attend(look_interval);
    for (Named& each : processes_)
      if (each.runs()) each.process.attend(milliseconds(0));
    const bool had_failed = !failed_.empty();
    note_failures();
    if (!failed_.empty() && !had_failed) deadline = std::min(deadline, after(survivor_limit_s));
  }
  if (!failed_.empty()) name_failure();
  if (const auto late = running(); late != processes_.end())
    throw Failure{with_stderr_tail(late->who + " had not ended after " + decimal(limit_s) + " s",
                                   late->process)};
}

void NodeProcesses::note_failures() {
  for (Named& each : processes_)
    if (each.has_failed() && !std::exchange(each.is_noted, true)) failed_.push_back(&each);
}

/// Named is the first node that failed by itself; else the first bots that did so, which may be
/// because of their node; else the first that ended for another's sake.
void NodeProcesses::name_failure() const {
  assert(!failed_.empty());
  const Named& named = **std::ranges::min_element(failed_, {}, [](const Named* each) {
    return each->process.ending()->exit_status == node_is_gone ? 2 : each->is_of_bots ? 1 : 0;
  });
  throw Failure{with_stderr_tail(named.who + " " + named.process.ending()->text(), named.process) +
                (failed_.size() == 1 ? ""
                                     : "; " + std::to_string(failed_.size() - 1) +
                                           " other processes ended after it")};
}

std::vector<NodeResults> NodeProcesses::results() const {
  std::vector<NodeResults> results;
  for (std::size_t node = 0; node < count(); ++node)
    results.push_back(
        {.number = numbers_[node],
         .server = report_at(file_of(node, ".server.json"), processes_[node].who),
         .bots = report_at(file_of(node, ".bots.json"), processes_[count() + node].who)});
  std::ranges::sort(results, {}, &NodeResults::number);
  for (std::uint32_t number = 0; number < results.size(); ++number)
    if (results[number].number != number) throw Failure{"two nodes have the same number"};
  return results;
}

/// That all nodes are in one state in the end, and one engine is, under the keys that they felt.
void NodeProcesses::expect_one_game(const std::vector<NodeResults>& results) const {
  const std::string hash = end_hash(results.front());
  for (const NodeResults& each : results)
    if (end_hash(each) != hash)
      throw Failure{"nodes 0 and " + std::to_string(each.number) + " end in different states"};
  const std::filesystem::path record = file_of(0, ".keys");
  try {
    const game::KeyLog log = game::read_key_log(record);
    game::require_complete(log, record.string());
    if (hexadecimal(game::replay(log, scene_of(experiment_, cell_))) != hash)
      throw Failure{"one engine plays another game than the nodes with the same keys"};
  } catch (const game::SceneError& error) {
    throw Failure{error.what()};
  }
}

void NodeProcesses::add_processor_times(RunRecord& record) const {
  double nodes_s = 0.0, bots_s = 0.0, busiest_s = 0.0;
  for (std::size_t node = 0; node < count(); ++node) {
    const double own_s = processes_[node].process.ending()->cpu_s;
    nodes_s += own_s, busiest_s = std::max(busiest_s, own_s);
    bots_s += processes_[count() + node].process.ending()->cpu_s;
  }
  record.server_cpu_s = nodes_s, record.bots_cpu_s = bots_s;
  record.nodes.busiest_cpu_s = busiest_s;
  record.nodes.mean_cpu_s = (nodes_s + bots_s) / (count() + cell_.clients);
}

void NodeProcesses::run(RunRecord& record) {
  start_node({});
  const std::string first = awaited_line(settings_, processes_.front().process,
                                         "nodes reach this one at ", processes_.front().who);
  for (std::uint32_t node = 1; node < count(); ++node) start_node(first);
  for (std::size_t node = 0; node < count(); ++node) start_bots(node);
  await();
  add_processor_times(record);
  const std::vector<NodeResults> all = results();
  expect_one_game(all);
  const nlohmann::ordered_json server = nodes_report(all), bots = bots_report_of(all);
  const std::string name = name_of(cell_);
  write_json(settings_.directory / (name + ".server.json"), server);
  write_json(settings_.directory / (name + ".bots.json"), bots);
  judge(record, server, bots);
}

}  // namespace

void run_nodes(const RunnerSettings& settings, const Experiment& experiment,
               const std::filesystem::path& key_log, RunRecord& record) {
  assert(record.cell.parameters.nodes > 1);
  NodeProcesses(settings, experiment, key_log, record.cell).run(record);
}

}  // namespace rink::loadgen
