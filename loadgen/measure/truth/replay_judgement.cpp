// Passes once over the replayed game, stopping wherever a figure needs the state.
#include "loadgen/measure/truth/replay_judgement.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <string>
#include <utility>

namespace rink::loadgen {
namespace {

/// Entries are found between looks this far apart [s], or an eighth of a tick if that is less.
constexpr double look_s_max = 4e-3;

std::optional<double> ratio(double part, double whole) {
  if (!(whole > 0.0)) return std::nullopt;
  return part / whole;
}

}  // namespace

ReplayJudgement::ReplayJudgement(const game::ServerTrace& server, const game::BotsTrace& bots,
                                 const RelevanceArea& area, Entries entries)
    : server_(server), bots_(bots), area_(area), entries_(entries), replay_(server, area) {
  for (const game::BotsTrace::Bot& bot : bots.bots) add_player(bot);
  plan_looks();
}

TruthFigures ReplayJudgement::figures() {
  double looked_s = -1.0;
  for (const Look& look : looks_) {
    replay_.advance(look.instant_s);
    judge_contacts();
    if (look.instant_s != looked_s) look_around(look.instant_s);
    looked_s = look.instant_s;
    judge(look);
  }
  replay_.advance(server_.end_s);
  judge_contacts();
  if (replay_.hash() != server_.state_hash)
    throw DifferentGame(
        "the game played again from the server's evidence does not end in the server's state");
  return sums();
}

void ReplayJudgement::look_around(double instant_s) {
  replay_.look_around();
  if (trace_) trace_->look(instant_s, replay_);
}

void ReplayJudgement::add_player(const game::BotsTrace::Bot& bot) {
  std::vector<ScopeStep> steps;
  for (const game::BotsTrace::ScopeChange& change : bot.changes)
    if (const auto entity = replay_.entity_of_object(change.object))
      steps.push_back({change.instant_s, *entity, change.is_in});
  std::stable_sort(steps.begin(), steps.end(), [](const ScopeStep& a, const ScopeStep& b) {
    return a.instant_s < b.instant_s;
  });
  players_.emplace_back(std::move(steps)).bat = replay_.entity_of_object(bot.object);
}

void ReplayJudgement::plan_looks() {
  const double look_s = std::min(look_s_max, 0.125 / server_.rate_hz);
  const double until_s = std::min(server_.until_s, server_.end_s);
  for (std::size_t i = 0;
       entries_ == Entries::found && server_.from_s + static_cast<double>(i) * look_s <= until_s;
       ++i)
    looks_.push_back({server_.from_s + static_cast<double>(i) * look_s, Look::Kind::step, i});
  for (std::size_t i = 0; replay_.looks_back() && static_cast<double>(i) * look_s < server_.from_s;
       ++i)
    looks_.push_back({static_cast<double>(i) * look_s, Look::Kind::before, i});
  for (std::size_t i = 0; i < server_.decisions.size(); ++i)
    looks_.push_back({server_.decisions[i].instant_s, Look::Kind::decision, i});
  for (std::size_t i = 0; i < bots_.samples.size(); ++i) {
    looks_.push_back({bots_.samples[i].displayed_s, Look::Kind::displayed, i});
    looks_.push_back({bots_.samples[i].matched_s, Look::Kind::matched, i});
  }
  std::erase_if(looks_, [&](const Look& look) {
    return !(look.instant_s >= replay_.begin_s() && look.instant_s <= server_.end_s);
  });
  std::stable_sort(looks_.begin(), looks_.end(),
                   [](const Look& a, const Look& b) { return a.instant_s < b.instant_s; });
}

void ReplayJudgement::judge(const Look& look) {
  switch (look.kind) {
    case Look::Kind::before:
      return;
    case Look::Kind::step:
      return judge_entries(look.instant_s);
    case Look::Kind::decision:
      return judge_decision(server_.decisions[look.index]);
    case Look::Kind::displayed:
      return judge_displayed(bots_.samples[look.index]);
    case Look::Kind::matched:
      return judge_matched(bots_.samples[look.index]);
  }
}

void ReplayJudgement::judge_entries(double instant_s) {
  for (Player& player : players_) {
    if (!is_present(player)) continue;
    replay_.find(*player.bat, relevant_);
    player.delivered.advance(instant_s);
    player.intervals.look(instant_s, relevant_, player.delivered,
                          [&](const Relevant& now) { return replay_.passed(*player.bat, now); });
  }
  replay_.remember();
}

void ReplayJudgement::judge_decision(const game::ServerTrace::Decision& decision) {
  if (decision.player >= replay_.player_count())
    throw game::TraceError("the server's evidence has a decision for player " +
                           std::to_string(decision.player) + ", which its scene lacks");
  const auto bat = replay_.bat_of(decision.player);
  if (!bat) return;
  chosen_.clear();
  for (const std::uint32_t object : server_.scope_of(decision)) {
    const auto entity = replay_.entity_of_object(object);
    if (entity && *entity != *bat) chosen_.push_back(*entity);
  }
  std::sort(chosen_.begin(), chosen_.end());
  replay_.find(*bat, relevant_);
  filter_.add(chosen_, relevant_);
}

bool ReplayJudgement::is_relevant(std::uint32_t entity) const {
  const auto found =
      std::lower_bound(relevant_.begin(), relevant_.end(), entity,
                       [](const Relevant& a, std::uint32_t b) { return a.entity < b; });
  return found != relevant_.end() && found->entity == entity;
}

/// True if `entity` was put back at a face-off of which the replica set of `sample` had no update:
/// its newest stamp is from before, or neither an update of the entity nor its state on entry came
/// within a window that reaches back before the face-off.
bool ReplayJudgement::is_replaced_unheard(const game::BotsTrace::Sample& sample,
                                          const game::BotsTrace::Replica& replica,
                                          std::uint32_t entity) const {
  constexpr double rounding_s = 1e-6;
  const std::optional<double> replaced_s = replay_.replaced_s(entity);
  if (!replaced_s) return false;
  if (sample.matched_s < *replaced_s - rounding_s) return true;
  if (replica.bytes > 0 || *replaced_s <= sample.displayed_s - sample.window_s) return false;
  return std::ranges::none_of(players_[sample.bot].steps, [&](const ScopeStep& step) {
    return step.is_in && step.entity == entity && step.instant_s >= *replaced_s &&
           step.instant_s <= sample.displayed_s;
  });
}

void ReplayJudgement::add_error(PositionErrors& errors, const game::BotsTrace::Sample& sample,
                                const game::BotsTrace::Replica& replica, std::uint32_t entity,
                                const Vector2& believed) {
  const double distance = (believed - replay_.centre(entity)).norm();
  if (is_replaced_unheard(sample, replica, entity)) errors.add_replaced(distance);
  else errors.add(distance);
}

void ReplayJudgement::judge_displayed(const game::BotsTrace::Sample& sample) {
  assert(sample.bot < players_.size() && sample.last <= bots_.replicas.size());
  Player& player = players_[sample.bot];
  if (!is_present(player)) return;
  replay_.find(*player.bat, relevant_);
  player.delivered.advance(sample.displayed_s);
  player.delivered.list(*player.bat, chosen_);
  delivered_.add(chosen_, relevant_);
  for (std::size_t i = sample.first; i < sample.last; ++i) {
    const game::BotsTrace::Replica& replica = bots_.replicas[i];
    const auto entity = replay_.entity_of_object(replica.object);
    if (!entity || *entity == *player.bat) continue;
    bytes_ += replica.bytes;
    if (!is_relevant(*entity)) wasted_bytes_ += replica.bytes;
    else if (replica.is_in_scope)
      add_error(displayed_error_, sample, replica, *entity, replica.displayed);
  }
}

void ReplayJudgement::judge_matched(const game::BotsTrace::Sample& sample) {
  assert(sample.bot < players_.size() && sample.last <= bots_.replicas.size());
  const Player& player = players_[sample.bot];
  if (!is_present(player)) return;
  replay_.find(*player.bat, relevant_);
  for (std::size_t i = sample.first; i < sample.last; ++i) {
    const game::BotsTrace::Replica& replica = bots_.replicas[i];
    const auto entity = replay_.entity_of_object(replica.object);
    if (!replica.is_in_scope || !entity || *entity == *player.bat || !is_relevant(*entity))
      continue;
    add_error(matched_error_, sample, replica, *entity, replica.matched);
  }
}

/// A contact counts for each of its bodies that is a watched player's bat.
void ReplayJudgement::judge_contacts() {
  for (const physics::Event& impact : replay_.events()) {
    if (!physics::is_impact(impact.kind) || impact.time <= contacts_until_s_ ||
        impact.time < server_.from_s || impact.time >= server_.until_s || !impact.other)
      continue;
    if (trace_) trace_->contact(impact.time, impact.body.index, impact.other->index);
    for (Player& player : players_) {
      if (player.bat == impact.body.index) judge_contact(player, impact.other->index, impact.time);
      if (player.bat == impact.other->index) judge_contact(player, impact.body.index, impact.time);
    }
  }
  if (!replay_.events().empty())
    contacts_until_s_ = std::max(contacts_until_s_, replay_.events().back().time);
}

void ReplayJudgement::judge_contact(Player& player, std::uint32_t entity, double instant_s) {
  player.at_contacts.advance(instant_s);
  ++contacts_;
  if (player.at_contacts.contains(entity)) return;
  ++missed_contacts_;
  assert(missed_.samples() + 1 == missed_contacts_);
  const auto is_discovery = [&](const ScopeStep& step) {
    return step.is_in && step.entity == entity && step.instant_s > instant_s;
  };
  const auto discovered = std::ranges::find_if(player.steps, is_discovery);
  if (discovered == player.steps.end()) missed_.add_never();
  else missed_.add(discovered->instant_s - instant_s);
}

Percentiles ReplayJudgement::late_entries() {
  std::vector<double> late_s;
  for (Player& player : players_) {
    player.intervals.end();
    late_s.insert(late_s.end(), player.intervals.lateness_s().begin(),
                  player.intervals.lateness_s().end());
  }
  return percentiles_ms(std::move(late_s));
}

Discoveries ReplayJudgement::discoveries() const {
  Discoveries result;
  if (!bots_.is_complete) return result;
  for (const Player& player : players_) {
    for (const double delay_s : player.intervals.delivered_after_s())
      result.late_discovery.add(delay_s);
    for (std::uint64_t i = 0; i < player.intervals.never_delivered(); ++i)
      result.late_discovery.add_never();
  }
  result.missed_contact = missed_;
  for (const double distance_m : displayed_error_.distances())
    result.displayed_error.add(distance_m);
  return result;
}

TruthFigures ReplayJudgement::sums() {
  TruthFigures figures;
  figures.relevance = text_of(area_);
  figures.filter_precision = filter_.precision();
  figures.filter_recall = filter_.recall();
  if (!bots_.is_complete || players_.empty()) return figures;
  ScopeChanges changes;
  for (const Player& player : players_) {
    if (!player.bat) continue;
    const ScopeChanges own =
        count_changes(player.steps, *player.bat, server_.from_s, server_.until_s);
    changes.entries += own.entries, changes.exits += own.exits, changes.flaps += own.flaps;
  }
  figures.delivered_precision = delivered_.precision();
  figures.delivered_recall = delivered_.recall();
  assert(missed_contacts_ <= contacts_ && wasted_bytes_ <= bytes_);
  figures.interactions = contacts_;
  figures.missed_interactions = missed_contacts_;
  figures.late_entry_ms = late_entries();
  figures.position_error_mm = matched_error_.figures();
  figures.displayed_error_mm = displayed_error_.figures();
  figures.churn_per_client_per_s =
      ratio(static_cast<double>(changes.entries + changes.exits),
            static_cast<double>(players_.size()) * (server_.until_s - server_.from_s));
  figures.flapping_fraction =
      ratio(static_cast<double>(changes.flaps), static_cast<double>(changes.entries));
  figures.wasted_bytes_fraction =
      ratio(static_cast<double>(wasted_bytes_), static_cast<double>(bytes_));
  return figures;
}

}  // namespace rink::loadgen
