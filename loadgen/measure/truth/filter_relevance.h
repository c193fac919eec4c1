// True relevance by an expression of the filters, applied to true positions.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "game/control/game.h"
#include "game/replication/game_facts.h"
#include "loadgen/measure/truth/surroundings.h"
#include "rti/schemes.h"

namespace rink::loadgen {

/// A separate filter that gets what a server passes to its filter
/// (game/net/server/push_filter_hints.h), but from the replayed game and at each look:
/// true bounding boxes, the view around the true centre of each bat without any margin, roles, and
/// where players look.
class FilterRelevance {
 public:
  using Centres = std::span<const std::optional<Vector2>>;  ///< by entity

  /// `area` is of the shape `filter`.
  FilterRelevance(const RelevanceArea& area, const game::Scene& scene);

  /// True if relevance depends on players' headings, which are their last direction of motion if
  /// they press no keys.
  bool looks_back() const { return filter_->traits().uses_headings; }

  /// Updates all positions.
  void look_around(const game::Game& game, Centres centres);
  /// Writes the entities relevant to the bat `own` at the last `look_around` to `found`, ascending,
  /// with a depth of 0.
  void find(std::uint32_t own, const game::Game& game, Centres centres,
            std::vector<Relevant>& found);

  /// Asserts that each list of relevant entities is sorted, without repetitions, and of existing
  /// entities.
  void check() const;

 private:
  void take_in(const game::Entity& entity, const game::Game& game, const Vector2& centre);
  void subscribe(const game::Entity& bat, const game::Game& game, const Vector2& centre);
  void forget(std::uint32_t entity);
  void match();

  RelevanceArea area_;
  game::GameFacts facts_;
  std::unique_ptr<im::Filter> filter_;
  std::vector<std::optional<std::vector<std::uint32_t>>>
      relevant_;                 ///< ascending, by bat; only of bats that were asked for
  std::vector<bool> are_there_;  ///< by entity
};

}  // namespace rink::loadgen
