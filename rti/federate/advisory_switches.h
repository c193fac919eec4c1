// The services by which a federate chooses the advisories that it receives.
#pragma once

#include "rti/types.h"

namespace rink::rti {

/// 10.27 to 10.34. All are on at first but that of attribute relevance; setting a switch to the
/// value that it has throws ObjectClassRelevanceAdvisorySwitchIsOn or its like. A base of
/// `Switched`, which has `switch_advisory(Advisory, bool)`.
template <class Switched>
class AdvisorySwitches {
 public:
  void enable_object_class_relevance_advisory_switch() {
    set(Advisory::object_class_relevance, true);
  }
  void disable_object_class_relevance_advisory_switch() {
    set(Advisory::object_class_relevance, false);
  }
  void enable_attribute_relevance_advisory_switch() { set(Advisory::attribute_relevance, true); }
  void disable_attribute_relevance_advisory_switch() { set(Advisory::attribute_relevance, false); }
  void enable_attribute_scope_advisory_switch() { set(Advisory::attribute_scope, true); }
  void disable_attribute_scope_advisory_switch() { set(Advisory::attribute_scope, false); }
  void enable_interaction_relevance_advisory_switch() {
    set(Advisory::interaction_relevance, true);
  }
  void disable_interaction_relevance_advisory_switch() {
    set(Advisory::interaction_relevance, false);
  }

 private:
  void set(Advisory advisory, bool is_on) {
    static_cast<Switched*>(this)->switch_advisory(advisory, is_on);
  }
};

}  // namespace rink::rti
