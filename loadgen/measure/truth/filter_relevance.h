// Relevance by an expression of the filters, judged by where everything truly is.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "game/control/game.h"
#include "loadgen/measure/truth/surroundings.h"
#include "rti/schemes.h"

namespace rink::loadgen {

/// A filter of its own that is handed what a server would hand in
/// (game/net/server/push_filter_hints.h), but of the game played again and at each look: true
/// bounding boxes, the view around the true centre of each bat without any margin, roles, and where
/// players look.
class FilterRelevance {
 public:
  using Centres = std::span<const std::optional<Vector2>>;  ///< by entity

  /// `area` is of the shape `filter`.
  FilterRelevance(const RelevanceArea& area, const game::Scene& scene);

  /// Whether it goes by where players look, which is where they last went if they press no keys.
  bool looks_back() const { return filter_->traits().uses_headings; }

  /// Takes in where everything is now.
  void look_around(const game::Game& game, Centres centres);
  /// What is relevant to the bat `own`, ascending, with a depth of 0, in `found`, which is
  /// overwritten. At the instant of the last look around.
  void find(std::uint32_t own, const game::Game& game, Centres centres,
            std::vector<Relevant>& found);

  /// Asserts that what is relevant to each is sorted, each once, and there.
  void check() const;

 private:
  void take_in(const game::Entity& entity, const Vector2& centre);
  void subscribe(const game::Entity& bat, const game::Game& game, const Vector2& centre);
  void forget(std::uint32_t entity);
  void match();

  RelevanceArea area_;
  std::unique_ptr<im::Filter> filter_;
  std::vector<std::optional<std::vector<std::uint32_t>>>
      relevant_;                 ///< ascending, by bat; of those that somebody asked for
  std::vector<bool> are_there_;  ///< by entity
};

}  // namespace rink::loadgen
