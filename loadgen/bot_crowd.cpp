// One loop for all bots: what arrives is applied at once, what is due is pressed at once.
#include "loadgen/bot_crowd.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <utility>

namespace rink::loadgen {
namespace {

constexpr double longest_wait_s = 0.02;  ///< so that interrupts and the end are noticed

CrowdTraffic operator-(CrowdTraffic a, const CrowdTraffic& b) {
  a.bytes_sent -= b.bytes_sent;
  a.bytes_received -= b.bytes_received;
  a.segments_sent -= b.segments_sent;
  a.kernel_bytes_sent -= b.kernel_bytes_sent;
  a.kernel_bytes_received -= b.kernel_bytes_received;
  a.updates_received -= b.updates_received;
  return a;
}

}  // namespace

BotCrowd::BotCrowd(const rti::Fom& fom, rti::Transport& transport, const BotCrowdSettings& settings, std::uint32_t count,
                   const std::vector<game::InputEvent>& plan, Clock now_s)
    : model_(fom), transport_(transport), settings_(settings), now_s_(std::move(now_s)) {
  measurements_.from_s = settings.warm_up_s;
  measurements_.until_s = settings.duration_s;
  for (std::uint32_t bot = 0; bot < count; ++bot) {
    const game::ClientSettings client{
        .federation = settings.federation, .name = "bat-" + std::to_string(settings.first + bot), .view_fraction = settings.view_fraction};
    bots_.push_back(std::make_unique<Bot>(fom, model_, client, measurements_));
  }
  for (const game::InputEvent& event : plan) {
    const bool is_key = event.kind == game::InputKind::key_down || event.kind == game::InputKind::key_up;
    if (!is_key || event.player < settings.first || event.player - settings.first >= count || event.time >= settings.duration_s) continue;
    plan_.push_back({event.time, event.player - settings.first, event.key, event.kind == game::InputKind::key_down});
  }
}

void BotCrowd::connect(const Connect& connect) {
  for (std::uint32_t i = 0; i < bots_.size(); ++i) {
    Bot& bot = *bots_[i];
    bot.connection = connect(i);
    if (bot_of_connection_.size() <= bot.connection) bot_of_connection_.resize(bot.connection + 1);
    bot_of_connection_[bot.connection] = i;
  }
}

void BotCrowd::on_open(rti::ConnectionId connection) { send(*bots_[bot_of_connection_[connection]]); }

void BotCrowd::on_bytes(rti::ConnectionId connection, rti::Bytes bytes) {
  Bot& bot = *bots_[bot_of_connection_[connection]];
  if (bot.is_lost) return;
  if (!bot.client.ambassador().receive(bytes)) {
    lose(bot, "the server sent bytes that are no message", game::ExitStatus::connection_lost);
    transport_.close(connection);
    return;
  }
  after_receiving(bot);
}

void BotCrowd::after_receiving(Bot& bot) {
  const rti::Stamp& newest = bot.client.mirror().newest();
  if (bot.client.state() == game::Client::State::playing && newest.tag != 0 && newest.tag != bot.seen_tag) {
    bot.seen_tag = newest.tag;
    const double due = 1e-9 * static_cast<double>(newest.tag);
    if (!origin_s_) origin_s_ = due - newest.time;
    const game::MirroredEntity* bat = bot.client.bat();
    bot.probe.batch_applied(due, now_s_(), bat == nullptr ? 0 : bat->input.count, measurements_.is_counted(newest.time));
  }
  press_due_keys();  // between two bots' batches too: with many bots a tick's batches take longer than a key may be late
  bot.client.follow_bat();
  const std::optional<rti::Refusal> refusal = bot.client.refusal();
  if (bot.client.state() == game::Client::State::refused)
    lose(bot, bot.client.trouble(), refusal ? game::exit_status(*refusal) : game::ExitStatus::not_admitted);
  if (bot.client.state() == game::Client::State::lost) lose(bot, bot.client.trouble(), game::ExitStatus::connection_lost);
  send(bot);
}

void BotCrowd::on_close(rti::ConnectionId connection, rti::CloseReason reason, const std::string& detail) {
  const game::ExitStatus status = reason == rti::CloseReason::refused ? game::ExitStatus::no_server : game::ExitStatus::connection_lost;
  lose(*bots_[bot_of_connection_[connection]], detail.empty() ? to_string(reason) : detail, status);
}

void BotCrowd::lose(Bot& bot, const std::string& why, game::ExitStatus status) {
  if (bot.is_lost) return;
  bot.is_lost = true;
  ++lost_;
  if (!first_trouble_.empty()) return;
  first_trouble_ = why;
  first_status_ = status;
}

void BotCrowd::send(Bot& bot) {
  const rti::Bytes bytes = bot.client.ambassador().outgoing();
  if (bytes.empty()) return;
  transport_.send(bot.connection, std::array{bytes});
  bot.client.ambassador().clear_outgoing();
}

void BotCrowd::run_once() {
  double wait_s = longest_wait_s;
  if (origin_s_ && next_key_ < plan_.size()) wait_s = std::clamp(due_s(plan_[next_key_].time) - now_s_(), 0.0, longest_wait_s);
  transport_.poll(std::chrono::nanoseconds(static_cast<std::int64_t>(wait_s * 1e9)), *this);
  advance_clocks();
  press_due_keys();
  if (origin_s_) measure_span();
}

/// Heartbeats, four times a second: often enough for them, and nothing for the rest.
void BotCrowd::advance_clocks() {
  const double now = now_s_();
  if (now - clocks_advanced_s_ < 0.25) return;
  clocks_advanced_s_ = now;
  for (const std::unique_ptr<Bot>& bot : bots_) {
    if (bot->is_lost) continue;
    bot->client.ambassador().advance_clock(now);
    send(*bot);
  }
}

void BotCrowd::press_due_keys() {
  if (!origin_s_) return;
  for (; next_key_ < plan_.size() && due_s(plan_[next_key_].time) <= now_s_(); ++next_key_) {
    const DueKey& key = plan_[next_key_];
    const bool is_counted = measurements_.is_counted(key.time);
    measurements_.keys_due += is_counted ? 1u : 0u;
    Bot& bot = *bots_[key.bot];
    if (bot.is_lost || bot.client.state() != game::Client::State::playing) continue;
    key.is_down ? bot.client.press(key.key) : bot.client.release(key.key);
    send(bot);
    bot.probe.key_sent(due_s(key.time), now_s_(), is_counted);
  }
}

void BotCrowd::measure_span() {
  const double now = now_s_();
  if (!span_begin_s_ && now >= due_s(settings_.warm_up_s)) {
    span_begin_s_ = now;
    at_begin_ = total_traffic();
  }
  if (span_begin_s_ && !is_measured_ && now >= due_s(settings_.duration_s)) {
    is_measured_ = true;
    measured_s_ = now - *span_begin_s_;
    measured_ = total_traffic() - at_begin_;
  }
}

bool BotCrowd::is_over() const { return is_measured_ || lost_ == bots_.size(); }

void BotCrowd::resign() {
  for (const std::unique_ptr<Bot>& bot : bots_) {
    if (bot->is_lost) continue;
    bot->client.ambassador().resign();
    send(*bot);
    transport_.close(bot->connection);
  }
}

std::uint64_t BotCrowd::unanswered_keys() const {
  std::uint64_t count = 0;
  for (const std::unique_ptr<Bot>& bot : bots_) count += bot->probe.unanswered();
  return count;
}

CrowdTraffic BotCrowd::total_traffic() const {
  CrowdTraffic sum;
  for (const std::unique_ptr<Bot>& bot : bots_) {
    const rti::TransportCounters counters = transport_.counters(bot->connection);
    sum.bytes_sent += counters.bytes_sent;
    sum.bytes_received += counters.bytes_received;
    sum.segments_sent += counters.segments_sent;
    sum.kernel_bytes_sent += counters.kernel_bytes_sent.value_or(counters.bytes_sent);
    sum.kernel_bytes_received += counters.kernel_bytes_received.value_or(counters.bytes_received);
    sum.updates_received += bot->client.mirror().counters().updates;
  }
  return sum;
}

}  // namespace rink::loadgen
