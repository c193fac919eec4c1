// One loop for all bots: what arrives is applied at once, what is due is pressed at once.
#include "loadgen/run/bots/bot_crowd.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <utility>

namespace rink::loadgen {
namespace {

constexpr double longest_wait_s = 0.02;  ///< so that interrupts and the end are noticed
constexpr double follow_period_s = 1.0 / 30.0;

CrowdTraffic operator-(CrowdTraffic a, const CrowdTraffic& b) {
  a.bytes_sent -= b.bytes_sent;
  a.bytes_received -= b.bytes_received;
  a.segments_sent -= b.segments_sent;
  a.acknowledgements_sent -= b.acknowledgements_sent;
  a.kernel_segments_sent -= b.kernel_segments_sent;
  a.kernel_bytes_sent -= b.kernel_bytes_sent;
  a.kernel_bytes_received -= b.kernel_bytes_received;
  a.updates_received -= b.updates_received;
  return a;
}

}  // namespace

BotCrowd::BotCrowd(const rti::Fom& fom, rti::Transport& transport, const BotCrowdSettings& settings,
                   std::uint32_t count, const std::vector<game::InputEvent>& plan, Clock now_s)
    : model_(fom), transport_(transport), settings_(settings), now_s_(std::move(now_s)) {
  measurements_.from_s = settings.warm_up_s;
  measurements_.until_s = settings.duration_s;
  for (std::uint32_t bot = 0; bot < count; ++bot) {
    const game::ClientSettings client{.federation = settings.federation,
                                      .name = settings.first + bot < settings.names.size()
                                                  ? settings.names[settings.first + bot]
                                                  : "bat-" + std::to_string(settings.first + bot),
                                      .view_fraction = settings.view_fraction,
                                      .view_area = settings.view_area,
                                      .view_margin = settings.view_margin,
                                      .declares_regions = settings.declares_regions,
                                      .extrapolates = settings.extrapolates};
    bots_.push_back(std::make_unique<Bot>(fom, model_, client, measurements_));
    Bot* const bot_there = bots_.back().get();
    bot_there->client.on_news = [this, bot_there](const rti::Stamp& stamp) {
      note_news(*bot_there, stamp);
    };
    if (!settings_.players.do_decide()) continue;
    bots_.back()->player.emplace(settings_.players, settings.first + bot);
    decision_order_.push_back(bot);
  }
  const auto phase = [this](std::uint32_t bot) {
    return game::decision_phase(settings_.first + bot);
  };
  std::stable_sort(decision_order_.begin(), decision_order_.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return phase(a) < phase(b); });
  if (settings_.players.do_decide()) return;
  for (const game::InputEvent& event : plan) {
    const bool is_key =
        event.kind == game::InputKind::key_down || event.kind == game::InputKind::key_up;
    if (!is_key || event.player < settings.first || event.player - settings.first >= count ||
        event.time >= settings.duration_s)
      continue;
    if (settings.start_s > 0.0 && event.time <= settings.start_s) continue;
    plan_.push_back({event.time,
                     event.player - settings.first,
                     {event.key, event.kind == game::InputKind::key_down}});
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

void BotCrowd::on_open(rti::ConnectionId connection) {
  send(*bots_[bot_of_connection_[connection]]);
}

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

void BotCrowd::on_datagram(rti::ConnectionId connection, rti::Bytes datagram) {
  Bot& bot = *bots_[bot_of_connection_[connection]];
  if (bot.is_lost) return;
  bot.client.ambassador().receive_datagram(datagram);
  after_receiving(bot);
}

/// What is read at once may hold several ticks' news, and datagrams bring those of one tick between
/// those of others: each tick counts once.
void BotCrowd::note_news(Bot& bot, const rti::Stamp& stamp) {
  if (bot.client.state() != game::Client::State::playing || stamp.tag == 0) return;
  if (std::ranges::find(bot.seen_tags, stamp.tag) != bot.seen_tags.end()) return;
  bot.seen_tags[bot.next_seen++ % bot.seen_tags.size()] = stamp.tag;
  const double due = 1e-9 * static_cast<double>(stamp.tag);
  if (!origin_s_) start_clock(due - stamp.time, stamp.time);
  bot.probe.news_applied(due, now_s_(), measurements_.is_counted(stamp.time));
}

void BotCrowd::after_receiving(Bot& bot) {
  const game::MirroredEntity* const bat = bot.client.bat();
  if (bat != nullptr && bot.client.state() == game::Client::State::playing)
    bot.probe.keys_felt(now_s_(), bat->input.count);
  const std::uint32_t number = bot_of_connection_[bot.connection];
  if (witness_ && witness_->watches(number))
    witness_->listen(number, origin_s_ ? std::optional(simulated_now()) : std::nullopt);
  sample_when_due();
  take_turn(bot);
  act_when_due();  // between two bots' batches too: with many bots a tick's batches take longer
                   // than a key may be late
  const game::MirroredEntity* own = bot.client.bat();
  if (own != nullptr && !is_synchronous_ && !(own->trajectory && origin_s_))
    bot.client.follow_bat();
  const std::optional<rti::Refusal> refusal = bot.client.joining().refusal();
  if (bot.client.state() == game::Client::State::refused)
    lose(bot, bot.client.joining().trouble(),
         refusal ? game::exit_status(*refusal) : game::ExitStatus::not_admitted);
  if (bot.client.state() == game::Client::State::lost)
    lose(bot, bot.client.joining().trouble(), game::ExitStatus::connection_lost);
  send(bot);
}

void BotCrowd::on_close(rti::ConnectionId connection, rti::CloseReason reason,
                        const std::string& detail) {
  const game::ExitStatus status = reason == rti::CloseReason::refused
                                      ? game::ExitStatus::no_server
                                      : game::ExitStatus::connection_lost;
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
  rti::send_waiting(bot.client.ambassador(), transport_, bot.connection);
}

void BotCrowd::run_once() {
  double wait_s = longest_wait_s;
  const bool has_schedule = origin_s_ && !is_synchronous_;
  if (has_schedule && next_key_ < plan_.size())
    wait_s = std::clamp(due_s(plan_[next_key_].time) - now_s_(), 0.0, longest_wait_s);
  if (has_schedule && !decision_order_.empty())
    wait_s = std::clamp(due_s(next_decision()) - now_s_(), 0.0, longest_wait_s);
  if (has_schedule && witness_)
    wait_s = std::clamp(due_s(witness_->next_sample_s()) - now_s_(), 0.0, wait_s);
  transport_.poll(std::chrono::nanoseconds(static_cast<std::int64_t>(wait_s * 1e9)), *this);
  advance_clocks();
  act_when_due();
  sample_when_due();
  if (!origin_s_) return;
  follow_bats();
  measure_span();
}

/// A bat on a trajectory moves without being heard of, so the interest follows it by the clock; one
/// that is told positions is followed when they come.
void BotCrowd::follow_bats() {
  const double now = now_s_();
  if (is_synchronous_ || now < bats_followed_s_ + follow_period_s) return;
  bats_followed_s_ = now;
  for (const std::unique_ptr<Bot>& bot : bots_) {
    const game::MirroredEntity* bat = bot->client.bat();
    if (bot->is_lost || bat == nullptr || !bat->trajectory) continue;
    bot->client.follow_bat(now - *origin_s_);
    send(*bot);
  }
}

std::optional<double> BotCrowd::next_due_s() const {
  if (!origin_s_) return std::nullopt;
  std::optional<double> next_s;
  const auto consider = [&](double simulated_s) {
    next_s = std::min(next_s.value_or(due_s(simulated_s)), due_s(simulated_s));
  };
  if (next_key_ < plan_.size()) consider(plan_[next_key_].time);
  if (!decision_order_.empty() && next_decision() < settings_.duration_s) consider(next_decision());
  if (witness_ && std::isfinite(witness_->next_sample_s())) consider(witness_->next_sample_s());
  if (!span_begin_s_) consider(settings_.warm_up_s);
  if (!is_measured_) consider(settings_.duration_s);
  return std::min(next_s.value_or(bats_followed_s_ + follow_period_s),
                  bats_followed_s_ + follow_period_s);
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

/// Who joins a game that runs already decides from now on, not from its beginning.
void BotCrowd::start_clock(double origin_s, double simulated_s) {
  origin_s_ = origin_s;
  next_turn_ =
      static_cast<std::uint64_t>(simulated_s / game::decision_period) * decision_order_.size();
}

/// The server waits for this bot: it presses what its plan or its wits say by the newest tick,
/// looks about, and hands the turn back.
void BotCrowd::take_turn(Bot& bot) {
  game::Client& client = bot.client;
  if (bot.is_lost || !client.turns().has_turn() || client.state() != game::Client::State::playing)
    return;
  const double instant = client.turns().turn_s();
  is_synchronous_ = true;
  turn_s_ = std::max(turn_s_, instant);
  if (!origin_s_) start_clock(now_s_(), instant);
  const std::uint32_t number = bot_of_connection_[bot.connection];
  for (; bot.next_key < plan_.size() && plan_[bot.next_key].time <= instant; ++bot.next_key)
    if (const DueKey& key = plan_[bot.next_key]; key.bot == number)
      press(bot, {&key.change, 1}, instant);
  if (bot.player && bot.next_decision_s <= instant) {
    decide(bot, instant);
    bot.next_decision_s = instant + game::decision_period;
  }
  client.follow_bat(instant);
  client.end_turn();
  send(bot);
}

/// Simulated time of a crowd that has started.
double BotCrowd::simulated_now() const { return is_synchronous_ ? turn_s_ : now_s_() - *origin_s_; }
bool BotCrowd::has_come(double simulated_s) const {
  return is_synchronous_ ? turn_s_ >= simulated_s : now_s_() >= due_s(simulated_s);
}

void BotCrowd::act_when_due() {
  if (!origin_s_ || is_synchronous_) return;
  press_due_keys();
  decide_when_due();
}

void BotCrowd::press_due_keys() {
  for (; next_key_ < plan_.size() && due_s(plan_[next_key_].time) <= now_s_(); ++next_key_) {
    const DueKey& key = plan_[next_key_];
    press(*bots_[key.bot], {&key.change, 1}, key.time);
  }
}

/// All changes of one instant go out in one write.
void BotCrowd::press(Bot& bot, std::span<const KeyChange> changes, double instant) {
  const bool is_counted = measurements_.is_counted(instant);
  measurements_.keys_due += is_counted ? changes.size() : 0u;
  if (bot.is_lost || bot.client.state() != game::Client::State::playing) return;
  for (const KeyChange& change : changes)
    change.is_down ? bot.client.press(change.key) : bot.client.release(change.key);
  send(bot);
  for (std::size_t sent = 0; sent < changes.size(); ++sent)
    bot.probe.key_sent(is_synchronous_ ? now_s_() : due_s(instant), now_s_(), is_counted);
}

/// The simulated instant of the next decision of all [s]. Decisions have a schedule of their own,
/// as planned keys have: a bot that is late is late for it.
double BotCrowd::next_decision() const {
  const std::uint64_t count = decision_order_.size();
  return static_cast<double>(next_turn_ / count) * game::decision_period +
         game::decision_phase(settings_.first + decision_order_[next_turn_ % count]);
}

void BotCrowd::decide_when_due() {
  constexpr int most = 64;  // at once: who cannot keep the schedule must go on receiving, or it
                            // would lose its connections besides
  if (decision_order_.empty()) return;
  for (int made = 0;
       made < most && due_s(next_decision()) <= now_s_() && next_decision() < settings_.duration_s;
       ++made, ++next_turn_)
    decide(*bots_[decision_order_[next_turn_ % decision_order_.size()]], next_decision());
}

void BotCrowd::decide(Bot& bot, double instant) {
  if (bot.is_lost || bot.client.state() != game::Client::State::playing) return;
  const game::KeysHeld wanted = bot.player->decide(bot.client, instant);
  const game::KeysHeld held = std::exchange(bot.held, wanted);
  std::array<KeyChange, game::all_keys.size()> changes;
  std::size_t count = 0;
  for (const game::Key key : game::all_keys)
    if (wanted.is_down(key) != held.is_down(key)) changes[count++] = {key, wanted.is_down(key)};
  if (count > 0) press(bot, std::span(changes).first(count), instant);
}

void BotCrowd::measure_span() {
  if (!span_begin_s_ && has_come(settings_.warm_up_s)) {
    span_begin_s_ = now_s_();
    at_begin_ = total_traffic();
    received_by_bot_ = received_by_bot();
  }
  if (span_begin_s_ && !is_measured_ && has_come(settings_.duration_s)) {
    is_measured_ = true;
    measured_s_ = now_s_() - *span_begin_s_;
    measured_ = total_traffic() - at_begin_;
    const std::vector<std::uint64_t> now_received = received_by_bot();
    for (std::size_t i = 0; i < now_received.size(); ++i)
      received_by_bot_[i] = now_received[i] - received_by_bot_[i];
  }
}

void BotCrowd::collect_evidence(std::uint64_t seed) {
  std::vector<game::Client*> clients;
  for (const std::unique_ptr<Bot>& bot : bots_) clients.push_back(&bot->client);
  witness_.emplace(game::SamplingSettings{.seed = seed,
                                          .clients = bot_count(),
                                          .from_s = settings_.warm_up_s,
                                          .until_s = settings_.duration_s},
                   clients);
}

std::optional<BotsEvidence> BotCrowd::evidence() const {
  if (!witness_) return std::nullopt;
  return witness_->evidence();
}

void BotCrowd::sample_when_due() {
  if (!witness_ || !origin_s_) return;
  if (const double simulated_s = simulated_now(); simulated_s >= witness_->next_sample_s())
    witness_->sample(simulated_s);
}

std::vector<std::uint64_t> BotCrowd::received_by_bot() const {
  std::vector<std::uint64_t> bytes;
  for (const std::unique_ptr<Bot>& bot : bots_)
    bytes.push_back(rti::with_datagrams(transport_.counters(bot->connection)).bytes_received);
  return bytes;
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

std::size_t BotCrowd::client_memory_bytes() const {
  std::size_t sum = 0;
  for (const std::unique_ptr<Bot>& bot : bots_) sum += bot->client.memory_bytes();
  return sum;
}

CrowdTraffic BotCrowd::total_traffic() const {
  CrowdTraffic sum;
  for (const std::unique_ptr<Bot>& bot : bots_) {
    const rti::TransportCounters counters =
        rti::with_datagrams(transport_.counters(bot->connection));
    sum.bytes_sent += counters.bytes_sent;
    sum.bytes_received += counters.bytes_received;
    sum.segments_sent += counters.segments_sent;
    sum.acknowledgements_sent += counters.acknowledgements_sent;
    sum.kernel_segments_sent += counters.kernel_segments_sent.value_or(counters.segments_sent);
    sum.kernel_bytes_sent += counters.kernel_bytes_sent.value_or(counters.bytes_sent);
    sum.kernel_bytes_received += counters.kernel_bytes_received.value_or(counters.bytes_received);
    sum.updates_received += bot->client.mirror().counters().updates;
  }
  return sum;
}

}  // namespace rink::loadgen
