// What a federate declared and was told of it: which classes it publishes, what others hear of
// them, and what is kept back because nobody does.
#pragma once

#include <cassert>
#include <cstdint>
#include <vector>

#include "rti/distribution/data_distribution.h"
#include "rti/federate/advisory_switches.h"
#include "rti/objects/spared_values.h"
#include "rti/ownership/holding.h"

namespace rink::rti {

struct DeclaredState {
  /// Of one class that is published.
  struct Class {
    AttributeSet published;  ///< 1 for an interaction class
    Subscription others{AttributeSet(~0u),
                        {}};   ///< what others hear, as the RTI told; all until then
    AttributeSet sent;         ///< an update of these was sent once: the RTI may hold a value
    bool is_relevant = false;  ///< as the federate was told
  };
  explicit DeclaredState(const Fom& fom)
      : objects(fom.object_classes().size()),
        interactions(fom.interaction_classes().size()),
        spared(fom),
        switches(of(fom.switches())),
        is_deleting(deletes(fom.switches().automatic_resign_action)) {}
  static unsigned of(const FomSwitches& model) {
    const auto bit = [](Advisory advisory, bool is_on) {
      return (is_on ? 1u : 0u) << static_cast<unsigned>(advisory);
    };
    return bit(Advisory::object_class_relevance, model.object_class_relevance_advisory) |
           bit(Advisory::attribute_relevance, model.attribute_relevance_advisory) |
           bit(Advisory::attribute_scope, model.attribute_scope_advisory) |
           bit(Advisory::interaction_relevance, model.interaction_relevance_advisory);
  }

  /// Before each update: false, and nothing else is to be done, if somebody hears it and nothing of
  /// it is kept back.
  bool is_special(ObjectClassHandle object_class, AttributeSet attributes) const {
    const AttributeSet heard = objects[object_class.value].others.heard;
    return (attributes & heard).is_empty() ||
           !(attributes & spared.in_class(object_class)).is_empty();
  }
  void note_sent(ObjectClassHandle object_class, AttributeSet attributes, const Stamp& stamp) {
    assert(object_class.value < objects.size());
    AttributeSet& sent = objects[object_class.value].sent;
    sent = sent | attributes;
    newest = stamp;
  }
  bool is_on(Advisory advisory) const {
    return (switches >> static_cast<unsigned>(advisory) & 1u) != 0;
  }
  std::size_t memory_bytes() const {
    return (objects.capacity() + interactions.capacity()) * sizeof(Class) + spared.memory_bytes() +
           relevant_objects.memory_bytes();
  }

  std::vector<Class> objects, interactions;
  SparedValues spared;
  ObjectMap<AttributeSet> relevant_objects;  ///< of own objects: attributes in somebody's scope, as
                                             ///< far as the federate was told
  Stamp newest;                              ///< of the latest update, be it kept back
  unsigned switches;  ///< by `Advisory`, at first as the model says; the relevance of single
                      ///< attributes costs messages
  bool is_deleting;   ///< what is owned whole ends with its federate, however that leaves
};

}  // namespace rink::rti
