// The classes that a federate publishes, and the part to which others subscribe.
#pragma once

#include <cassert>
#include <cstdint>
#include <optional>
#include <vector>

#include "rti/distribution/data_distribution.h"
#include "rti/fom/fom.h"
#include "rti/wire/state_stream.h"

namespace rink::rti {

/// Only `FederateDeclarations` changes it.
class DeclaredClasses {
 public:
  explicit DeclaredClasses(const Fom& fom)
      : objects_(fom.object_classes().size()), interactions_(fom.interaction_classes().size()) {}

  std::uint32_t object_class_count() const { return static_cast<std::uint32_t>(objects_.size()); }
  std::uint32_t interaction_class_count() const {
    return static_cast<std::uint32_t>(interactions_.size());
  }
  AttributeSet published(ObjectClassHandle object_class) const {
    return at(object_class).published;
  }
  bool is_published(InteractionClassHandle interaction_class) const {
    return !at(interaction_class).published.is_empty();
  }
  /// The attributes to which others subscribe, as the RTI last advised; all before the first advice
  /// and for a class that is not published, so that sending it meets the error.
  AttributeSet subscribed(ObjectClassHandle object_class) const {
    return at(object_class).others.subscribed;
  }
  bool is_heard(InteractionClassHandle interaction_class) const {
    return !at(interaction_class).others.subscribed.is_empty();
  }

  void publish(ObjectClassHandle object_class, AttributeSet attributes);
  void publish(InteractionClassHandle interaction_class, bool is_published);
  /// Notes the RTI's advice about others' subscriptions. The class must be published.
  void set_others(ObjectClassHandle object_class, const Subscription& others);
  void set_others(InteractionClassHandle interaction_class, const Subscription& others);
  /// True if the class became relevant, false if it ceased to be, since the federate was last
  /// notified; nothing if neither. While the switch is off nothing counts as notified.
  std::optional<bool> turn(ObjectClassHandle object_class, bool is_on);
  std::optional<bool> turn(InteractionClassHandle interaction_class, bool is_on);

  std::size_t memory_bytes() const {
    return (objects_.capacity() + interactions_.capacity()) * sizeof(Class);
  }
  template <class Stream>
  bool keep(Stream& stream) {
    const std::size_t objects = objects_.size(), interactions = interactions_.size();
    return keep_all(stream, objects_, interactions_) && objects_.size() == objects &&
           interactions_.size() == interactions;
  }

 private:
  struct Class {
    AttributeSet published;  ///< 1 for an interaction class
    Subscription others{AttributeSet::all(), {}};
    bool is_relevant = false;  ///< as the federate was last notified
    template <class Stream>
    bool keep(Stream& stream) {
      return keep_all(stream, published, others, is_relevant);
    }
  };
  static std::optional<bool> turn(Class& declared, bool is_on);
  const Class& at(ObjectClassHandle object_class) const {
    assert(object_class.value < objects_.size());
    return objects_[object_class.value];
  }
  const Class& at(InteractionClassHandle interaction_class) const {
    assert(interaction_class.value < interactions_.size());
    return interactions_[interaction_class.value];
  }

  std::vector<Class> objects_, interactions_;
};

}  // namespace rink::rti
