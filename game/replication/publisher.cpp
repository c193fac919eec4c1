// Registers new entities, deletes removed ones, and sends motions, in that order.
#include "game/replication/publisher.h"

#include <algorithm>
#include <cassert>
#include <functional>
#include <limits>
#include <utility>

#include "game/replication/names.h"
#include "game/replication/trajectory.h"
#include "im/basics/checked.h"
#include "im/basics/sorted_set.h"
#include "rti/time/federate_clock.h"

namespace rink::game {
namespace {

/// `felt`: see Publisher::publish.
Input input_of(const Game& game, const Entity& entity, std::span<const std::uint32_t> felt) {
  if (!entity.player) return {};
  return {.count = *entity.player < felt.size() ? felt[*entity.player] : 0u,
          .held = game.keys_held(*entity.player).bits()};
}

}  // namespace

Publisher::Publisher(const ObjectModel& model, rti::Ambassador& ambassador, UpdatePolicy& policy,
                     const Game& game, const RegionSweep& sweep)
    : model_(model),
      ambassador_(ambassador),
      policy_(policy),
      motion_(policy.motion_attribute(model)),
      sweep_(sweep) {
  ambassador_.publish_object_class_attributes(model_.entity, {model_.shape, model_.input, motion_});
  ambassador_.publish_object_class_attributes(model_.score, {model_.goals});
  ambassador_.publish_object_class_attributes(model_.field, {model_.extent, model_.drag});
  field_ = ambassador_.register_object_instance(model_.field, "field");
  score_ = ambassador_.register_object_instance(model_.score, "score");
  const physics::Field& field = game.world().spec().field;
  const Extent extent{.length = static_cast<float>(field.length),
                      .width = static_cast<float>(field.width)};
  const Drag drag = policy.sent_drag(game.world().spec());
  ambassador_.update_attribute_values(field_, {model_.extent, model_.drag},
                                      encode(encoded_, extent, drag), {});
  ambassador_.update_attribute_values(score_, {model_.goals}, encode(encoded_, goals_), {});
}

void Publisher::publish(const Game& game, std::span<const std::uint32_t> felt,
                        const rti::Stamp& stamp) {
  moved_.clear();
  registered_.clear();
  flights_.clear();
  movers_.look(game.world());
  sweep_.look_at(game.world(), movers_);
  published_.resize(game.world().body_count());
  const auto is_new = [&](EntityId id) {
    return !published_[id.index].object && !game.world().is_removed(id);
  };
  if (std::ranges::any_of(movers_.changed(), is_new)) retire_gone(game);
  gather(game, felt);
  active_.clear();
  std::size_t said = 0;
  for (const EntityId id : looked_) {
    Published& published = published_[id.index];
    if (game.world().is_removed(id) || published.is_hidden) continue;
    if (published.object) {
      said += update(game, published, input_of(game, published.entity, felt), stamp) ? 1u : 0u;
    } else if (game.is_there(id)) {
      const Entity& entity = game.entity(id);
      add(game, entity, input_of(game, entity, felt), stamp);
      ++said;
    }
  }
  counters_.entities_looked_at += looked_.size();
  assert(said <= game.entities().size());
  counters_.entities_skipped += game.entities().size() - said;
  retire_gone(game);
  if (!moved_.empty()) ambassador_.commit_region_modifications(moved_);
  publish_score(game, stamp);
  if constexpr (checks_whole_structures) check();
}

void Publisher::check() const {
  assert(std::ranges::adjacent_find(active_, std::greater_equal<>()) == active_.end());
  assert(active_.empty() || active_.back().index < published_.size());
  assert(std::is_heap(wakes_.begin(), wakes_.end()));
  std::vector<bool> is_awaited(published_.size());
  for (const Wake& wake : wakes_) {
    assert(wake.entity.index < published_.size());
    if (published_[wake.entity.index].wake_s == wake.time_s) is_awaited[wake.entity.index] = true;
  }
  std::vector<std::uint32_t> objects;
  for (std::size_t index = 0; index < published_.size(); ++index) {
    const Published& published = published_[index];
    if (!published.object) continue;
    assert(published.entity.id.index == index && is_entity(published.object));
    assert(published.wake_s == never || is_awaited[index]);
    objects.push_back(published.object.value);
  }
  std::ranges::sort(objects);
  assert(std::ranges::adjacent_find(objects) == objects.end());
}

/// Gathers the entities of this tick: those with a changed motion, those due at each tick or by
/// now, and those with keys in effect.
void Publisher::gather(const Game& game, std::span<const std::uint32_t> felt) {
  looked_.assign(active_.begin(), active_.end());
  looked_.insert(looked_.end(), movers_.changed().begin(), movers_.changed().end());
  for (; !wakes_.empty() && wakes_.front().time_s < game.now(); wakes_.pop_back()) {
    Published& published = published_[wakes_.front().entity.index];
    if (published.object && published.wake_s == wakes_.front().time_s) {
      looked_.push_back(wakes_.front().entity);
      published.wake_s = never;
    }
    std::pop_heap(wakes_.begin(), wakes_.end());
  }
  for (std::uint32_t player = 0; player < game.player_count(); ++player)
    if (const auto bat = game.bat(player)) {
      const Published& published = published_[bat->index];
      if (published.object && input_of(game, published.entity, felt) != published.input)
        looked_.push_back(*bat);
    }
  make_sorted_set(looked_);
  assert(looked_.empty() || looked_.back().index < published_.size());
}

void Publisher::add(const Game& game, const Entity& entity, const Input& input,
                    const rti::Stamp& stamp) {
  Published& published = published_[entity.id.index];
  assert(!published.object && "an entity is registered once");
  published.object = ambassador_.register_object_instance(
      model_.entity, entity.player ? bat_name(*entity.player) : "");
  if (published.object && keeps_order_)
    ambassador_.change_attribute_order_type(published.object, {model_.input, motion_},
                                            rti::Order::timestamp);
  if (!published.object) {  // the block of handles is used up; the RTI may give a further one
    active_.push_back(entity.id);
    return;
  }
  registered_.push_back({published.object, entity});
  published.entity = entity;
  published.region = ambassador_.create_region();
  published.position = rounded(game.position(entity.id));
  published.input = input;
  ambassador_.set_region(published.region,
                         sweep_.is_on()
                             ? sweep_.region(game.world(), entity.id, published.swept)
                             : bounding_box(game.position(entity.id), entity.half_extent));
  ambassador_.commit_region_modifications(published.region);
  ambassador_.associate_regions_for_updates(published.object, published.region);
  const Resistance own = policy_.sent_drag(game.world().spec()).of(entity.kind);
  const double mass = game.world().mass(entity.id);
  const Shape shape{
      .kind = static_cast<std::uint8_t>(entity.kind),
      .team = static_cast<std::uint8_t>(entity.team),
      .half_length = static_cast<float>(entity.half_extent.x()),
      .half_width = static_cast<float>(entity.half_extent.y()),
      .drag = static_cast<float>(own.drag),
      .friction = static_cast<float>(own.friction),
      .thrust = entity.player ? static_cast<float>(key_thrust(game, *entity.player)) : 0.0f,
      .mass = std::isfinite(mass) ? static_cast<float>(mass) : 0.0f};
  encode(encoded_, shape, input);
  rti::Writer writer(encoded_);
  policy_.write(game, entity, writer);
  ambassador_.update_attribute_values(published.object, {model_.shape, model_.input, motion_},
                                      encoded_, stamp);
  schedule(game, published);
}

void Publisher::keep_order() {
  keeps_order_ = true;
  ambassador_.change_attribute_order_type(score_, {model_.goals}, rti::Order::timestamp);
  for (const Published& each : published_)
    if (each.object)
      ambassador_.change_attribute_order_type(each.object, {model_.input, motion_},
                                              rti::Order::timestamp);
}

void Publisher::notify(rti::ObjectHandle object, rti::AttributeSet attributes, rti::Bytes values,
                       const rti::Stamp& stamp) {
  if (keeps_order_ && stamp.time >= ambassador_.clock().earliest())
    ambassador_.update_attribute_values(object, attributes, values, rti::LogicalTime(stamp.time),
                                        stamp.tag);
  else ambassador_.update_attribute_values(object, attributes, values, stamp);
}

/// The update region, which follows the entity whether or not anything is sent.
void Publisher::follow(const Game& game, const Entity& entity, Published& published) {
  if (sweep_.is_on()) {
    if (sweep_.still_holds(game.world(), entity.id, published.swept)) return;
    moved_.push_back({published.region, sweep_.region(game.world(), entity.id, published.swept)});
  } else {
    if (entity.kind == physics::BodyKind::post ||
        (hands_in_flights_ && fly(game, entity, published)))
      return;
    const physics::Vector2 centre = game.position(entity.id);
    const Position position = rounded(centre);
    if (position == published.position) return;
    published.position = position;
    moved_.push_back({published.region, bounding_box(centre, entity.half_extent)});
  }
  ++counters_.regions_moved;
}

/// True if the entity flies by the law of pucks; its flight then gives its place, and its region
/// its size.
bool Publisher::fly(const Game& game, const Entity& entity, Published& published) {
  const std::uint32_t version = game.world().motion_version(entity.id);
  const bool is_in_play =
      game.world().is_in_play(entity.id);  // a scored puck stays where it left play
  if (is_in_play && published.registered_flight == version) return true;
  const physics::Motion motion = game.world().motion(entity.id);
  const double drag = game.world().spec().puck_drag;
  const bool has_law = motion.drag.x() == drag && motion.drag.y() == drag &&
                       motion.rest_time == std::numeric_limits<double>::infinity();
  if (!is_in_play || !motion.acceleration.isZero(0.0) ||
      !(has_law || motion.velocity.isZero(0.0))) {
    published.registered_flight.reset();
    return false;
  }
  published.registered_flight = version;
  published.position = rounded(game.position(entity.id));
  moved_.push_back({published.region, bounding_box(game.position(entity.id), entity.half_extent)});
  flights_.push_back({published.object,
                      {motion.position.x(), motion.position.y(), motion.velocity.x(),
                       motion.velocity.y(), motion.time}});
  ++counters_.regions_moved;
  return true;
}

/// Sends motion if the policy decides so, and input if it changed, in one update.
bool Publisher::update(const Game& game, Published& published, const Input& input,
                       const rti::Stamp& stamp) {
  const Entity& entity = published.entity;
  assert(published.object && published_[entity.id.index].object == published.object);
  follow(game, entity, published);
  const bool is_due = policy_.is_due(game, entity), has_felt = input != published.input;
  if (is_due || has_felt) {
    rti::AttributeSet sent;
    encoded_.clear();
    rti::Writer writer(encoded_);
    if (has_felt) {
      published.input = input;
      sent.insert(model_.input);
      exchange(writer, published.input);
    }
    if (is_due) {
      sent.insert(motion_);
      policy_.write(game, entity, writer);
    }
    counters_.motions_sent += is_due ? 1u : 0u;
    counters_.inputs_sent += has_felt ? 1u : 0u;
    notify(published.object, sent, encoded_, stamp);
  }
  schedule(game, published);
  return is_due || has_felt;
}

/// The time [s] until which `follow` has nothing to do while the motion does not change.
double Publisher::region_holds_until(const Game& game, const Published& published) const {
  const EntityId id = published.entity.id;
  if (sweep_.is_on()) return sweep_.holds_until(published.swept);
  const bool is_fixed =
      published.entity.kind == physics::BodyKind::post || !game.world().is_in_play(id);
  const bool stays = is_fixed || (hands_in_flights_ ? published.registered_flight.has_value()
                                                    : game.world().is_resting(id));
  return stays ? never : game.now();
}

/// Schedules the next tick at which the entity must be checked.
void Publisher::schedule(const Game& game, Published& published) {
  const double quiet_until_s =
      std::min(policy_.quiet_until(game, published.entity), region_holds_until(game, published));
  if (quiet_until_s <= game.now()) {
    active_.push_back(published.entity.id);
  } else if (quiet_until_s < published.wake_s) {  // an earlier wake-up finds nothing to do, and
                                                  // schedules again
    published.wake_s = quiet_until_s;
    wakes_.push_back({quiet_until_s, published.entity.id});
    std::push_heap(wakes_.begin(), wakes_.end());
  }
}

/// The new region has no place until the entity is shown.
void Publisher::hide(EntityId entity) {
  if (published_.size() <= entity.index) published_.resize(entity.index + std::size_t{1});
  Published& published = published_[entity.index];
  if (std::exchange(published.is_hidden, true) || !published.object) return;
  const rti::RegionHandle former = std::exchange(published.region, ambassador_.create_region());
  ambassador_.associate_regions_for_updates(published.object, published.region);
  ambassador_.delete_region(former);
  published.registered_flight.reset();
  published.swept = {};
  constexpr float nowhere = std::numeric_limits<float>::quiet_NaN();
  published.position = {nowhere, nowhere};  // unequal to wherever it will be
}

void Publisher::show(EntityId entity) {
  if (entity.index >= published_.size() || !published_[entity.index].is_hidden) return;
  published_[entity.index].is_hidden = false;
  active_.push_back(entity);
}

std::size_t Publisher::hidden_count() const {
  return static_cast<std::size_t>(std::ranges::count_if(published_, &Published::is_hidden));
}

void Publisher::retire_all() {
  for (Published& published : published_)
    if (published.object) retire(published);
  published_.clear();
  active_.clear();
  wakes_.clear();
}

/// Deletes entities that are no longer in the game before new ones are registered: a bat that left
/// and came back within one tick has its old name.
void Publisher::retire_gone(const Game& game) {
  for (const EntityId id : movers_.changed())
    if (published_[id.index].object && game.world().is_removed(id)) retire(published_[id.index]);
}

void Publisher::retire(Published& published) {
  assert(published.object && published.region);
  ambassador_.delete_object_instance(published.object);
  ambassador_.delete_region(published.region);
  published = {};
}

void Publisher::publish_score(const Game& game, const rti::Stamp& stamp) {
  const Score& score = game.score();
  const Goals goals{.left = score.left,
                    .right = score.right,
                    .is_over = static_cast<std::uint8_t>(game.is_over())};
  if (goals == goals_) return;
  goals_ = goals;
  notify(score_, {model_.goals}, encode(encoded_, goals), stamp);
}

}  // namespace rink::game
