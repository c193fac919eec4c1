// One pass over the replayed game, stopping wherever a figure needs to know how things stood.
#include "loadgen/measure/truth/truth.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <system_error>

#include "game/net/evidence_lines.h"
#include "game/net/view.h"
#include "loadgen/measure/discovery_table.h"
#include "loadgen/measure/truth/classification.h"
#include "loadgen/measure/truth/replay.h"
#include "loadgen/measure/truth/scope_history.h"
#include "loadgen/measure/truth/stays.h"
#include "loadgen/measure/truth/trace.h"

namespace rink::loadgen {
namespace {

/// Entries are found between looks this far apart [s], or an eighth of a tick if that is less.
constexpr double look_s_max = 4e-3;

/// A watched bot, and what it had been told by the instant at hand.
struct Player {
  explicit Player(std::vector<ScopeStep> told)
      : steps(told), delivered(told), at_contacts(std::move(told)) {}
  std::optional<std::uint32_t> bat;
  std::vector<ScopeStep> steps;
  ScopeHistory delivered, at_contacts;
  Stays stays;
};

/// Something to be judged at an instant; `index` is into what its kind is about.
struct Look {
  enum class Kind : std::uint8_t { before, step, decision, displayed, matched };
  double instant_s;
  Kind kind;
  std::size_t index;
};

class ReplayJudgement {
 public:
  ReplayJudgement(const game::ServerEvidence& server, const BotsEvidence& bots,
                  const RelevanceArea& area, Entries entries = Entries::found)
      : server_(server), bots_(bots), area_(area), entries_(entries), replay_(server, area) {
    for (const BotsEvidence::Bot& bot : bots.bots) add_player(bot);
    plan_looks();
  }

  /// Keeps in it where everything was; before `figures`.
  void trace_to(TruthTrace& trace) {
    trace_ = &trace;
    trace.begin(area_, replay_);
  }

  /// After `figures`.
  Discoveries discoveries() const;

  TruthFigures figures() {
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

 private:
  void look_around(double instant_s) {
    replay_.look_around();
    if (trace_) trace_->look(instant_s, replay_);
  }

  void add_player(const BotsEvidence::Bot& bot) {
    std::vector<ScopeStep> steps;
    for (const BotsEvidence::ScopeChange& change : bot.changes)
      if (const auto entity = replay_.entity_of_object(change.object))
        steps.push_back({change.instant_s, *entity, change.is_in});
    std::stable_sort(steps.begin(), steps.end(), [](const ScopeStep& a, const ScopeStep& b) {
      return a.instant_s < b.instant_s;
    });
    players_.emplace_back(std::move(steps)).bat = replay_.entity_of_object(bot.object);
  }

  void plan_looks() {
    const double look_s = std::min(look_s_max, 0.125 / server_.rate_hz);
    const double until_s = std::min(server_.until_s, server_.end_s);
    for (std::size_t i = 0;
         entries_ == Entries::found && server_.from_s + static_cast<double>(i) * look_s <= until_s;
         ++i)
      looks_.push_back({server_.from_s + static_cast<double>(i) * look_s, Look::Kind::step, i});
    for (std::size_t i = 0;
         replay_.looks_back() && static_cast<double>(i) * look_s < server_.from_s; ++i)
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

  void judge(const Look& look) {
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

  bool is_present(const Player& player) const {
    return player.bat && replay_.is_there(*player.bat);
  }

  void judge_entries(double instant_s) {
    for (Player& player : players_) {
      if (!is_present(player)) continue;
      replay_.find(*player.bat, relevant_);
      player.delivered.advance(instant_s);
      player.stays.look(instant_s, relevant_, player.delivered,
                        [&](const Relevant& now) { return replay_.passed(*player.bat, now); });
    }
    replay_.remember();
  }

  void judge_decision(const game::ServerEvidence::Decision& decision) {
    if (decision.player >= replay_.player_count())
      throw game::EvidenceError("the server's evidence has a decision for player " +
                                std::to_string(decision.player) + ", who is not in its scene");
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

  bool is_relevant(std::uint32_t entity) const {
    const auto found =
        std::lower_bound(relevant_.begin(), relevant_.end(), entity,
                         [](const Relevant& a, std::uint32_t b) { return a.entity < b; });
    return found != relevant_.end() && found->entity == entity;
  }

  /// Whether `entity` was put back at a face-off that the mirror of `sample` had no news of: the
  /// mirror's newest stamp is from before, or nothing came about the entity within a window that
  /// reaches back before it, be it an update or the state on an entry.
  bool is_replaced_unheard(const BotsEvidence::Sample& sample, const BotsEvidence::Belief& belief,
                           std::uint32_t entity) const {
    constexpr double rounding_s = 1e-6;
    const std::optional<double> replaced_s = replay_.replaced_s(entity);
    if (!replaced_s) return false;
    if (sample.matched_s < *replaced_s - rounding_s) return true;
    if (belief.bytes > 0 || *replaced_s <= sample.displayed_s - sample.window_s) return false;
    return std::ranges::none_of(players_[sample.bot].steps, [&](const ScopeStep& step) {
      return step.is_in && step.entity == entity && step.instant_s >= *replaced_s &&
             step.instant_s <= sample.displayed_s;
    });
  }

  void add_error(PositionErrors& errors, const BotsEvidence::Sample& sample,
                 const BotsEvidence::Belief& belief, std::uint32_t entity,
                 const Vector2& believed) {
    const double distance = (believed - replay_.centre(entity)).norm();
    if (is_replaced_unheard(sample, belief, entity)) errors.add_replaced(distance);
    else errors.add(distance);
  }

  void judge_displayed(const BotsEvidence::Sample& sample) {
    Player& player = players_[sample.bot];
    if (!is_present(player)) return;
    replay_.find(*player.bat, relevant_);
    player.delivered.advance(sample.displayed_s);
    player.delivered.list(*player.bat, chosen_);
    delivered_.add(chosen_, relevant_);
    for (std::size_t i = sample.first; i < sample.last; ++i) {
      const BotsEvidence::Belief& belief = bots_.beliefs[i];
      const auto entity = replay_.entity_of_object(belief.object);
      if (!entity || *entity == *player.bat) continue;
      bytes_ += belief.bytes;
      if (!is_relevant(*entity)) wasted_bytes_ += belief.bytes;
      else if (belief.is_in_scope)
        add_error(displayed_error_, sample, belief, *entity, belief.displayed);
    }
  }

  void judge_matched(const BotsEvidence::Sample& sample) {
    const Player& player = players_[sample.bot];
    if (!is_present(player)) return;
    replay_.find(*player.bat, relevant_);
    for (std::size_t i = sample.first; i < sample.last; ++i) {
      const BotsEvidence::Belief& belief = bots_.beliefs[i];
      const auto entity = replay_.entity_of_object(belief.object);
      if (!belief.is_in_scope || !entity || *entity == *player.bat || !is_relevant(*entity))
        continue;
      add_error(matched_error_, sample, belief, *entity, belief.matched);
    }
  }

  /// A contact counts for each of its bodies that is a watched player's bat.
  void judge_contacts() {
    for (const physics::Event& impact : replay_.events()) {
      if (!physics::is_impact(impact.kind) || impact.time <= contacts_until_s_ ||
          impact.time < server_.from_s || impact.time >= server_.until_s || !impact.other)
        continue;
      if (trace_) trace_->contact(impact.time, impact.body.index, impact.other->index);
      for (Player& player : players_) {
        if (player.bat == impact.body.index)
          judge_contact(player, impact.other->index, impact.time);
        if (player.bat == impact.other->index)
          judge_contact(player, impact.body.index, impact.time);
      }
    }
    if (!replay_.events().empty())
      contacts_until_s_ = std::max(contacts_until_s_, replay_.events().back().time);
  }

  void judge_contact(Player& player, std::uint32_t entity, double instant_s) {
    player.at_contacts.advance(instant_s);
    ++contacts_;
    if (player.at_contacts.contains(entity)) return;
    ++missed_contacts_;
    const auto is_discovery = [&](const ScopeStep& step) {
      return step.is_in && step.entity == entity && step.instant_s > instant_s;
    };
    const auto discovered = std::ranges::find_if(player.steps, is_discovery);
    if (discovered == player.steps.end()) missed_.add_never();
    else missed_.add(discovered->instant_s - instant_s);
  }

  TruthFigures sums();
  Percentiles late_entries();

  const game::ServerEvidence& server_;
  const BotsEvidence& bots_;
  RelevanceArea area_;
  Entries entries_;
  Replay replay_;
  TruthTrace* trace_ = nullptr;
  std::vector<Player> players_;
  std::vector<Look> looks_;
  std::vector<Relevant> relevant_;
  std::vector<std::uint32_t> chosen_;
  Classification filter_, delivered_;
  PositionErrors displayed_error_, matched_error_;
  std::uint64_t bytes_ = 0, wasted_bytes_ = 0, contacts_ = 0, missed_contacts_ = 0;
  double contacts_until_s_ = -1.0;
  SampleDistribution missed_;
};

std::optional<double> ratio(double part, double whole) {
  if (!(whole > 0.0)) return std::nullopt;
  return part / whole;
}

Percentiles ReplayJudgement::late_entries() {
  std::vector<double> late_s;
  for (Player& player : players_) {
    player.stays.end();
    late_s.insert(late_s.end(), player.stays.lateness_s().begin(), player.stays.lateness_s().end());
  }
  return percentiles_ms(std::move(late_s));
}

Discoveries ReplayJudgement::discoveries() const {
  Discoveries result;
  if (!bots_.is_complete) return result;
  for (const Player& player : players_) {
    for (const double delay_s : player.stays.delivered_after_s())
      result.late_discovery.add(delay_s);
    for (std::uint64_t i = 0; i < player.stays.never_delivered(); ++i)
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

}  // namespace

TruthFigures truth_of(const game::ServerEvidence& server, const BotsEvidence& bots,
                      const RelevanceArea& area, Discoveries* discoveries, Entries entries) {
  ReplayJudgement judgement(server, bots, area, entries);
  const TruthFigures figures = judgement.figures();
  if (discoveries) *discoveries = judgement.discoveries();
  return figures;
}

void write_trace(const std::string& file, const game::ServerEvidence& server,
                 const BotsEvidence& bots, const RelevanceArea& area) {
  TruthTrace trace(file);
  ReplayJudgement judgement(server, bots, area);
  judgement.trace_to(trace);
  judgement.figures();
  trace.finish();
}

RelevanceArea relevance_of(const Experiment& experiment, const Cell& cell,
                           const game::Scene& scene) {
  const physics::Field& field = scene.world.field;
  const double reach = game::view_half_side(experiment.view_area, cell.parameters.view_fraction,
                                            field.length, field.width);
  using Shape = RelevanceArea::Shape;
  constexpr Shape shapes[] = {Shape::square, Shape::disc, Shape::contact, Shape::filter};
  RelevanceArea area{.shape = shapes[static_cast<std::size_t>(experiment.relevance)],
                     .reach = reach,
                     .contact_s = experiment.contact_s};
  if (area.shape == Shape::filter)
    area.expression = experiment.relevant,
    area.always_by_role = game::relevant_kinds_of(scene, experiment.always);
  for (const std::string& more : experiment.also_relevant) {
    if (more == "team") area.has_team = true;
    else area.always = game::relevant_kinds_of(scene, experiment.always);
  }
  return area;
}

namespace {

void judge(RunRecord& record, const Experiment& experiment, const game::ServerEvidence& server,
           const BotsEvidence& bots, Discoveries* discoveries, Entries entries) {
  const RelevanceArea area =
      relevance_of(experiment, record.cell, game::chosen_scene(server.choice));
  TruthFigures figures = truth_of(server, bots, area, discoveries, entries);
  figures.control_bytes_fraction = record.truth.control_bytes_fraction;
  figures.fairness_jain = record.truth.fairness_jain;
  record.truth = figures;
}

/// Under a virtual clock nothing takes time.
void add_tick_costs(RunRecord& record, const game::ServerEvidence& server) {
  std::vector<double> ticks_s;
  for (const game::ServerEvidence::Tick& tick : server.ticks)
    ticks_s.push_back(tick.physics_s + tick.filter_s + tick.send_s);
  if (std::any_of(ticks_s.begin(), ticks_s.end(), [](double tick_s) { return tick_s > 0.0; }))
    record.tick_us = percentiles_us(std::move(ticks_s));
}

/// What goes wrong in `act` is why there are no figures, or why the run does not count.
template <class Act>
void record_trouble(RunRecord& record, const Act& act) {
  try {
    act();
  } catch (const DifferentGame& error) {
    record.valid = false;
    record.why_invalid += (record.why_invalid.empty() ? "" : "; ") + std::string(error.what());
  } catch (const std::exception& error) {
    record.truth.trouble = error.what();
  }
}

const char* const too_many_changes =
    "more scopes changed than there was room for; what was delivered is not judged";

}  // namespace

void add_truth(RunRecord& record, const Experiment& experiment, const game::ServerEvidence& server,
               const BotsEvidence& bots) {
  record_trouble(record, [&] {
    judge(record, experiment, server, bots, nullptr, Entries::passed_over);
    if (!bots.is_complete) record.truth.trouble = too_many_changes;
  });
}

void add_truth(RunRecord& record, const Experiment& experiment, const std::string& server_file,
               const std::string& bots_file, const std::filesystem::path& discovery_file) {
  std::optional<Discoveries> discoveries;
  std::error_code ignored;
  if (!discovery_file.empty())
    std::filesystem::remove(discovery_file, ignored);  // of an earlier run
  record_trouble(record, [&] {
    const game::ServerEvidence server = game::read_server_evidence(server_file);
    record.truth.relevance =
        text_of(relevance_of(experiment, record.cell, game::chosen_scene(server.choice)));
    add_tick_costs(record, server);
    const BotsEvidence bots = read_bots_evidence(bots_file);
    Discoveries found;
    judge(record, experiment, server, bots, &found, Entries::found);
    if (bots.is_complete) discoveries = found;
    if (!bots.is_complete) record.truth.trouble = bots_file + ": " + too_many_changes;
  });
  if (discoveries && !discovery_file.empty()) write_discoveries(discovery_file, *discoveries);
}

}  // namespace rink::loadgen
