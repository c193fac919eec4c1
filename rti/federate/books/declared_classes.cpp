// Changes of the own declarations and of others' subscriptions.
#include "rti/federate/books/declared_classes.h"

#include <utility>

namespace rink::rti {

void DeclaredClasses::publish(ObjectClassHandle object_class, AttributeSet attributes) {
  assert(object_class.value < objects_.size());
  Class& declared = objects_[object_class.value];
  declared.published = attributes;
  if (attributes.is_empty()) declared.is_relevant = false;
  declared.others = {attributes.is_empty()
                         ? AttributeSet::all()
                         : AttributeSet(declared.others.subscribed.bits | ~attributes.bits),
                     declared.others.active & attributes};
}

void DeclaredClasses::publish(InteractionClassHandle interaction_class, bool is_published) {
  assert(interaction_class.value < interactions_.size());
  Class& declared = interactions_[interaction_class.value];
  if (!is_published) declared = {};
  declared.published = AttributeSet(is_published);
}

void DeclaredClasses::set_others(ObjectClassHandle object_class, const Subscription& others) {
  assert(!published(object_class).is_empty());
  Class& declared = objects_[object_class.value];
  declared.others = {AttributeSet(others.subscribed.bits | ~declared.published.bits),
                     others.active & declared.published};
}

void DeclaredClasses::set_others(InteractionClassHandle interaction_class,
                                 const Subscription& others) {
  assert(is_published(interaction_class));
  Class& declared = interactions_[interaction_class.value];
  declared.others = {others.subscribed, others.active & declared.published};
}

std::optional<bool> DeclaredClasses::turn(Class& declared, bool is_on) {
  const bool is_relevant = is_on && !(declared.published & declared.others.active).is_empty();
  if (std::exchange(declared.is_relevant, is_relevant) == is_relevant || !is_on)
    return std::nullopt;
  return is_relevant;
}

std::optional<bool> DeclaredClasses::turn(ObjectClassHandle object_class, bool is_on) {
  assert(object_class.value < objects_.size());
  return turn(objects_[object_class.value], is_on);
}

std::optional<bool> DeclaredClasses::turn(InteractionClassHandle interaction_class, bool is_on) {
  assert(interaction_class.value < interactions_.size());
  return turn(interactions_[interaction_class.value], is_on);
}

}  // namespace rink::rti
