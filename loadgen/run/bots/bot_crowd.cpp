// One loop for all bots: arriving updates are applied and due keys are pressed at once.
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

}  // namespace

BotCrowd::BotCrowd(const rti::Fom& fom, rti::Transport& transport, const BotCrowdSettings& settings,
                   const std::vector<game::InputEvent>& plan, Clock now_s)
    : model_(fom),
      transport_(transport),
      settings_(settings),
      now_s_(std::move(now_s)),
      meter_(settings.warm_up_s, settings.duration_s),
      crowd_(transport, settings.totals) {
  for (std::uint32_t number = 0; number < settings.count; ++number) {
    Bot& bot = crowd_.add(
        std::make_unique<Bot>(fom, model_, client_settings(number), meter_.measurements()));
    bot.client.on_news = [this, &bot](const rti::Stamp& stamp) { note_news(bot, stamp); };
    if (settings_.players.do_decide())
      bot.player.emplace(settings_.players, settings.first + number);
  }
  if (settings_.players.do_decide()) decisions_ = {settings.first, settings.count};
  else
    keys_ = {plan,
             {.first = settings.first,
              .count = settings.count,
              .begun_s = settings.start_s,
              .until_s = settings.duration_s}};
}

game::ClientSettings BotCrowd::client_settings(std::uint32_t bot) const {
  const std::uint32_t player = settings_.first + bot;
  return {.federation = settings_.federation,
          .name = player < settings_.names.size() ? settings_.names[player]
                                                  : "bat-" + std::to_string(player),
          .view_fraction = settings_.view_fraction,
          .view_area = settings_.view_area,
          .view_margin = settings_.view_margin,
          .declares_regions = settings_.declares_regions,
          .extrapolates = settings_.extrapolates};
}

void BotCrowd::on_open(rti::ConnectionId connection) {
  Bot& bot = crowd_.of(connection);
  bot.is_connected = true;
  crowd_.send(bot);
}

void BotCrowd::on_bytes(rti::ConnectionId connection, rti::Bytes bytes) {
  Bot& bot = crowd_.of(connection);
  if (bot.is_lost) return;
  if (!bot.client.ambassador().receive(bytes)) {
    crowd_.lose(bot, "the server sent bytes that are no message",
                game::ExitStatus::connection_lost);
    transport_.close(connection);
    return;
  }
  after_receiving(bot);
}

void BotCrowd::on_datagram(rti::ConnectionId connection, rti::Bytes datagram) {
  Bot& bot = crowd_.of(connection);
  if (bot.is_lost) return;
  bot.client.ambassador().receive_datagram(datagram);
  after_receiving(bot);
}

void BotCrowd::on_close(rti::ConnectionId connection, rti::CloseReason reason,
                        const std::string& detail) {
  const game::ExitStatus status = reason == rti::CloseReason::refused
                                      ? game::ExitStatus::no_server
                                      : game::ExitStatus::connection_lost;
  crowd_.lose(crowd_.of(connection), detail.empty() ? to_string(reason) : detail, status);
}

/// One read may bring the updates of several ticks, and datagrams bring those of one tick between
/// those of others: each tick counts once.
void BotCrowd::note_news(Bot& bot, const rti::Stamp& stamp) {
  if (bot.client.state() != game::Client::State::playing || stamp.tag == 0) return;
  if (std::ranges::find(bot.seen_tags, stamp.tag) != bot.seen_tags.end()) return;
  bot.seen_tags[bot.next_seen++ % bot.seen_tags.size()] = stamp.tag;
  const double due = 1e-9 * static_cast<double>(stamp.tag);
  if (!has_started()) start_clock(due - stamp.time, stamp.time);
  bot.probe.news_applied(due, now_s_(), meter_.measurements().is_counted(stamp.time));
}

void BotCrowd::after_receiving(Bot& bot) {
  const game::EntityReplica* const bat = bot.client.bat();
  if (bat != nullptr && bot.client.state() == game::Client::State::playing)
    bot.probe.keys_felt(now_s_(), bat->input.count);
  if (recorder_ && recorder_->watches(bot.number))
    recorder_->listen(bot.number,
                      has_started() ? std::optional(clock_.simulated_s(now_s_())) : std::nullopt);
  sample_when_due();
  take_turn(bot);
  act_when_due();  // between two bots' batches too: with many bots, handling a tick takes longer
                   // than a key may be late
  const game::EntityReplica* own = bot.client.bat();
  if (own != nullptr && !clock_.is_synchronous() && !(own->trajectory && has_started()))
    bot.client.follow_bat();
  lose_if_over(bot);
  crowd_.send(bot);
}

void BotCrowd::lose_if_over(Bot& bot) {
  const game::Joining& joining = bot.client.joining();
  const std::optional<rti::Refusal>& refusal = joining.refusal();
  if (joining.state() == game::Client::State::refused)
    crowd_.lose(bot, joining.error(),
                refusal ? game::exit_status(*refusal) : game::ExitStatus::not_admitted);
  if (joining.state() == game::Client::State::lost)
    crowd_.lose(bot, joining.error(), game::ExitStatus::connection_lost);
}

void BotCrowd::run_once() {
  double wait_s = longest_wait_s;
  const auto wait_until = [&](double simulated_s, double longest_s) {
    wait_s = std::clamp(clock_.due_s(simulated_s) - now_s_(), 0.0, longest_s);
  };
  if (clock_.runs()) {
    if (const auto next_s = keys_.next_s()) wait_until(*next_s, longest_wait_s);
    if (!decisions_.is_empty()) wait_until(decisions_.next_s(), longest_wait_s);
    if (recorder_) wait_until(recorder_->next_sample_s(), wait_s);
  }
  transport_.poll(std::chrono::nanoseconds(static_cast<std::int64_t>(wait_s * 1e9)), *this);
  advance_clocks();
  act_when_due();
  sample_when_due();
  if (!has_started()) return;
  follow_bats();
  measure_span();
}

/// A bat on a trajectory moves between updates, so the interest follows it by the clock; a bat
/// updated by positions is followed when they come.
void BotCrowd::follow_bats() {
  const double now = now_s_();
  if (clock_.is_synchronous() || now < bats_followed_s_ + follow_period_s) return;
  bats_followed_s_ = now;
  crowd_.for_each_present([&](Bot& bot) {
    const game::EntityReplica* bat = bot.client.bat();
    if (bat == nullptr || !bat->trajectory) return;
    bot.client.follow_bat(clock_.simulated_s(now));
    crowd_.send(bot);
  });
}

std::optional<double> BotCrowd::next_due_s() const {
  if (!has_started()) return std::nullopt;
  double next_s = bats_followed_s_ + follow_period_s;
  const auto consider = [&](double simulated_s) {
    next_s = std::min(next_s, clock_.due_s(simulated_s));
  };
  if (const auto key_s = keys_.next_s()) consider(*key_s);
  if (!decisions_.is_empty() && decisions_.next_s() < settings_.duration_s)
    consider(decisions_.next_s());
  if (recorder_ && std::isfinite(recorder_->next_sample_s())) consider(recorder_->next_sample_s());
  if (!meter_.has_begun()) consider(settings_.warm_up_s);
  if (!meter_.has_ended()) consider(settings_.duration_s);
  return next_s;
}

/// Advances clocks four times a second, which suffices for heartbeats and costs little.
void BotCrowd::advance_clocks() {
  const double now = now_s_();
  if (now - clocks_advanced_s_ < 0.25) return;
  clocks_advanced_s_ = now;
  crowd_.for_each_present([&](Bot& bot) {
    if (!bot.is_connected) return;  // the transport reports a connection that fails
    bot.client.ambassador().advance_clock(now, transport_.is_behind());
    crowd_.send(bot);
  });
}

void BotCrowd::start_clock(double origin_s, double simulated_s) {
  clock_.start(origin_s);
  decisions_.begin(simulated_s);
}

/// The server waits for this bot: it presses the keys that are due by the newest tick, by plan or
/// decision, updates its interest, and ends its turn.
void BotCrowd::take_turn(Bot& bot) {
  game::Client& client = bot.client;
  if (!bot.is_playing() || !client.turns().has_turn()) return;
  const double instant = client.turns().turn_s();
  clock_.take_turn(instant);
  if (!has_started()) start_clock(now_s_(), instant);
  while (const DueKey* key = keys_.take_due(bot.number, instant))
    press(bot, {&key->change, 1}, instant);
  if (decisions_.take_due(bot.number, instant)) decide(bot, instant);
  client.follow_bat(instant);
  client.end_turn();
  crowd_.send(bot);
}

void BotCrowd::act_when_due() {
  if (!clock_.runs()) return;
  press_due_keys();
  decide_when_due();
}

void BotCrowd::press_due_keys() {
  for (auto next_s = keys_.next_s(); next_s && clock_.due_s(*next_s) <= now_s_();
       next_s = keys_.next_s()) {
    const DueKey& key = keys_.take();
    press(crowd_[key.bot], {&key.change, 1}, key.time);
  }
}

/// Sends all changes of one instant in one write.
void BotCrowd::press(Bot& bot, std::span<const KeyChange> changes, double instant) {
  const bool is_counted = meter_.measurements().is_counted(instant);
  meter_.measurements().keys_due += is_counted ? changes.size() : 0u;
  if (!bot.is_playing()) return;
  for (const KeyChange& change : changes)
    change.is_down ? bot.client.press(change.key) : bot.client.release(change.key);
  crowd_.send(bot);
  for (std::size_t sent = 0; sent < changes.size(); ++sent)
    bot.probe.key_sent(clock_.is_synchronous() ? now_s_() : clock_.due_s(instant), now_s_(),
                       is_counted);
}

void BotCrowd::decide_when_due() {
  constexpr int most = 64;  // at once: bots behind their schedule must go on receiving, or they
                            // would lose their connections too
  if (decisions_.is_empty()) return;
  for (int made = 0; made < most; ++made) {
    const double instant = decisions_.next_s();
    if (clock_.due_s(instant) > now_s_() || instant >= settings_.duration_s) return;
    decide(crowd_[decisions_.take()], instant);
  }
}

void BotCrowd::decide(Bot& bot, double instant) {
  if (!bot.is_playing()) return;
  const game::KeysHeld wanted = bot.player->decide(bot.client, instant);
  const game::KeysHeld held = std::exchange(bot.held, wanted);
  std::array<KeyChange, game::all_keys.size()> changes;
  std::size_t count = 0;
  for (const game::Key key : game::all_keys)
    if (wanted.is_down(key) != held.is_down(key)) changes[count++] = {key, wanted.is_down(key)};
  if (count > 0) press(bot, std::span(changes).first(count), instant);
}

void BotCrowd::measure_span() {
  if (!meter_.has_begun() && clock_.has_come(settings_.warm_up_s, now_s_()))
    meter_.begin(now_s_(), crowd_.carried());
  if (meter_.is_measuring() && clock_.has_come(settings_.duration_s, now_s_()))
    meter_.end(now_s_(), crowd_.carried());
}

void BotCrowd::collect_trace(std::uint64_t seed) {
  std::vector<game::Client*> clients;
  crowd_.for_each_present([&](Bot& bot) { clients.push_back(&bot.client); });
  recorder_.emplace(game::SamplingSettings{.seed = seed,
                                           .clients = crowd_.size(),
                                           .from_s = settings_.warm_up_s,
                                           .until_s = settings_.duration_s},
                    clients);
}

std::optional<game::BotsTrace> BotCrowd::trace() const {
  if (!recorder_) return std::nullopt;
  return recorder_->trace();
}

void BotCrowd::sample_when_due() {
  if (!recorder_ || !has_started()) return;
  if (const double simulated_s = clock_.simulated_s(now_s_());
      simulated_s >= recorder_->next_sample_s())
    recorder_->sample(simulated_s);
}

}  // namespace rink::loadgen
