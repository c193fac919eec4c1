// Starts the first peer, then all others, waits for them within limits, and combines their reports.
#include "loadgen/run/peers/peer_processes.h"

#include <algorithm>
#include <chrono>
#include <deque>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <system_error>

#include "game/model/report_fields.h"
#include "game/net/peer/network/seating.h"
#include "game/net/peer/peer_trace.h"
#include "game/net/trace_lines.h"
#include "game/process/process.h"
#include "loadgen/run/game_plan.h"
#include "loadgen/run/peers/peer_judgement.h"
#include "loadgen/run/process_run.h"
#include "loadgen/run/virtual_parts.h"

namespace rink::loadgen {
namespace {

using std::chrono::milliseconds;

constexpr int peer_is_gone = 16;  // rink peer's exit status when it ends for another's sake

class PeerProcesses {
 public:
  PeerProcesses(const RunnerSettings& settings, const Experiment& experiment, const Cell& cell,
                const std::filesystem::path& key_log)
      : settings_(settings),
        experiment_(experiment),
        cell_(cell),
        key_log_(key_log),
        scene_(scene_of(experiment, cell)),
        keys_(keys_in(key_log, scene_)) {}

  void run(RunRecord& record);

 private:
  std::filesystem::path file_of(std::size_t process, const char* ending) const {
    return settings_.directory / (name_of(cell_) + ".peer" + std::to_string(process) + ending);
  }
  std::vector<std::string> arguments(const std::string& first, std::size_t number) const;
  void start(const std::string& first);
  std::string address_of_first();
  void await();
  [[noreturn]] void name_failures();
  void read();
  void replay(Measurements& measured, PeerTotals& totals) const;
  PeerTotals totals() const;
  void add_decisions(game::ServerTrace& server, const game::Game& start) const;

  const RunnerSettings& settings_;
  const Experiment& experiment_;
  const Cell& cell_;
  const std::filesystem::path& key_log_;
  game::Scene scene_;
  std::vector<game::InputEvent> keys_;
  std::deque<game::Process> processes_;
  std::vector<nlohmann::json> reports_;  ///< by process
  std::vector<game::PeerTrace> trace_;
};

/// The first peer, or if `first` is not empty one that joins the peer there (ADDRESS:PORT).
std::vector<std::string> PeerProcesses::arguments(const std::string& first,
                                                  std::size_t number) const {
  std::vector<std::string> words{"--scene", experiment_.scene};
  const auto add = [&words](const char* flag, const std::string& value) {
    words.insert(words.end(), {flag, value});
  };
  if (experiment_.population == Population::per_client)
    add("--bats", std::to_string(cell_.clients));
  if (cell_.bats > 0) add("--bat-count", std::to_string(cell_.bats));
  if (cell_.pucks > 0) add("--puck-count", std::to_string(cell_.pucks));
  add("--seed", std::to_string(cell_.seed));
  add("--keys", key_log_.string());
  add("--pace", "realtime");
  add("--transport", to_string(experiment_.transport));
  add("--listen", "127.0.0.1:0");
  if (first.empty()) {
    add("--peers", std::to_string(cell_.clients));
    add("--until", decimal(static_cast<double>(last_window(experiment_, cell_)) /
                           cell_.parameters.tick_rate_hz));
    add("--window", decimal(1.0 / cell_.parameters.tick_rate_hz));
    add("--balance", "0");
    add("--scheme", cell_.scheme);
    add("--policy", cell_.policy);
    if (im::names_scheme(cell_.scheme, "always"))
      for (const std::string& kind : experiment_.always) add("--always", kind);
    if (cell_.parameters.cell_size > 0.0) add("--cell-size", decimal(cell_.parameters.cell_size));
    words.insert(words.end(), {"--unmirrored", "--seated"});
  } else {
    add("--join", first);
  }
  add("--view", decimal(cell_.parameters.view_fraction));
  if (experiment_.view_area > 0.0) add("--view-area", decimal(experiment_.view_area));
  if (cell_.parameters.view_margin > 0.0)
    add("--view-margin", decimal(cell_.parameters.view_margin));
  add("--warm-up", decimal(experiment_.warm_up_s));
  add("--evidence-seed", std::to_string(cell_.seed));
  add("--evidence", file_of(number, ".jsonl").string());
  add("--report", file_of(number, ".json").string());
  return words;
}

void PeerProcesses::start(const std::string& first) {
  const std::size_t number = processes_.size();
  std::error_code ignored;
  for (const char* ending : {".json", ".jsonl"})
    std::filesystem::remove(file_of(number, ending), ignored);
  processes_.emplace_back(settings_.peer, arguments(first, number));
}

std::string PeerProcesses::address_of_first() {
  game::Process& first = processes_.front();
  for (const auto deadline = after(settings_.listen_limit_s);;) {
    settings_.heed_interrupt();
    first.attend(look_interval);
    if (const auto address = first.line_after("listening on ")) return *address;
    if (first.ending())
      throw Failure{"the first peer " + first.ending()->text() + " before it listened" +
                    (first.stderr_tail().empty() ? "" : ", saying: " + first.stderr_tail())};
    if (Clock::now() > deadline)
      throw Failure{"the first peer did not listen within " + decimal(settings_.listen_limit_s) +
                    " s"};
  }
}

/// Returns when all have ended well.
void PeerProcesses::await() {
  const double limit_s = experiment_.warm_up_s + experiment_.duration_s + settings_.join_limit_s;
  auto deadline = after(limit_s);
  bool has_failed = false;
  const auto runs = [](const game::Process& process) { return !process.ending(); };
  for (auto running = processes_.begin(); running != processes_.end();
       running = std::find_if(processes_.begin(), processes_.end(), runs)) {
    settings_.heed_interrupt();
    running->attend(look_interval);
    for (game::Process& process : processes_)
      if (!process.ending()) process.attend(milliseconds(0));
    const bool fails =
        std::any_of(processes_.begin(), processes_.end(), [](const game::Process& process) {
          return process.ending() && !process.ending()->is_success();
        });
    if (fails && !has_failed) deadline = std::min(deadline, after(survivor_limit_s));
    has_failed = has_failed || fails;
    if (Clock::now() > deadline) break;
  }
  if (has_failed) name_failures();
  const auto late = std::count_if(processes_.begin(), processes_.end(), runs);
  if (late > 0)
    throw Failure{std::to_string(late) + " of " + std::to_string(processes_.size()) +
                  " peers had not ended after " + decimal(limit_s) + " s"};
}

/// Names peers that failed themselves, not those that ended because another was gone.
void PeerProcesses::name_failures() {
  std::string why;
  std::size_t others = 0;
  const auto name = [&](bool by_themselves) {
    for (std::size_t k = 0; k < processes_.size(); ++k) {
      const std::optional<game::Ending>& ending = processes_[k].ending();
      if (!ending || ending->is_success() || (ending->exit_status != peer_is_gone) != by_themselves)
        continue;
      if (!why.empty()) {
        ++others;
        continue;
      }
      const std::string words = processes_[k].stderr_tail();
      why = "peer process " + std::to_string(k) + " " + ending->text() +
            (words.empty() ? "" : ", saying: " + words);
    }
  };
  name(true);
  name(false);
  if (others > 0) why += "; " + std::to_string(others) + " others ended after it";
  throw Failure{why};
}

void PeerProcesses::read() {
  for (std::size_t k = 0; k < processes_.size(); ++k) {
    std::ifstream stream(file_of(k, ".json"));
    if (!stream) throw Failure{"peer process " + std::to_string(k) + " wrote no report"};
    reports_.push_back(nlohmann::json::parse(stream, nullptr, false));
    if (!reports_.back().is_object() || !reports_.back().contains(game::report::hash.key))
      throw Failure{"peer process " + std::to_string(k) + " wrote a report that is none"};
    if (reports_.back()[game::report::hash.key] != reports_.front()[game::report::hash.key])
      throw Failure{"peer processes 0 and " + std::to_string(k) + " end in different states"};
    try {
      trace_.push_back(game::read_peer_trace(file_of(k, ".jsonl")));
    } catch (const game::TraceError& error) {
      throw Failure{error.what()};
    }
    std::error_code ignored;
    std::filesystem::remove(file_of(k, ".jsonl"),
                            ignored);  // its content is in the combined files
  }
}

/// Latencies, from the instants that each peer noted.
void PeerProcesses::replay(Measurements& measured, PeerTotals& totals) const {
  const double window_s = 1.0 / cell_.parameters.tick_rate_hz;
  using Kind = game::PeerTrace::Kind;
  for (const game::PeerTrace& peer : trace_) {
    Probe probe(measured);
    for (const game::PeerTrace::Event& event : peer.events) {
      const bool is_counted = measured.is_counted(event.due_s);
      if (event.kind == Kind::key)
        measured.keys_due += is_counted, probe.key_sent(event.due_s, event.instant_s, is_counted);
      else probe.keys_felt(event.instant_s, event.felt);
      if (event.kind == Kind::known) probe.news_applied(event.due_s, event.instant_s, is_counted);
      if (event.kind != Kind::known || !is_counted) continue;
      ++totals.known;
      totals.on_time += event.instant_s <= event.due_s + window_s;
    }
    totals.keys_unanswered += probe.unanswered();
  }
}

PeerTotals PeerProcesses::totals() const {
  PeerTotals totals;
  totals.windows = last_window(experiment_, cell_);
  totals.measured_windows = loadgen::measured_windows(experiment_, cell_);
  totals.state_hash = reports_.front().at(game::report::hash.key);
  TrafficTotals begin;
  std::uint64_t kernel_sent = 0, kernel_received = 0, busiest_rss = 0;
  bool has_kernel = true;
  for (std::size_t k = 0; k < trace_.size(); ++k) {
    const game::PeerTrace& own = trace_[k];
    totals.measured.add(own.end), begin.add(own.begin);
    totals.measured_s +=
        (own.end.instant_s - own.begin.instant_s) / static_cast<double>(trace_.size());
    const nlohmann::json &report = reports_[k], &transport = report.at(game::report::transport);
    peer::PeerCounters counters;
    counters.windows = report.at(game::report::windows.key),
    counters.repeats = report.at(game::report::repeats.key);
    counters.own_events = report.at(game::report::own_events.key),
    counters.ghost_events = report.at(game::report::ghost_events.key);
    counters.hand_overs = report.at(game::report::hand_overs.key),
    counters.held_max = report.at(game::report::held_max.key);
    counters.ghost_windows = static_cast<std::uint64_t>(
        std::llround(report.at(game::report::mean_ghosts.key).get<double>() *
                     static_cast<double>(counters.windows + 1)));
    totals.counters += counters;
    totals.whole.bytes += transport.at(game::report::bytes_sent.key).get<std::uint64_t>();
    totals.whole_received += transport.at(game::report::bytes_received.key).get<std::uint64_t>();
    has_kernel = has_kernel && transport.at(game::report::kernel_bytes_sent.key).is_number();
    if (has_kernel)
      kernel_sent += transport.at(game::report::kernel_bytes_sent.key).get<std::uint64_t>(),
          kernel_received +=
          transport.at(game::report::kernel_bytes_received.key).get<std::uint64_t>();
    busiest_rss =
        std::max(busiest_rss, report.at(game::report::rss_bytes.key).get<std::uint64_t>());
  }
  totals.measured = totals.measured - begin;
  totals.busiest_rss = busiest_rss;
  if (has_kernel) totals.kernel_sent = kernel_sent, totals.kernel_received = kernel_received;
  else if (experiment_.transport == TransportKind::tcp)
    throw Failure{"the kernel counted no bytes of the peers' connections"};
  return totals;
}

/// Combines the decisions of all owners about their bodies.
void PeerProcesses::add_decisions(game::ServerTrace& server, const game::Game& start) const {
  const std::vector<std::uint32_t> bats = game::seated_division(start, cell_.clients).bats;
  std::map<std::pair<double, std::uint32_t>, std::vector<std::uint32_t>> scopes;
  for (const game::PeerTrace& peer : trace_)
    for (const game::PeerTrace::Decision& decision : peer.decisions) {
      if (decision.peer >= bats.size())
        throw Failure{"peer " + std::to_string(peer.peer) + " decided for peer " +
                      std::to_string(decision.peer) + ", which does not exist"};
      std::vector<std::uint32_t>& scope =
          scopes[{decision.instant_s, *start.entity({bats[decision.peer]}).player}];
      scope.insert(scope.end(), decision.bodies.begin(), decision.bodies.end());
    }
  for (auto& [key, scope] : scopes) {
    std::sort(scope.begin(), scope.end());
    scope.erase(std::unique(scope.begin(), scope.end()),
                scope.end());  // a handover is seen at both ends at nearly the same instant
    const std::size_t first = server.in_scope.size();
    server.in_scope.insert(server.in_scope.end(), scope.begin(), scope.end());
    server.decisions.push_back({key.first, key.second, first, server.in_scope.size()});
  }
}

void PeerProcesses::run(RunRecord& record) {
  start({});
  const std::string first = address_of_first();
  for (std::uint32_t k = 1; k < cell_.clients; ++k) start(first);
  await();
  read();
  const game::Game start(scene_);
  Measurements measured;
  measured.from_s = experiment_.warm_up_s,
  measured.until_s = experiment_.warm_up_s + experiment_.duration_s;
  PeerTotals sums = totals();
  sums.entities = start.entities().size();
  replay(measured, sums);
  double sum_s = 0.0, busiest_s = 0.0;
  for (const game::Process& process : processes_)
    sum_s += process.ending()->cpu_s, busiest_s = std::max(busiest_s, process.ending()->cpu_s);
  record.nodes.busiest_cpu_s = busiest_s,
  record.nodes.mean_cpu_s = sum_s / static_cast<double>(processes_.size());
  game::ServerTrace server = trace_of(experiment_, cell_, start, keys_, sums.state_hash);
  add_decisions(server, start);
  game::BotsTrace bots = bots_trace_of(server);
  for (const game::PeerTrace& peer : trace_)
    if (peer.player) append(bots, *peer.player);
  judge_peers(settings_, experiment_, record,
              {.totals = sums, .measured = measured, .server = server, .bots = std::move(bots)});
}

}  // namespace

std::optional<RunRecord> run_peer_processes(const RunnerSettings& settings,
                                            const Experiment& experiment, const Cell& cell,
                                            const std::filesystem::path& key_log) {
  return recorded(experiment, cell, [&](RunRecord& record) {
    try {
      PeerProcesses(settings, experiment, cell, key_log).run(record);
    } catch (const std::system_error& error) {
      throw Failure{error.what()};
    } catch (const nlohmann::json::exception& error) {
      throw Failure{std::string("a peer's report is not what was expected: ") + error.what()};
    }
  });
}

}  // namespace rink::loadgen
