// The loop of virtual_run.cpp for peers instead of a server and its bots: the clock moves to the
// next arrival, key, window's end or sample.
#include "loadgen/run/peers/peer_run.h"

#include <algorithm>
#include <cstring>
#include <deque>
#include <limits>
#include <memory>
#include <utility>

#include "game/control/key_log.h"
#include "game/net/peer/network/seating.h"
#include "game/net/relevant_kinds.h"
#include "game/net/view.h"
#include "im/basics/hexadecimal.h"
#include "loadgen/measure/run_record.h"
#include "loadgen/run/game_plan.h"
#include "loadgen/run/peers/peer_judgement.h"
#include "loadgen/run/peers/peer_schedule.h"
#include "loadgen/run/peers/peer_station.h"
#include "loadgen/run/virtual_parts.h"
#include "rti/transport/modelled/virtual_network.h"

namespace rink::loadgen {
namespace {

/// A station at its end of the network, with a connection to each other one. The connecting end
/// sends its number first.
class NetworkedStation : private rti::TransportListener {
 public:
  NetworkedStation(rti::VirtualNetwork& network, PeerStation& station, peer::PeerNumber number,
                   peer::PeerNumber count)
      : end_(network), station_(station), number_(number), connections_(count) {
    end_.listen(name_of(number));
  }
  /// Connects to all stations with a lower number.
  void connect() {
    for (peer::PeerNumber other = 0; other < number_; ++other)
      note(end_.connect(name_of(other)), other);
  }
  bool is_connected() const { return open_ + 1 == connections_.size(); }
  const std::string& error() const { return error_; }
  rti::TransportCounters totals() const { return end_.totals(); }
  /// Bytes sent to another one, with the headers of segments and acknowledgements.
  std::uint64_t link_bytes_to(peer::PeerNumber other) const {
    const rti::TransportCounters sent = end_.counters(connections_[other]);
    return sent.bytes_sent + static_cast<std::uint64_t>(segment_header_bytes) *
                                 (sent.segments_sent + sent.acknowledgements_sent);
  }

  void run_once() {
    if (end_.has_arrivals()) end_.poll({}, *this);
  }
  void flush() {
    for (peer::PeerNumber to = 0; to < connections_.size(); ++to) {
      std::vector<std::uint8_t>& outbox = station_.outbox(to);
      if (outbox.empty()) continue;
      const rti::Bytes bytes = std::as_bytes(std::span(outbox));
      end_.send(connections_[to], std::span(&bytes, 1));
      outbox.clear();
    }
  }

 private:
  static constexpr peer::PeerNumber unknown = 0xffffffffu;
  static std::string name_of(peer::PeerNumber number) { return "peer-" + std::to_string(number); }

  void note(rti::ConnectionId connection, peer::PeerNumber other) {
    if (others_.size() <= connection) others_.resize(connection + 1, unknown);
    others_[connection] = other;
    if (other != unknown) connections_[other] = connection;
  }
  void on_open(rti::ConnectionId connection) override {
    if (connection >= others_.size() || others_[connection] == unknown)
      return note(connection, unknown);
    std::array<std::byte, sizeof number_> words{};
    std::memcpy(words.data(), &number_, sizeof number_);
    const rti::Bytes bytes = words;
    end_.send(connection, std::span(&bytes, 1));
    ++open_;
  }
  void on_bytes(rti::ConnectionId connection, rti::Bytes bytes) override {
    if (others_[connection] == unknown) {
      peer::PeerNumber other = 0;
      std::memcpy(&other, bytes.data(), sizeof other);
      note(connection, other);
      ++open_;
      bytes = bytes.subspan(sizeof other);
    }
    try {
      if (!bytes.empty()) station_.receive(others_[connection], bytes);
    } catch (const peer::ProtocolError& error) {
      if (error_.empty()) error_ = "peer " + std::to_string(number_) + ": " + error.what();
    }
  }
  void on_close(rti::ConnectionId connection, rti::CloseReason reason,
                const std::string&) override {
    if (error_.empty())
      error_ = "peer " + std::to_string(number_) + ": connection to peer " +
               std::to_string(others_[connection]) + " is closed: " + rti::to_string(reason);
  }

  rti::VirtualEndpoint end_;
  PeerStation& station_;
  peer::PeerNumber number_;
  std::vector<rti::ConnectionId> connections_;  ///< by peer
  std::vector<peer::PeerNumber> others_;        ///< by connection
  std::size_t open_ = 0;
  std::string error_;
};

class PeerRun {
 public:
  PeerRun(const RunnerSettings& settings, const Experiment& experiment, const Cell& cell,
          const game::Scene& scene, const std::vector<game::InputEvent>& keys);

  void run();
  /// Evaluates the run; call it at the end.
  void judge(RunRecord& record) const;

 private:
  PeerTotals totals() const;
  double played_s() const { return experiment_.warm_up_s + experiment_.duration_s; }
  std::uint64_t last_window() const { return loadgen::last_window(experiment_, cell_); }
  void advance_until(std::int64_t until_ns);
  void flush();
  void act_when_due();
  double next_due_s() const;
  void connect();
  void note_decisions(double instant_s);
  std::string state_hash() const;
  TrafficTotals traffic() const;

  const RunnerSettings& settings_;
  const Experiment& experiment_;
  const Cell& cell_;
  game::SharedGame game_;
  game::SeatedDivision seats_;
  rti::NetworkModel model_;
  rti::VirtualNetwork network_;
  RunClock clock_;
  Measurements measurements_;
  std::deque<PeerStation> stations_;
  std::deque<NetworkedStation> ends_;
  PeerSchedule schedule_;
  std::vector<peer::PeerNumber> node_of_player_;
  std::vector<std::uint32_t> players_;  ///< that are watched
  game::ServerTrace trace_;
  TrafficTotals begin_, measured_;
  double measured_s_ = 0.0;
  bool has_started_ = false;
};

game::InterestSettings interest_settings(const Experiment& experiment, const Cell& cell,
                                         const game::Scene& scene,
                                         const std::vector<std::uint32_t>& bats) {
  const physics::Field& field = scene.world.field;
  game::InterestSettings settings;
  settings.always_relevant = game::relevant_kinds_of(scene, experiment.always);
  settings.scheme = cell.scheme, settings.policy = cell.policy,
  settings.cell_size = cell.parameters.cell_size;
  settings.half_side = game::view_half_side(experiment.view_area, cell.parameters.view_fraction,
                                            field.length, field.width);
  settings.margin = cell.parameters.view_margin;
  settings.rate_hz = cell.parameters.tick_rate_hz;
  settings.bats = bats;
  return settings;
}

PeerRun::PeerRun(const RunnerSettings& settings, const Experiment& experiment, const Cell& cell,
                 const game::Scene& scene, const std::vector<game::InputEvent>& keys)
    : settings_(settings),
      experiment_(experiment),
      cell_(cell),
      game_(scene, keys),
      seats_(game::seated_division(game_.start(), cell.clients)),
      model_(network_conditions(experiment, cell)),
      network_(model_) {
  const game::InterestSettings interest = interest_settings(experiment, cell, scene, seats_.bats);
  const PeerMeasuring measuring{.clock = clock_, .measurements = measurements_};
  measurements_.from_s = experiment.warm_up_s, measurements_.until_s = played_s();
  for (peer::PeerNumber number = 0; number < cell.clients; ++number) {
    PeerStation& station =
        stations_.emplace_back(game_, interest, seats_.division, number, measuring);
    ends_.emplace_back(network_, station, number, cell.clients);
  }
  node_of_player_.resize(game_.start().player_count(), cell.clients);
  for (peer::PeerNumber number = 0; number < cell.clients; ++number)
    for (const game::Entity& entity : game_.start().entities())
      if (entity.id.index == seats_.bats[number]) node_of_player_[*entity.player] = number;
  std::vector<game::InputEvent> played = keys;
  std::erase_if(played, [&](const game::InputEvent& key) {
    return node_of_player_[key.player] == cell.clients || key.time >= played_s();
  });
  schedule_.plan_keys(std::move(played));
  trace_.keys = keys;
  if (!settings.wants_truth) return;
  const game::SamplingSettings sampling{.seed = cell.seed,
                                        .clients = cell.clients,
                                        .from_s = experiment.warm_up_s,
                                        .until_s = played_s()};
  players_ = game::sampled_players(sampling);
  schedule_.plan_samples(game::sampled_instants(sampling, 1), game::sampled_instants(sampling, 2));
  for (const std::uint32_t player : players_) stations_[node_of_player_[player]].watch();
}

void PeerRun::flush() {
  for (NetworkedStation& end : ends_) {
    end.flush();
    if (!end.error().empty()) throw Failure{end.error()};
  }
}

double PeerRun::next_due_s() const {
  constexpr double never = std::numeric_limits<double>::infinity();
  return has_started_ ? clock_.start_s + schedule_.next_s() : never;
}

void PeerRun::act_when_due() {
  if (!has_started_) return;
  const double now_s = clock_.simulated_s();
  while (const game::InputEvent* key = schedule_.take_key(clock_.start_s, clock_.now_s))
    stations_[node_of_player_[key->player]].press(key->time);
  while (const auto instant_s = schedule_.take_decision(now_s)) note_decisions(*instant_s);
  while (schedule_.take_sample(now_s))
    for (const std::uint32_t player : players_) stations_[node_of_player_[player]].sample();
}

/// Handles all events up to and at `until_ns`.
void PeerRun::advance_until(std::int64_t until_ns) {
  for (;;) {
    settings_.heed_interrupt();
    std::int64_t next_ns = network_.next_arrival_ns().value_or(INT64_MAX);
    if (const double due_s = next_due_s(); due_s < 1e9)
      next_ns = std::min(next_ns, std::max(network_.now_ns(), not_before(due_s)));
    if (next_ns > until_ns) break;
    network_.advance_to(next_ns);
    clock_.now_s = network_.now_s();
    for (NetworkedStation& end : ends_) end.run_once();
    act_when_due();
    flush();
  }
  network_.advance_to(until_ns);
  clock_.now_s = network_.now_s();
}

void PeerRun::connect() {
  for (NetworkedStation& end : ends_) end.connect();
  for (int tries = 0; !std::all_of(ends_.begin(), ends_.end(),
                                   [](const NetworkedStation& end) { return end.is_connected(); });
       ++tries) {
    if (tries == 64) throw Failure{"waited in vain for all peers to be connected"};
    advance_until(network_.now_ns() + settling_ns(experiment_));
  }
}

void PeerRun::run() {
  connect();
  const std::int64_t start_ns = (network_.now_ns() / second_ns + 1) *
                                second_ns;  // a whole second: sums with it are rounded least
  advance_until(start_ns);
  for (rti::Partition cut : experiment_.network.partitions) {
    cut.from_ns += start_ns, cut.until_ns += start_ns;
    model_.add(cut);
  }
  clock_.start_s = network_.now_s();
  has_started_ = true;
  bool is_measuring = false;
  std::int64_t measured_from_ns = 0;
  for (std::uint64_t window = 0; window <= last_window(); ++window) {
    const double simulated_s = static_cast<double>(window) / cell_.parameters.tick_rate_hz;
    advance_until(start_ns + nanoseconds(simulated_s));
    if (!is_measuring && simulated_s >= experiment_.warm_up_s)
      is_measuring = true, begin_ = traffic(), measured_from_ns = network_.now_ns();
    // The last window's end closes the span and is not in it: n windows, and the n periods that
    // they begin.
    if (window == last_window())
      measured_ = traffic() - begin_,
      measured_s_ = 1e-9 * static_cast<double>(network_.now_ns() - measured_from_ns);
    if (window == 0) continue;
    for (PeerStation& station : stations_) station.due();
    flush();
  }
  const auto is_done = [&](const PeerStation& station) {
    return station.node().windows_final() == last_window() && station.node().is_idle();
  };
  advance_until(start_ns + nanoseconds(played_s()) + 4 * settling_ns(experiment_) + 1);
  for (int tries = 0; !std::all_of(stations_.begin(), stations_.end(), is_done); ++tries) {
    if (tries == 1000)
      throw Failure{
          "the peers had not agreed on the last window long after its end: with this delay, "
          "agreement takes longer than a window"};
    advance_until(network_.now_ns() + settling_ns(experiment_));
  }
}

TrafficTotals PeerRun::traffic() const {
  TrafficTotals totals;
  for (std::size_t k = 0; k < stations_.size(); ++k)
    totals.add(stations_[k].node(), ends_[k].totals());
  totals.link.assign(ends_.size(), 0);
  for (peer::PeerNumber from = 0; from < ends_.size() && has_started_; ++from)
    for (peer::PeerNumber to = 0; to < ends_.size(); ++to) {
      if (to == from) continue;
      const std::uint64_t bytes = ends_[from].link_bytes_to(to);
      totals.link[from] += bytes, totals.link[to] += bytes;
    }
  return totals;
}

/// Notes which player receives which entities, by the owners' latest decisions.
void PeerRun::note_decisions(double instant_s) {
  for (const std::uint32_t player : players_) {
    const peer::PeerNumber node = node_of_player_[player];
    const std::size_t first = trace_.in_scope.size();
    for (const PeerStation& station : stations_) {
      const std::vector<std::uint32_t>& scope = station.node().interest().sender().scope_of(node);
      for (const std::uint32_t body : scope)
        if (station.node().interest().owns(body)) trace_.in_scope.push_back(body);
    }
    std::sort(trace_.in_scope.begin() + static_cast<std::ptrdiff_t>(first), trace_.in_scope.end());
    trace_.decisions.push_back({instant_s, player, first, trace_.in_scope.size()});
  }
}

std::string PeerRun::state_hash() const {
  std::vector<peer::Handover> parts;
  for (const PeerStation& station : stations_)
    parts.push_back(peer::own_bodies(station.node().peer()));
  const auto world =
      peer::hash_of_whole(game_.start().world().spec(), game_.start().world().body_count(), parts);
  if (!world) throw Failure{"not every body has one owner in the end"};
  return hexadecimal(
      game_.hash(*world, static_cast<double>(last_window()) / cell_.parameters.tick_rate_hz));
}

PeerTotals PeerRun::totals() const {
  PeerTotals totals;
  totals.measured = measured_, totals.measured_s = measured_s_;
  totals.windows = last_window();
  totals.measured_windows = loadgen::measured_windows(experiment_, cell_);
  totals.entities = game_.start().entities().size();
  totals.state_hash = state_hash();
  totals.whole = traffic();
  totals.whole_received = totals.whole.bytes;
  for (const PeerStation& station : stations_) {
    totals.counters += station.node().peer().counters();
    totals.keys_unanswered += station.probe().unanswered();
    totals.known += station.windows_known(), totals.on_time += station.windows_on_time();
  }
  return totals;
}

void PeerRun::judge(RunRecord& record) const {
  const PeerTotals sums = totals();
  game::ServerTrace server =
      trace_of(experiment_, cell_, game_.start(), trace_.keys, sums.state_hash);
  server.decisions = trace_.decisions, server.in_scope = trace_.in_scope;
  game::BotsTrace bots = bots_trace_of(server);
  for (const std::uint32_t player : players_)
    append(bots, stations_[node_of_player_[player]].trace());
  judge_peers(
      settings_, experiment_, record,
      {.totals = sums, .measured = measurements_, .server = server, .bots = std::move(bots)});
}

void run_peers(const RunnerSettings& settings, const Experiment& experiment, const Cell& cell,
               const std::filesystem::path& key_log, RunRecord& record) {
  const game::Scene scene = scene_of(experiment, cell);
  PeerRun run(settings, experiment, cell, scene, keys_in(key_log, scene));
  try {
    run.run();
  } catch (const peer::ProtocolError& error) {
    throw Failure{error.what()};
  }
  run.judge(record);
}

}  // namespace

std::optional<RunRecord> run_virtual_peers(const RunnerSettings& settings,
                                           const Experiment& experiment, const Cell& cell,
                                           const std::filesystem::path& key_log) {
  return recorded(experiment, cell, [&](RunRecord& record) {
    run_peers(settings, experiment, cell, key_log, record);
  });
}

}  // namespace rink::loadgen
