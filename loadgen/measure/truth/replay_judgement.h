// Compares the traces of server and bots with the replayed game, and sums up the figures; for the
// truth's own sources only.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "game/net/bots_trace.h"
#include "game/net/server_trace.h"
#include "loadgen/measure/statistics/histogram.h"
#include "loadgen/measure/statistics/sample_distribution.h"
#include "loadgen/measure/truth/classification.h"
#include "loadgen/measure/truth/discovery.h"
#include "loadgen/measure/truth/relevance.h"
#include "loadgen/measure/truth/relevance_intervals.h"
#include "loadgen/measure/truth/replay.h"
#include "loadgen/measure/truth/scope_history.h"
#include "loadgen/measure/truth/trace.h"
#include "loadgen/measure/truth/truth_figures.h"

namespace rink::loadgen {

class ReplayJudgement {
 public:
  ReplayJudgement(const game::ServerTrace& server, const game::BotsTrace& bots,
                  const RelevanceArea& area, Entries entries = Entries::found);

  /// Records all positions in `trace`; call it before `figures`.
  void trace_to(TruthTrace& trace) {
    trace_ = &trace;
    trace.begin(area_, replay_);
  }

  /// The distributions of delays; call it after `figures`.
  Discoveries discoveries() const;

  TruthFigures figures();

 private:
  /// A watched bot, and what it had received by the present instant.
  struct Player {
    explicit Player(std::vector<ScopeStep> told)
        : steps(told), delivered(told), at_contacts(std::move(told)) {}
    std::optional<std::uint32_t> bat;
    std::vector<ScopeStep> steps;
    ScopeHistory delivered, at_contacts;
    RelevanceIntervals intervals;
  };

  /// An instant at which something is evaluated; `index` is into the list of its kind.
  struct Look {
    enum class Kind : std::uint8_t { before, step, decision, displayed, matched };
    double instant_s;
    Kind kind;
    std::size_t index;
  };

  void look_around(double instant_s);
  void add_player(const game::BotsTrace::Bot& bot);
  void plan_looks();
  void judge(const Look& look);
  bool is_present(const Player& player) const {
    return player.bat && replay_.is_there(*player.bat);
  }
  void judge_entries(double instant_s);
  void judge_decision(const game::ServerTrace::Decision& decision);
  bool is_relevant(std::uint32_t entity) const;
  bool is_replaced_unheard(const game::BotsTrace::Sample& sample,
                           const game::BotsTrace::Replica& replica, std::uint32_t entity) const;
  void add_error(PositionErrors& errors, const game::BotsTrace::Sample& sample,
                 const game::BotsTrace::Replica& replica, std::uint32_t entity,
                 const Vector2& believed);
  void judge_displayed(const game::BotsTrace::Sample& sample);
  void judge_matched(const game::BotsTrace::Sample& sample);
  void judge_contacts();
  void judge_contact(Player& player, std::uint32_t entity, double instant_s);
  TruthFigures sums();
  Percentiles late_entries();

  const game::ServerTrace& server_;
  const game::BotsTrace& bots_;
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

}  // namespace rink::loadgen
