// Keeps each subscriber's list, and says when it is to be chosen among anew.
#include "im/stages/chooser.h"

#include <algorithm>
#include <cassert>

namespace rink::im {

Chooser::Chooser(std::unique_ptr<Filter> inner, const PairUses& uses)
    : Parts(std::move(inner)), entities_(uses), subscribers_(uses), uses_(uses) {}

void Chooser::set_update_region(Entity entity, const Region& region) {
  if (entities_.place(entity, region)) pairs_.touch_near(entity);
  Parts::set_update_region(entity, region);
}
void Chooser::set_subscription_region(Subscriber subscriber, const Region& region) {
  if (subscribers_.place(subscriber, region)) pairs_.touch(subscriber);
  Parts::set_subscription_region(subscriber, region);
}
void Chooser::remove_entity(Entity entity) {
  Parts::remove_entity(entity);
  pairs_.touch_near(entity);
  entities_.remove(entity);
  pairs_.remove_entity(entity);
}
void Chooser::remove_subscriber(Subscriber subscriber) {
  Parts::remove_subscriber(subscriber);
  subscribers_.remove(subscriber);
  pairs_.remove_subscriber(subscriber);
}
void Chooser::set_entity_role(Entity entity, const Role& role) {
  if (entities_.set_role(entity, role)) pairs_.touch_near(entity);
  Parts::set_entity_role(entity, role);
}
void Chooser::set_subscriber_role(Subscriber subscriber, const Role& role) {
  if (subscribers_.set_role(subscriber, role)) pairs_.touch(subscriber);
  Parts::set_subscriber_role(subscriber, role);
}
void Chooser::set_entity_facts(Entity entity, const Facts& facts) {
  if (entities_.set_facts(entity, facts)) pairs_.touch_near(entity);
  Parts::set_entity_facts(entity, facts);
}
void Chooser::set_subscriber_facts(Subscriber subscriber, const Facts& facts) {
  if (subscribers_.set_facts(subscriber, facts)) pairs_.touch(subscriber);
  Parts::set_subscriber_facts(subscriber, facts);
}
void Chooser::set_heading(Subscriber subscriber, const Heading& heading) {
  if (subscribers_.set_heading(subscriber, heading)) pairs_.touch(subscriber);
  Parts::set_heading(subscriber, heading);
}
void Chooser::set_time(double now) {
  if (uses_.age && std::exchange(now_, now) != now) is_older_ = true;
  Parts::set_time(now);
}

Traits Chooser::traits() const {
  Traits own = Parts::traits();
  own.uses_roles |= uses_.roles, own.uses_headings |= uses_.motion;
  own.uses_facts |= uses_.motion || uses_.age, own.uses_time |= uses_.age;
  return own;
}

std::span<const Change> Chooser::match() {
  const bool is_stale = entities_.take_stale() | subscribers_.take_stale();
  if (std::exchange(is_older_, false) || is_stale) {
    entities_.age(now_), subscribers_.age(now_);
    for (Subscriber subscriber = 0; subscriber < subscribers_.size(); ++subscriber)
      pairs_.touch(subscriber);
  }
  pairs_.visit_touched(parts_.front()->match(),
                       [this](Subscriber subscriber, const CandidatePairs::List& list) {
                         if (list.size() == 0) return;
                         is_chosen_.assign(list.size(), false);
                         choose(subscriber, list);
                         for (std::size_t i = 0; i < list.size(); ++i) {
                           pairs_.decide(subscriber, i, is_chosen_[i], 0.0f);
                           left_out_ += is_chosen_[i] ? 0u : 1u;
                         }
                       });
  changes_.clear();
  pairs_.report(changes_);
  return reported(changes_.span());
}

}  // namespace rink::im
