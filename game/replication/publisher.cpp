// Registers what came, deletes what went, and sends what moved, in that order.
#include "game/replication/publisher.h"

#include <array>

#include "game/replication/names.h"

namespace rink::game {
namespace {

im::Region bounding_box(const physics::Vector2& centre, const physics::Vector2& half_extent) {
  return {centre.x() - half_extent.x(), centre.y() - half_extent.y(), centre.x() + half_extent.x(), centre.y() + half_extent.y()};
}

}  // namespace

Publisher::Publisher(const ObjectModel& model, rti::Ambassador& ambassador, UpdatePolicy& policy, const Game& game)
    : model_(model), ambassador_(ambassador), policy_(policy) {
  ambassador_.publish_object_class_attributes(model_.entity, {model_.shape, model_.input, model_.position});
  ambassador_.publish_object_class_attributes(model_.score, {model_.goals});
  ambassador_.publish_object_class_attributes(model_.field, {model_.extent});
  field_ = ambassador_.register_object_instance(model_.field, "field");
  score_ = ambassador_.register_object_instance(model_.score, "score");
  const physics::Field& field = game.world().spec().field;
  const Extent extent{.length = static_cast<float>(field.length), .width = static_cast<float>(field.width)};
  ambassador_.update_attribute_values(field_, {model_.extent}, encode(encoded_, extent), {});
  ambassador_.update_attribute_values(score_, {model_.goals}, encode(encoded_, goals_), {});
}

void Publisher::publish(const Game& game, std::span<const std::uint32_t> felt, const rti::Stamp& stamp) {
  ++tick_;
  moved_.clear();
  for (const Entity& entity : game.entities()) {
    Input input;
    if (entity.player) input = {.count = *entity.player < felt.size() ? felt[*entity.player] : 0u, .held = game.keys_held(*entity.player).bits()};
    if (entity.id.index >= published_.size()) published_.resize(entity.id.index + 1);
    if (published_[entity.id.index].object)
      update(game, entity, input, stamp);
    else
      add(game, entity, input, stamp);
    published_[entity.id.index].tick = tick_;
  }
  retire_absent();
  if (!moved_.empty()) ambassador_.commit_region_modifications(moved_);
  publish_score(game, stamp);
}

void Publisher::add(const Game& game, const Entity& entity, const Input& input, const rti::Stamp& stamp) {
  Published& published = published_[entity.id.index];
  published.object = ambassador_.register_object_instance(model_.entity, entity.player ? bat_name(*entity.player) : "");
  if (!published.object) return;  // a federate's handles are used up by 262,144 registrations: this bat came too late to be seen, the others play on
  published.region = ambassador_.create_region();
  published.position = rounded(game.position(entity.id));
  published.input = input;
  ambassador_.set_region(published.region, bounding_box(game.position(entity.id), entity.half_extent));
  ambassador_.commit_region_modifications(published.region);
  ambassador_.associate_regions_for_updates(published.object, published.region);
  const Shape shape{.kind = static_cast<std::uint8_t>(entity.kind),
                    .team = static_cast<std::uint8_t>(entity.team),
                    .half_length = static_cast<float>(entity.half_extent.x()),
                    .half_width = static_cast<float>(entity.half_extent.y())};
  ambassador_.update_attribute_values(published.object, {model_.shape, model_.input, model_.position}, encode(encoded_, shape, input, published.position), stamp);
}

/// Position if the policy says so, input if it changed; the region if the entity moved at all.
void Publisher::update(const Game& game, const Entity& entity, const Input& input, const rti::Stamp& stamp) {
  Published& published = published_[entity.id.index];
  const bool is_due = policy_.is_due(game, entity), has_felt = input != published.input;
  if (!is_due && !has_felt) {
    ++counters_.entities_skipped;
    return;
  }
  const physics::Vector2 centre = game.position(entity.id);
  const Position position = rounded(centre);
  if (position != published.position) {
    moved_.push_back({published.region, bounding_box(centre, entity.half_extent)});
    published.position = position;
    ++counters_.regions_moved;
  }
  counters_.positions_sent += is_due ? 1u : 0u;
  counters_.inputs_sent += has_felt ? 1u : 0u;
  published.input = input;
  if (!has_felt)
    ambassador_.update_attribute_values(published.object, {model_.position}, encode(encoded_, position), stamp);
  else
    ambassador_.update_attribute_values(published.object, {model_.input, model_.position}, encode(encoded_, input, position), stamp);
}

/// Deletes what was published once but is no longer in the game.
void Publisher::retire_absent() {
  for (Published& published : published_) {
    if (!published.object || published.tick == tick_) continue;
    ambassador_.delete_object_instance(published.object);
    ambassador_.delete_region(published.region);
    published = {};
  }
}

void Publisher::publish_score(const Game& game, const rti::Stamp& stamp) {
  const Score& score = game.score();
  const Goals goals{.left = score.left, .right = score.right, .is_over = static_cast<std::uint8_t>(game.is_over())};
  if (goals == goals_) return;
  goals_ = goals;
  ambassador_.update_attribute_values(score_, {model_.goals}, encode(encoded_, goals), stamp);
}

}  // namespace rink::game
