// One thread for all bots; those of the library receive.
#include "loadgen/dds/dds_crowd.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include <dds/dds.h>
#include "game/model/report_fields.h"
#include "game/model/report_schema.h"
#include "loadgen/dds/dds_reports.h"

namespace rink::loadgen {

DdsCrowd::DdsCrowd(const DdsBotsOptions& options, const std::vector<game::InputEvent>& plan,
                   const DdsClock& now_s)
    : options_(options),
      now_s_(now_s),
      waiting_(require(dds_create_waitset(DDS_CYCLONEDDS_HANDLE), "a set to wait for")),
      keys_(plan, {.first = 0,
                   .count = options.count,
                   .begun_s = options.start_s,
                   .until_s = options.start_s + options.duration_s}),
      recorder_(options) {
  measured_.from_s = options.start_s + options.warm_up_s;
  measured_.until_s = options.start_s + options.duration_s;
  told_ns_.assign(options.count, -1);
  triggered_.resize(1024);
  bots_.reserve(options.count), probes_.reserve(options.count);
  DdsBot::Listener& listener = *this;
  for (std::uint32_t number = 0; number < options.count; ++number) {
    probes_.emplace_back(measured_);
    bots_.push_back(std::make_unique<DdsBot>(options_, number, waiting_, listener));
  }
}

double DdsCrowd::simulated_s() const { return origin_s_ ? begin_s_ + now_s_() - *origin_s_ : -1.0; }

double DdsCrowd::next_due_s() const {
  constexpr double look_s = 0.02;  // for interrupts, and for bats that went astray
  double due_s = now_s_() + look_s;
  if (!origin_s_) return due_s;
  const auto on_clock = [&](double simulated) { return *origin_s_ + simulated - begin_s_; };
  if (const auto key_s = keys_.next_s()) due_s = std::min(due_s, on_clock(*key_s));
  due_s = std::min(due_s, on_clock(recorder_.next_sample_s()));
  const double edge_s = measured_from_s_ ? measured_.until_s : measured_.from_s;
  return std::min(due_s, on_clock(edge_s));
}

void DdsCrowd::run_once() {
  const double wait_s = std::max(0.0, next_due_s() - now_s_());
  const auto count = require(dds_waitset_wait(waiting_, triggered_.data(), triggered_.size(),
                                              static_cast<dds_duration_t>(1e9 * wait_s)),
                             "waiting");
  const auto present = std::min(triggered_.size(), static_cast<std::size_t>(count));
  for (std::size_t k = 0; k < present; ++k) {
    DdsBot& bot = *bots_[DdsBot::bot_of(triggered_[k])];
    bot.take(DdsBot::reader_of(triggered_[k]));
  }
  for (std::size_t k = 0; k < present; ++k) {
    DdsBot& bot = *bots_[DdsBot::bot_of(triggered_[k])];
    bot.settle();
    bot.follow(now_s_());
  }
  start_when_said();
  measure_span();
  press_due_keys();
  if (origin_s_) recorder_.sample(bots_, simulated_s());
  if (const double now = now_s_(); now >= looked_s_ + 0.02) {
    looked_s_ = now;
    for (const auto& bot : bots_) bot->follow(now), bot->say_ready();
    if (is_over_ || !origin_s_) return;
    is_left_ = !bots_.front()->is_server_there();
    if (is_left_ || bots_.front()->session()->is_over) end_span();
  }
}

void DdsCrowd::end_span() {
  assert(!is_over_);
  if (measured_from_s_) span_s_ = now_s_() - *measured_from_s_, end_ = counted();
  else begin_ = end_ = counted();  // there is nothing to count yet
  is_over_ = true;
}

void DdsCrowd::start_when_said() {
  if (origin_s_) return;
  for (const auto& bot : bots_) {
    if (!bot->session() || !bot->session()->origin_s) continue;
    origin_s_ = bot->session()->origin_s;
    begin_s_ = bot->session()->begin_s;
    if (std::abs(begin_s_ - options_.start_s) > 1.0 / bot->session()->rate_hz)
      throw DdsError("the game begins at " + std::to_string(begin_s_) + " s, not at " +
                     std::to_string(options_.start_s) + " s; expected that as --start");
    return;
  }
}

DdsCrowd::Counted DdsCrowd::counted() const {
  Counted counted{.sent = sent_so_far(), .received = received_so_far(), .states = {}};
  counted.states.reserve(bots_.size());
  for (const auto& bot : bots_) counted.states.push_back(bot->states());
  return counted;
}

void DdsCrowd::measure_span() {
  if (!origin_s_ || is_over_) return;
  const double now = simulated_s();
  if (!measured_from_s_ && now >= measured_.from_s) measured_from_s_ = now_s_(), begin_ = counted();
  if (now >= measured_.until_s) end_span();
}

void DdsCrowd::press_due_keys() {
  if (!origin_s_) return;
  for (auto due_s = keys_.next_s(); due_s && *due_s <= simulated_s(); due_s = keys_.next_s()) {
    const DueKey& key = keys_.take();
    const bool is_counted = measured_.is_counted(key.time);
    bots_[key.bot]->press(key.change, key.time);
    if (is_counted) ++measured_.keys_due;
    probes_[key.bot].key_sent(*origin_s_ + key.time - begin_s_, now_s_(), is_counted);
  }
}

void DdsCrowd::state_came(const DdsBot& bot, std::uint32_t body, std::int64_t stamp_ns) {
  const double stamp_s = 1e-9 * static_cast<double>(stamp_ns);
  if (origin_s_ && stamp_ns > told_ns_[bot.number()]) {
    told_ns_[bot.number()] = stamp_ns;
    probes_[bot.number()].news_applied(*origin_s_ + stamp_s - begin_s_, now_s_(),
                                       measured_.is_counted(stamp_s));
  }
  recorder_.state_came(bot, body, simulated_s());
}

void DdsCrowd::scope_changed(const DdsBot& bot, std::uint32_t body, bool is_in) {
  recorder_.scope_changed(bot, body, is_in, simulated_s());
}

nlohmann::ordered_json DdsCrowd::report(const std::string& why_invalid) const {
  namespace report = game::report;
  assert(is_over_);
  const RtpsTraffic sent = end_.sent - begin_.sent, received = end_.received - begin_.received;
  std::vector<std::uint64_t> bytes_by_bot;
  std::uint64_t states = 0, cells_joined = 0, cells_read = 0;
  for (std::size_t k = 0; k < end_.states.size(); ++k) {
    bytes_by_bot.push_back(DdsBotsRecorder::state_bytes * (end_.states[k] - begin_.states[k]));
    states += end_.states[k] - begin_.states[k];
  }
  for (const auto& bot : bots_)
    cells_joined += bot->cells_joined(), cells_read += bot->cells_read();
  nlohmann::ordered_json written{
      {"schema", game::report_schema},
      {report::clients, bots_.size()},
      {report::measured_s, span_s_},
      {"updates_received", states},
      {"cells_joined", cells_joined},
      {"cells_read", cells_read},
      {report::update_age_ms, measured_.update_latency.to_json()},
      {report::key_to_effect_ms, nullptr},
      {report::keys_due, measured_.keys_due},
      {report::keys_sent, measured_.keys_sent},
      {report::late_sends_fraction,
       static_cast<double>(measured_.late_sends) /
           std::max<double>(1.0, static_cast<double>(measured_.keys_sent))},
      {report::send_lateness_ms, measured_.send_lateness.to_json()},
      {report::schedule_trouble, measured_.schedule_trouble()},
      {"discovery_bytes", sent.discovery_bytes + received.discovery_bytes},
      {report::bytes_received_by_bot, bytes_by_bot},
      {report::federates_lost, is_left_ ? bots_.size() : 0},
      {report::valid, why_invalid.empty()},
      {report::why_invalid, why_invalid}};
  written.update(traffic_report(sent, received, sent_so_far(), received_so_far()));
  return written;
}

}  // namespace rink::loadgen
