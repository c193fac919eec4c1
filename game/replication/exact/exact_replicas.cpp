// Plays each tick with its keys once its message is whole, with those set aside whom something
// unknown has hit.
#include "game/replication/exact/exact_replicas.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "game/replication/exact/rounded_play.h"
#include "im/basics/sorted_set.h"

namespace rink::game {
namespace {

using physics::BodyState;
using physics::RestContact;

bool are_same(const RestContact& a, const RestContact& b) {
  return a.low == b.low && a.high == b.high && a.axis == b.axis;
}

}  // namespace

ExactReplicas::Body* ExactReplicas::known_at(std::uint32_t number) {
  const auto at = std::ranges::lower_bound(bodies_, number, {}, &Body::number);
  return at != bodies_.end() && at->number == number ? &*at : nullptr;
}
const ExactReplicas::Body* ExactReplicas::find(std::uint32_t number) const {
  return const_cast<ExactReplicas*>(this)->known_at(number);
}

ExactReplicas::Result ExactReplicas::refuse(const std::string& why) {
  is_exact_ = false, awaits_start_ = true;
  error_ = why;
  return wrong_in_row_ >= wrong_in_row_max ? Result::hopeless : Result::resend;
}

ExactReplicas::Result ExactReplicas::receive(rti::Bytes message) {
  left_.clear(), entered_.clear(), changed_.clear();
  has_started_ = false;
  const bool is_start = !message.empty() && (std::to_integer<int>(message[0]) & 1) != 0;
  if (awaits_start_ && !is_start) return Result::waiting;
  if (is_ahead_) part_->undo(), is_ahead_ = false;
  ExactTick tick;
  if (!read(message, tick)) {
    ++counters_.malformed, ++wrong_in_row_;
    return refuse("a message cannot be read");
  }
  if (tick.start) begin(*tick.start);
  if (!apply(tick)) {
    ++counters_.malformed, ++wrong_in_row_;
    return refuse("a body overlaps another, or cannot be in its state");
  }
  ++counters_.ticks;
  counters_.keys += tick.keys.size(), counters_.doubtful += tick.told.size();
  counters_.entries += tick.entries.size(), counters_.exits += tick.exits.size();
  time_ = tick.time, tag_ = tick.tag;
  felt_ = tick.felt.value_or(felt_);
  is_exact_ = true, awaits_start_ = false;
  error_.clear();
  list_changed();
  if (!tick.hash) return Result::exact;
  ++counters_.hashes;
  if (*tick.hash == hash()) {
    wrong_in_row_ = 0;
    return Result::exact;
  }
  ++counters_.wrong_hashes, ++wrong_in_row_;
  return refuse("the hash of what is known is another than the server's");
}

bool ExactReplicas::read(rti::Bytes message, ExactTick& tick) {
  const ExactContext context{.time = time_,
                             .tag = tag_,
                             .start = start_ ? &*start_ : nullptr,
                             .bats = static_cast<std::uint32_t>(ranks_.bats.size()),
                             .class_of = ranks_.classes};
  rti::BitReader reader(message);
  std::vector<Drive> drives = ranks_.drives;
  if (!exact::exchange(reader, tick, context, drives) || !reader.finish() || reader.left() != 0)
    return false;
  const physics::WorldSpec& spec = tick.start ? tick.start->spec : start_->spec;
  const auto is_sound = [&](const auto& each) { return is_possible(each.state, spec, tick.time); };
  const std::vector<ExactClass>& classes = tick.start ? tick.start->classes : start_->classes;
  return std::ranges::all_of(tick.told, is_sound) &&
         std::ranges::all_of(tick.entries, [&](const ExactEntry& each) {
           return classes[each.exact_class].kind == physics::BodyKind::post || is_sound(each);
         });
}

void ExactReplicas::begin(const ExactStart& start) {
  for (const Body& body : bodies_)
    if (body.is_in_scope) left_.push_back({body.object});
  bodies_.clear();
  ranks_ = {};
  outer_contacts_.clear(), outer_jams_.clear();
  start_ = start;
  start_->spec.slabs.reset();
  part_ = std::make_unique<physics::Subdomain>(start_->spec, exact_number_max);
  time_ = 0.0, tag_ = 0, felt_ = 0;
  has_started_ = true;
  ++counters_.starts;
  for (const ExactPost& post : start_->posts) {
    BodyState state = body_of(start_->classes[post.exact_class], start_->spec);
    state.flight.x = post.x, state.flight.y = post.y;
    part_->put(post.number, state);
  }
}

bool ExactReplicas::apply(const ExactTick& tick) {
  set_aside(tick);
  play(tick);
  leave(tick);
  if (!enter(tick) || !settle_groups()) return false;
  if (tick.told.empty() && tick.exits.empty() && tick.entries.empty()) {  // returns change no rank
    for (const ExactKey& key : tick.keys) ranks_.drives[key.bat] = key.after;
  } else {
    list_ranks();
  }
  return true;
}

void ExactReplicas::list_ranks() {
  ranks_.bats.clear(), ranks_.classes.clear(), ranks_.drives.clear();
  for (const Body& body : bodies_) {
    ranks_.classes.push_back(body.exact_class);
    if (class_of(body).kind != physics::BodyKind::bat) continue;
    ranks_.bats.push_back(body.number), ranks_.drives.push_back(body.drive);
  }
}

/// A new world lists all.
void ExactReplicas::list_changed() {
  for (const physics::BodyId slot : part_->world().inside().changed(cursor_)) {
    if (slot.index == physics::BodySlots::nobody) continue;
    const std::uint32_t number = part_->number_of(slot.index);
    if (find(number) != nullptr && part_->is_there(number)) changed_.push_back(number);
  }
  std::erase_if(changed_, [this](std::uint32_t number) { return find(number) == nullptr; });
}

/// Takes a body out of what is computed. Rest contacts and jams of it go with it; whoever had one
/// with it is in the same group, and is taken out as well.
void ExactReplicas::cast_off(std::uint32_t number) {
  Body* const body = known_at(number);
  assert(body != nullptr);
  if (!body->is_computed || class_of(*body).kind == physics::BodyKind::post) return;
  std::vector<RestContact> rest_contacts = part_->rest_contacts();
  const std::vector<std::uint32_t> group = part_->group_of(number);
  std::vector<std::uint32_t> gone;
  for (const std::uint32_t member : group) {
    Body* const each = known_at(member);
    if (each == nullptr || !each->is_computed || class_of(*each).kind == physics::BodyKind::post)
      continue;
    gone.push_back(member);
    changed_.push_back(member);
    each->is_computed = false;
    each->state = part_->state(member);
    for (const RestContact& rest : rest_contacts)
      if (concerns(rest, member) && std::ranges::none_of(outer_contacts_, [&](const auto& other) {
            return are_same(rest, other);
          }))
        outer_contacts_.push_back(rest);
    if (!physics::Subdomain::is_frozen(each->state)) continue;
    for (const std::uint32_t other : group) {
      if (other == member || !part_->is_there(other)) continue;
      const BodyState companion = part_->state(other);
      if (physics::Subdomain::is_frozen(companion) && companion.jam == each->state.jam)
        outer_jams_.emplace_back(member, other);
    }
  }
  const std::size_t before = rest_contacts.size();
  std::erase_if(rest_contacts, [&](const RestContact& rest) {
    return std::ranges::any_of(gone, [&](std::uint32_t each) { return concerns(rest, each); });
  });
  for (const std::uint32_t each : gone) part_->drop(each);
  if (rest_contacts.size() != before) part_->set_rest_contacts(std::move(rest_contacts));
}

/// Whoever is told at the tick's end, and whoever left in the tick, is not there from its beginning
/// on: without them all others go on as at the sender.
void ExactReplicas::set_aside(const ExactTick& tick) {
  for (const ExactTold& each : tick.told) cast_off(bodies_[each.rank].number);
  for (const ExactExit& each : tick.exits)
    if (each.is_at_start) cast_off(bodies_[each.rank].number);
}

void ExactReplicas::play(const ExactTick& tick) {
  part_->begin_window();
  std::vector<std::uint32_t> moving;
  for (const Body& body : bodies_)
    if (body.is_computed && start_->grid.exist()) moving.push_back(body.number);
  for (const ExactKey& key : tick.keys) {
    Body* const bat = known_at(ranks_.bats[key.bat]);
    assert(bat != nullptr);
    bat->drive = key.after;
    if (!bat->is_computed) continue;
    advance(*part_, key.time, start_->grid, moving);
    part_->set_thrust(bat->number,
                      class_of(*bat).thrust * physics::Vector2(key.after.x, key.after.y));
  }
  advance(*part_, tick.time, start_->grid, moving);
  part_->begin_window();  // what follows is between two ticks
}

void ExactReplicas::leave(const ExactTick& tick) {
  std::vector<std::uint32_t> gone;
  for (const ExactExit& each : tick.exits) {
    Body& body = bodies_[each.rank];
    if (!each.lingers) gone.push_back(body.number);
    if (body.is_in_scope || each.is_removed) left_.push_back({body.object, each.is_removed});
    body.is_in_scope = false;
  }
  for (const std::uint32_t rank : tick.returns) {
    bodies_[rank].is_in_scope = true;
    entered_.push_back(bodies_[rank].number);
  }
  for (const std::uint32_t number : gone)
    if (class_of(*find(number)).kind != physics::BodyKind::post) cast_off(number);
  const auto is_gone = [&](std::uint32_t number) {
    return std::ranges::binary_search(gone, number);
  };
  // Who is told has its contacts told anew.
  std::vector<std::uint32_t> told;
  for (const ExactTold& each : tick.told) told.push_back(bodies_[each.rank].number);
  std::erase_if(outer_contacts_, [&](const RestContact& rest) {
    return std::ranges::any_of(told, [&](std::uint32_t each) { return concerns(rest, each); });
  });
  std::erase_if(outer_jams_, [&](const auto& pair) {
    return is_gone(pair.first) || std::ranges::binary_search(told, pair.first);
  });
  for (const ExactTold& each : tick.told) {
    Body& body = bodies_[each.rank];
    changed_.push_back(body.number);
    body.state = each.state.body, body.drive = each.state.drive;
    for (const RestContact& rest : each.state.rest_contacts)
      if (concerns(rest, body.number) &&
          std::ranges::none_of(outer_contacts_,
                               [&](const auto& other) { return are_same(rest, other); }))
        outer_contacts_.push_back(rest);
    for (const std::uint32_t other : each.state.jammed_with)
      outer_jams_.emplace_back(body.number, other);
  }
  std::erase_if(bodies_, [&](const Body& body) { return is_gone(body.number); });
  std::erase_if(entered_, [this](std::uint32_t number) { return find(number) == nullptr; });
  if (gone.empty()) return;
  std::erase_if(outer_contacts_, [this](const RestContact& rest) {
    return find(rest.low) == nullptr && find(rest.high) == nullptr;
  });
}

/// What was known of contacts with who enters is of old.
bool ExactReplicas::enter(const ExactTick& tick) {
  std::erase_if(outer_contacts_, [&](const RestContact& rest) {
    return std::ranges::any_of(tick.entries,
                               [&](const ExactEntry& each) { return concerns(rest, each.number); });
  });
  for (const ExactEntry& entry : tick.entries) {
    if (find(entry.number) != nullptr) return false;
    const bool is_post = start_->classes[entry.exact_class].kind == physics::BodyKind::post;
    const auto is_it = [&](const ExactPost& post) { return post.number == entry.number; };
    const auto post = std::ranges::find_if(start_->posts, is_it);
    if (is_post != (post != start_->posts.end())) return false;
    Body body{.number = entry.number,
              .exact_class = entry.exact_class,
              .player = entry.player,
              .object = rti::ObjectHandle{entry.object},
              .is_computed = is_post,
              .state = entry.state.body,
              .drive = entry.state.drive};
    if (is_post) body.state = part_->state(entry.number);
    bodies_.insert(std::ranges::lower_bound(bodies_, entry.number, {}, &Body::number), body);
    entered_.push_back(entry.number);
    for (const RestContact& rest : entry.state.rest_contacts) {
      if (!concerns(rest, entry.number)) return false;
      if (std::ranges::none_of(outer_contacts_,
                               [&](const auto& other) { return are_same(rest, other); }))
        outer_contacts_.push_back(rest);
    }
    for (const std::uint32_t other : entry.state.jammed_with)
      outer_jams_.emplace_back(entry.number, other);
  }
  return true;
}

/// All who hold each other with `body`; false if one of them is unknown.
bool ExactReplicas::takes_part(const Body& body, std::vector<std::uint32_t>& group) const {
  bool is_whole = true;
  group = {body.number};
  for (std::size_t k = 0; k < group.size(); ++k) {
    const auto reach = [&](std::uint32_t other) {
      if (find(other) == nullptr) is_whole = false;
      else if (std::ranges::find(group, other) == group.end()) group.push_back(other);
    };
    for (const RestContact& rest : outer_contacts_)
      if (concerns(rest, group[k])) {
        const physics::Partner other = rest.low == group[k] ? rest.high : rest.low;
        const bool is_post = physics::is_body(other) &&
                             std::ranges::any_of(start_->posts, [&](const ExactPost& post) {
                               return post.number == other;
                             });
        if (physics::is_body(other) && !is_post) reach(other);
      }
    for (const auto& [one, other] : outer_jams_)
      if (one == group[k] || other == group[k]) reach(one == group[k] ? other : one);
  }
  return is_whole;
}

/// A body is held along an axis by those contacts alone that are along it.
bool ExactReplicas::are_held_by_contacts(std::span<const std::uint32_t> settled) const {
  return std::ranges::all_of(settled, [this](std::uint32_t number) {
    const Body* const body = find(number);
    if (body->is_computed) return true;
    return std::ranges::all_of(std::initializer_list<int>{0, 1}, [&](int axis) {
      return physics::Subdomain::is_held_along(body->state, axis) ==
             std::ranges::any_of(outer_contacts_, [&](const RestContact& rest) {
               return rest.axis == axis && concerns(rest, number);
             });
    });
  });
}

/// Bodies that are not computed are from now on if all who hold them are known. False if some
/// cannot be so.
bool ExactReplicas::settle_groups() {
  std::vector<std::uint32_t> group, settled;
  for (const Body& body : bodies_)
    if (!body.is_computed && takes_part(body, group))
      settled.insert(settled.end(), group.begin(), group.end());
  make_sorted_set(settled);
  if (settled.empty()) return true;
  if (!are_held_by_contacts(settled)) return false;
  std::vector<RestContact> rest_contacts = part_->rest_contacts();
  for (const std::uint32_t number : settled) {
    Body& body = *known_at(number);
    if (body.is_computed) continue;
    if (!has_room_for(body.state, *part_)) return false;
    body.is_computed = true;
    part_->put(number, body.state);
  }
  const auto is_settled = [&](physics::Partner p) {
    return physics::is_body(p) && std::ranges::binary_search(settled, p);
  };
  for (const RestContact& rest : outer_contacts_)
    if (is_settled(rest.low) || is_settled(rest.high)) rest_contacts.push_back(rest);
  std::erase_if(outer_contacts_, [&](const RestContact& rest) {
    return is_settled(rest.low) || is_settled(rest.high);
  });
  std::erase_if(outer_jams_, [&](const auto& pair) { return is_settled(pair.first); });
  part_->set_rest_contacts(std::move(rest_contacts));
  return true;
}

physics::Motion ExactReplicas::motion(const Body& body) const {
  return body.is_computed ? part_->world().motion({body.number}) : body.state.motion();
}

bool ExactReplicas::is_in_play(const Body& body) const {
  return body.is_computed ? part_->world().is_in_play({body.number})
                          : !physics::Subdomain::is_out_of_play(body.state);
}

std::uint32_t ExactReplicas::hash() const {
  std::uint64_t sum = 0;
  for (const Body& body : bodies_)
    if (class_of(body).kind != physics::BodyKind::post)
      sum += digest_of(body.number, body.is_computed ? part_->state(body.number) : body.state);
  return static_cast<std::uint32_t>(sum >> 32);
}

void ExactReplicas::look_ahead(double instant) {
  if (!is_exact_ || !part_) return;
  instant = std::min(instant, time_ + ahead_max);
  if (!is_ahead_) part_->begin_window();
  is_ahead_ = true;
  if (instant > part_->world().now()) part_->advance(instant);
  changed_.clear();
  list_changed();
}

void ExactReplicas::look_back() {
  if (!is_ahead_) return;
  part_->undo(), is_ahead_ = false;
  changed_.clear();
  list_changed();
}

}  // namespace rink::game
