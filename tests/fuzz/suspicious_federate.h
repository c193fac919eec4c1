// A federate that holds what the RTI tells it against what can be.
#pragma once

#include <string_view>

#include "rti/wire/bytes.h"
#include "tests/fuzz/harness.h"
#include "tests/rti/rig.h"

namespace rink::fuzz {

/// A federate that is told what cannot be stops here: the recorder knows what it knows.
class Suspicious : public rti::testing::Recorder {
 public:
  void discover_object_instance(rti::ObjectHandle object, rti::ObjectClassHandle object_class,
                                std::string_view name) override {
    require(!objects.contains(object.value), "an object is discovered once");
    require(object_class.value < rti::testing::harbour().object_classes().size(),
            "its class exists");
    Recorder::discover_object_instance(object, object_class, name);
  }
  void reflect_attribute_values(rti::ObjectHandle object, rti::AttributeSet set, rti::Bytes values,
                                const rti::Stamp& stamp) override {
    require(objects.contains(object.value), "a reflected object is known");
    require(rti::testing::harbour().values_fit(objects.at(object.value).object_class, set, values),
            "and its values fit");
    Recorder::reflect_attribute_values(object, set, values, stamp);
  }
  void attributes_in_scope(rti::ObjectHandle object) override {
    require(objects.contains(object.value), "what comes into scope is known");
  }
  void attributes_out_of_scope(rti::ObjectHandle object) override {
    require(objects.contains(object.value), "what leaves scope is known");
  }
  void remove_object_instance(rti::ObjectHandle object) override {
    require(objects.erase(object.value) == 1, "what is removed was known");
  }
  void receive_interaction(rti::InteractionClassHandle interaction_class, rti::Bytes,
                           rti::FederateHandle, const rti::Stamp&) override {
    require(interaction_class.value < rti::testing::harbour().interaction_classes().size(),
            "its class exists");
  }
};

}  // namespace rink::fuzz
