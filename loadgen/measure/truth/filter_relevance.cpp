// Subscribes bats when they are first needed; where players' headings matter all are subscribed
// from the beginning, since headings depend on the past.
#include "loadgen/measure/truth/filter_relevance.h"

#include <algorithm>
#include <cassert>
#include <functional>

#include "game/control/bat_controller.h"
#include "game/replication/filter_setup.h"
#include "im/basics/checked.h"

namespace rink::loadgen {
namespace {

im::Region around(const Vector2& centre, const Vector2& half) {
  return {centre.x() - half.x(), centre.y() - half.y(), centre.x() + half.x(),
          centre.y() + half.y()};
}

}  // namespace

FilterRelevance::FilterRelevance(const RelevanceArea& area, const game::Scene& scene)
    : area_(area), filter_(im::make_filter(area.expression, game::filter_settings(scene, 0.0))) {
  assert(area.shape == RelevanceArea::Shape::filter && !im::fault_in_momentary(area.expression));
}

void FilterRelevance::look_around(const game::Game& game, Centres centres) {
  if (filter_->traits().uses_time) filter_->set_time(game.now());
  are_there_.resize(std::max(are_there_.size(), centres.size()), false);
  relevant_.resize(are_there_.size());
  for (std::uint32_t entity = 0; entity < are_there_.size(); ++entity)
    if (are_there_[entity] && (entity >= centres.size() || !centres[entity])) forget(entity);
  for (const game::Entity& entity : game.entities()) {
    assert(entity.id.index < centres.size());
    if (!centres[entity.id.index]) continue;  // an agent that is away
    take_in(entity, game, *centres[entity.id.index]);
    if (entity.player && (looks_back() || relevant_[entity.id.index]))
      subscribe(entity, game, *centres[entity.id.index]);
  }
  match();
}

void FilterRelevance::take_in(const game::Entity& entity, const game::Game& game,
                              const Vector2& centre) {
  const std::uint32_t number = entity.id.index;
  filter_->set_update_region(number, around(centre, entity.half_extent));
  if (filter_->traits().uses_facts)
    filter_->set_entity_facts(number, facts_.of(game, entity, game.now()));
  if (are_there_[number]) return;
  are_there_[number] = true;
  filter_->set_entity_role(number, game::role_of(entity, area_.always_by_role.has(entity.kind)));
}

void FilterRelevance::subscribe(const game::Entity& bat, const game::Game& game,
                                const Vector2& centre) {
  const std::uint32_t number = bat.id.index;
  filter_->set_subscription_region(number, around(centre, {area_.reach, area_.reach}));
  if (!relevant_[number]) {
    relevant_[number].emplace();
    filter_->set_subscriber_role(number, game::role_of(bat, false));
  }
  if (filter_->traits().uses_facts)
    filter_->set_subscriber_facts(number, facts_.of(game, bat, game.now()));
  if (!looks_back()) return;
  const Vector2 heading = game::direction(game.keys_held(*bat.player));
  filter_->set_heading(number, {heading.x(), heading.y()});
}

void FilterRelevance::forget(std::uint32_t entity) {
  are_there_[entity] = false;
  filter_->remove_entity(entity);
  if (relevant_[entity]) filter_->remove_subscriber(entity), relevant_[entity].reset();
  for (auto& each : relevant_)
    if (each) std::erase(*each, entity);
}

void FilterRelevance::match() {
  for (const im::Change& change : filter_->match()) {
    assert(change.subscriber < relevant_.size() && relevant_[change.subscriber]);
    std::vector<std::uint32_t>& list = *relevant_[change.subscriber];
    const auto place = std::lower_bound(list.begin(), list.end(), change.entity);
    const bool is_listed = place != list.end() && *place == change.entity;
    assert(is_listed == (change.transition == im::Transition::left));
    if (is_listed) list.erase(place);
    else list.insert(place, change.entity);
  }
  if constexpr (checks_whole_structures) check();
}

void FilterRelevance::check() const {
  assert(relevant_.size() == are_there_.size());
  for (const auto& list : relevant_) {
    if (!list) continue;
    assert(std::ranges::adjacent_find(*list, std::greater_equal<>()) == list->end());
    assert(std::ranges::all_of(*list, [this](std::uint32_t one) { return are_there_[one]; }));
  }
}

void FilterRelevance::find(std::uint32_t own, const game::Game& game, Centres centres,
                           std::vector<Relevant>& found) {
  assert(own < centres.size() && centres[own] && own < relevant_.size());
  if (!relevant_[own]) {
    subscribe(game.entity({own}), game, *centres[own]);
    match();
  }
  found.clear();
  for (const std::uint32_t entity : *relevant_[own])
    if (entity != own) found.push_back({entity, 0.0});
}

}  // namespace rink::loadgen
