// The loop of a server, in real time or by turns.
#include "game/apps/server_process.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "game/apps/command.h"
#include "game/model/report_fields.h"
#include "game/net/gate.h"
#include "game/net/interrupt.h"
#include "game/net/server/overload/standstill.h"
#include "game/net/server/serve_requirements.h"
#include "game/replication/names.h"

namespace rink::game {
namespace {

using Json = nlohmann::ordered_json;
constexpr double not_started_s = 0.0;  ///< the due instant in stamps before the start

/// The bat of a player that has left before the start goes to whoever comes.
double begin(SharedPlay& shared, const Seats& seats) {
  const double start_s = shared.begin();
  for (std::uint32_t player = shared.first_player();
       player < shared.first_player() + shared.player_count(); ++player)
    if (!seats.federate_of(player)) shared.leave_seat(player, SharedPlay::nobody);
  return start_s;
}

}  // namespace

ServerProcess::ServerProcess(const ServeOptions& options, const rti::Fom& fom,
                             const ServedGame& played, const std::string& federation)
    : options_(options),
      begin_s_(played.begun ? played.begun->now() : 0.0),
      sockets_(options.transport),
      serving_(fom, played.scene,
               {.federation = federation,
                .policy = options.policy,
                .threshold = options.threshold,
                .sweep_ticks = options.sweep_ticks,
                .tick_s = 1.0 / options.rate_hz,
                .is_synchronous = options.pace == "synchronous",
                .is_time_managed = options.is_time_managed,
                .replay = played.replay,
                .hosting = hosting_of(options),
                .key_limit_per_s = options.key_limit_per_s,
                .push_limit_per_s = options.push_limit_per_s,
                .events_per_s = options.events_per_s,
                .always_relevant = relevant_kinds_of(played.scene, options.always),
                .state = played.state,
                .shared = played.shared},
               federation_of(options, played.scene, federation,
                             options.has_second_core ? &second_core_.emplace() : nullptr),
               {now_s, [this] { return simulated_now(); }}),
      clients_(sockets_.get()),
      ledger_(options.counts_fields ? &add_ledger(clients_, fom) : nullptr),
      stagger_(clients_.add<rti::Stagger>(options.spread / options.rate_hz, now_s)),
      server_(serving_.server()),
      records_(options.record),
      shared_(played.shared),
      output_rates_(update_rate_of(options.output_rate_hz, options.rate_hz)) {
  if (!needs_every_tick(options))
    overload_.emplace(OverloadControl::Settings{.tick_s = 1.0 / options.rate_hz});
  add_gate(clients_,
           {.key_file = options.key_file,
            .federation = federation,
            .rate_limit = {options.rate_limit_bytes_per_s, options.frame_limit_per_s},
            .address_limit = options.address_limit},
           now_s);
  serving_.host().add(clients_);
  if (!options.trace.empty())
    serving_.collect_trace({.seed = options.seed,
                            .clients = options.clients,
                            .from_s = begin_s_ + options.warm_up_s,
                            .until_s = begin_s_ + options.duration_s},
                           options.rate_hz);
}

/// Never decreases: a tick that is cut short stops it until real time has caught up.
double ServerProcess::simulated_now() const {
  const double now = start_s_ == 0.0 ? begin_s_
                     : options_.pace == "synchronous"
                         ? server_.game().now()
                         : begin_s_ + std::max(0.0, now_s() - start_s_) - behind_s_;
  return latest_s_ = std::max(latest_s_, now);
}

void ServerProcess::exchange_until(double until_s) {
  do serving_.exchange(std::min(0.25, until_s - now_s()));
  while (now_s() < until_s && !is_interrupted);
}

/// What other nodes play is shown as soon as all have told it. Players wait for it no longer than
/// most of a tick's period: then the tick goes out without it.
void ServerProcess::await_window(double due_s, double until) {
  constexpr double look_s = 0.001, patience = 0.75;  // the second is a part of the period
  const double give_up_s = due_s + patience / options_.rate_hz;
  while (!is_interrupted && now_s() < give_up_s && !shared_->has_come(until))
    serving_.exchange(std::clamp(give_up_s - now_s(), 0.0, look_s));
}

/// However long the players take, silence is noticed and heartbeats are sent.
void ServerProcess::await_turns() {
  if (server_.game().is_cut_short()) serving_.exchange(0.0);  // it may not wait for anybody
  while (!is_interrupted && server_.error().empty() && !server_.may_step()) {
    serving_.exchange(0.25);
    serving_.host().advance_clock(now_s());
  }
}

/// The RTI's clock goes on while all wait at the barrier, as crowds with datagrams do for long, or
/// the server's own federate takes the RTI for dead and its next update is refused.
void ServerProcess::wait(double seconds) {
  TickCosts uncounted;
  serving_.exchange(seconds);
  if (shared_) shared_->check();
  if (server_.is_joined() && server_.error().empty())
    serving_.send(begin_s_, not_started_s, uncounted);
  serving_.host().advance_clock(now_s());
}

bool ServerProcess::start() {
  const double give_up_s = now_s() + options_.patience_s;
  const auto may_wait = [&] {
    return !is_interrupted && server_.error().empty() && now_s() <= give_up_s;
  };
  const auto are_all_there = [&] {
    return server_.is_joined() && server_.seats().player_count() >= options_.clients;
  };
  while (!are_all_there() && may_wait()) wait(0.02);
  if (!are_all_there()) return false;
  server_.call_to_start();
  while (!server_.is_started() && may_wait()) wait(0.005);
  // The players of other nodes may take as long as these.
  while (server_.is_started() && shared_ && !shared_->may_begin() && may_wait()) wait(0.005);
  return server_.is_started() && (!shared_ || shared_->may_begin());
}

/// The tick that comes next instead of one that is too far behind, with all that happened since.
std::uint64_t ServerProcess::leave_out(std::uint64_t number, std::uint64_t last, bool is_counted) {
  const double due_s = start_s_ + static_cast<double>(number) / options_.rate_hz;
  const std::uint64_t late = overload_ ? overload_->ticks_left_out(due_s, now_s())
                                       : ticks_stood_still(options_, due_s, now_s()),
                      left_out = std::min(late, last - number);
  if (is_counted) costs_.ticks_left_out += left_out;
  return number + left_out;
}

/// Plays ticks that were left out, hearing from clients meanwhile. Returns up to when the tick at
/// hand shall play, earlier where that takes longer than what is played; adds to `physics_s` [s].
double ServerProcess::catch_up(double simulated_s, double& physics_s) {
  if (!overload_) return simulated_s;
  constexpr double patience_s = 1.0, silence_s = 0.25;
  const double period_s = 1.0 / options_.rate_hz, give_up_s = now_s() + patience_s;
  double heard_s = now_s();
  for (double until = server_.game().now() + period_s; until + 0.5 * period_s < simulated_s;
       until += period_s) {
    const double begin_s = now_s();
    server_.simulate(until);
    physics_s += now_s() - begin_s;
    if (server_.game().is_cut_short() || is_interrupted || !server_.error().empty()) break;
    if (now_s() >= give_up_s) {
      behind_s_ += simulated_s - until;
      return until;
    }
    if (now_s() < heard_s + silence_s) continue;
    serving_.exchange(0.0);
    serving_.host().advance_clock(now_s());
    heard_s = now_s();
  }
  return simulated_s;
}

void ServerProcess::tick(std::uint64_t number, bool is_counted) {
  const double begin_s = now_s(), period_s = 1.0 / options_.rate_hz,
               elapsed_s = static_cast<double>(number) * period_s;
  double caught_up_s = 0.0;
  const double simulated_s = catch_up(
      options_.hosted.empty() ? goal(number) : server_.follow_match(elapsed_s), caught_up_s);
  const double due_s = options_.pace == "synchronous" ? now_s() : start_s_ + elapsed_s;
  if (shared_) await_window(due_s, simulated_s);
  const TickCosts tick = serving_.tick(simulated_s, due_s);
  fall_behind(elapsed_s, simulated_s);
  keep_records();
  report_flood();
  const bool is_told_as_asked = output_rates_.divisor() == 1;
  follow_load(due_s, begin_s, tick.send_s);
  if (!is_counted) return;
  costs_.physics_s += caught_up_s + tick.physics_s;
  costs_.filter_s += tick.filter_s;
  costs_.send_s += tick.send_s;
  costs_.send_max_s = std::max(costs_.send_max_s, tick.send_s);
  ++costs_.ticks;
  follow_times_updated(serving_, costs_.end);
  if (is_told_as_asked && now_s() <= due_s + period_s) ++costs_.ticks_on_time;
}

/// Under overload all clients are told less often, so that the game goes on and nobody is lost.
void ServerProcess::follow_load(double due_s, double begin_s, double telling_s) {
  if (!overload_) return;
  output_rates_.add_newcomers(server_, serving_.execution());
  if (!overload_->ticked(due_s, begin_s, now_s(), telling_s)) return;
  const std::uint32_t before = output_rates_.divisor(), now = overload_->divisor();
  output_rates_.set_divisor(server_, serving_.execution(), now);
  if (before < now)
    warn("ticks run late with ", server_.seats().player_count(), " clients: each is sent one of ",
         now, " of its updates");
}

/// Under time management ticks keep to their grid whatever has been put off. Nodes play a window
/// where it begins, so that it is there long before it ends: waiting for its end would only delay
/// the keys.
double ServerProcess::goal(std::uint64_t number) const {
  const double period_s = 1.0 / options_.rate_hz;
  if (shared_) return static_cast<double>(number + 1) * period_s;
  if (options_.is_time_managed)
    return begin_s_ + static_cast<double>(number - ticks_put_off_) * period_s;
  return begin_s_ + static_cast<double>(number) * period_s - behind_s_;
}

/// Neither clock nor players wait for a tick that was cut short; nothing is made up for in a rush.
void ServerProcess::fall_behind(double elapsed_s, double simulated_s) {
  if (const auto complaint = server_.budget().take_complaint()) warn("--budget: ", *complaint);
  if (!server_.game().is_cut_short()) return;
  const double played_s = server_.game().now();
  if (options_.is_time_managed)
    behind_s_ = static_cast<double>(++ticks_put_off_) / options_.rate_hz;
  else if (!server_.hosted()) behind_s_ += simulated_s - played_s;
  else if (played_s < simulated_s) server_.hosted()->fall_behind(elapsed_s, played_s);
}

/// Where a side has won early, players find the game standing still until they leave, or its agreed
/// end: they would take a server that ends for lost.
bool ServerProcess::has_ended() const {
  if (!shared_ || !options_.hosted.empty() || !shared_->has_shown_all()) return false;
  return !server_.game().is_over() || server_.seats().player_count() == 0;
}

void ServerProcess::run() {
  constexpr double lead_s = 0.1;  // so that the first tick is not late
  start_s_ = shared_ ? begin(*shared_, server_.seats()) : now_s() + lead_s;
  const std::uint64_t last =
      options_.duration_s > 0.0
          ? static_cast<std::uint64_t>(std::floor(options_.duration_s * options_.rate_hz + 1e-9))
          : ~0ull;
  bool is_measuring = false;
  for (std::uint64_t number = 0; number <= last && !is_interrupted && server_.error().empty();
       ++number) {
    if (options_.pace == "synchronous") await_turns();
    else exchange_until(start_s_ + static_cast<double>(number) / options_.rate_hz);
    if (is_interrupted || !server_.error().empty() || has_ended()) break;
    number = leave_out(number, last, is_measuring);
    if (!is_measuring && static_cast<double>(number) / options_.rate_hz >= options_.warm_up_s) {
      is_measuring = true;
      costs_.game_from_s = server_.game().now();
      costs_.from_s = now_s();
      stagger_.forget_bursts();
      costs_.begin = costs_.end = counts();
    }
    // The last tick closes the span and is not in it: n ticks, and the n periods that they begin.
    if (is_measuring && number == last) end_span();
    tick(number, is_measuring && number < last);
  }
  if (is_measuring && !costs_.has_ended) end_span();
}

void ServerProcess::show_rest() {
  assert(shared_);
  while (!shared_->has_shown_all() && !is_interrupted && server_.error().empty()) {
    serving_.exchange(0.005);
    serving_.tick(options_.duration_s, now_s());
  }
}

void ServerProcess::end_span() {
  costs_.has_ended = true;
  costs_.span_s = now_s() - costs_.from_s;
  costs_.game_span_s = server_.game().now() - costs_.game_from_s;
  auto times_updated = std::move(costs_.end.times_updated);  // of clients that left early, too
  (costs_.end = counts()).times_updated = std::move(times_updated);
}

ServingCounts ServerProcess::counts() const {
  ServingCounts counts = counts_of(serving_, sockets_.totals());
  if (shared_) counts.to_nodes = shared_->sent();
  if (ledger_ != nullptr) counts.fields = ledger_->rows();
  return counts;
}

std::string ServerProcess::missing() const {
  std::vector<std::string> absent = options_.members;
  for (const rti::FederateReport& each : serving_.execution().report().federates)
    std::erase(absent, each.name);
  std::string names;
  for (const std::string& each : absent) names += (names.empty() ? "; missing: " : ", ") + each;
  return names;
}

void ServerProcess::end() {
  const double give_up_s = now_s() + (is_interrupted ? 0.0 : 2.0);
  while (server_.seats().player_count() > 0 && now_s() < give_up_s) serving_.exchange(0.01);
  if (options_.hosted.empty()) return;
  server_.finish_record();
  keep_records();
}

void ServerProcess::try_records() {
  if (options_.hosted.empty()) return;
  if (const auto error = records_.test()) complain(*error, "; matches are played without a record");
}

/// Reported once, since a federate that sends too much could fill the terminal too.
void ServerProcess::report_flood() {
  const KeyCounters& counters = server_.keys().counters();
  if (counters.over_limit == 0 || std::exchange(is_flood_reported_, true)) return;
  const bool is_push = counters.is_push_over_limit;
  warn("the player of ", bat_name(counters.player_over_limit), " sends more than ",
       is_push ? options_.push_limit_per_s : options_.key_limit_per_s,
       is_push ? " pushes a second (--push-limit)" : " key changes a second (--key-limit)",
       ": what is more is not felt");
}

/// Players see on their screens if there is no record.
void ServerProcess::keep_records() {
  if (!server_.hosted()) return;
  for (const KeyLog& log : server_.hosted()->take_finished()) {
    if (const auto error = records_.keep(log)) complain(*error, "; matches go on");
    server_.hosted()->set_unrecorded(records_.is_failing());
  }
  const auto record_so_far = [this] {
    return server_.hosted()->record_so_far(server_.game(), server_.keys().recorded());
  };
  if (const auto error = records_.follow(now_s(), record_so_far))
    complain(*error, "; matches go on");
}

std::optional<ServerTrace> ServerProcess::trace(const ServedGame& played) const {
  std::optional<ServerTrace> trace = serving_.trace();
  if (!trace) return std::nullopt;
  trace->choice = played.choice;
  trace->state_file = options_.from_state;
  trace->state = played.state;
  trace->scheme = options_.scheme;
  trace->policy = options_.policy;
  return trace;
}

Json ServerProcess::report() const {
  const double ticks = std::max<double>(1.0, static_cast<double>(costs_.ticks));
  std::string why_invalid = is_interrupted ? "interrupted" : server_.error();
  if (why_invalid.empty() && costs_.ticks == 0) why_invalid = "no tick was measured";
  const TickBudgetCounters& budget = server_.budget().counters();
  if (why_invalid.empty() && budget.ticks_cut_short > 0)
    why_invalid = "the physics exceeded --budget: " + text_of(budget);
  Json report{
      {report::mode, "client-server"},
      {report::scheme, options_.scheme},
      {report::policy, options_.policy},
      {report::threshold, options_.threshold},
      {report::clients, options_.clients},
      {report::seed, options_.seed},
      {report::tick_rate_hz, options_.rate_hz},
      {report::output_rate_hz, options_.output_rate_hz},
      {"pace", options_.pace},
      {"time_managed", options_.is_time_managed},
      {report::ticks, costs_.ticks},
      {report::ticks_on_time_fraction, static_cast<double>(costs_.ticks_on_time) /
                                           (ticks + static_cast<double>(costs_.ticks_left_out))},
      {"ticks_left_out", costs_.ticks_left_out},
      {"output_rate_divisor_max", overload_ ? overload_->divisor_reached() : 1},
      {"output_rate_changes", overload_ ? overload_->changes() : 0},
      {"game_pace", costs_.span_s > 0.0 ? costs_.game_span_s / costs_.span_s : 0.0},
      {report::physics_us_per_tick, 1e6 * costs_.physics_s / ticks},
      {report::filter_us_per_tick, 1e6 * costs_.filter_s / ticks},
      {report::send_us_per_tick, 1e6 * costs_.send_s / ticks},
      {"send_us_max", 1e6 * costs_.send_max_s},
      {"spread", options_.spread},
      {"burst_bytes_max", stagger_.burst_bytes_max()},
      {report::server_rss_bytes, resident_bytes()},
      {report::evidence_bytes, serving_.evidence_bytes()},
      {"ticks_cut_short", budget.ticks_cut_short},
      {"behind_s", budget.wanted_s - budget.played_s},
      {report::measured_s, costs_.span_s},
      {report::valid, why_invalid.empty()},
      {report::why_invalid, why_invalid}};
  report.update(counted_report(serving_, costs_.begin, costs_.end));
  return report;
}

}  // namespace rink::game
