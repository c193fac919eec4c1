// The newest values of own objects to which nobody subscribes: kept here instead of being sent,
// until somebody does.
#pragma once

#include <cassert>
#include <cstdint>
#include <vector>

#include "rti/fom/fom.h"
#include "rti/objects/object_map.h"
#include "rti/wire/bytes.h"

namespace rink::rti {

/// Per object the newest value of each attribute that was kept back, so that a late subscriber gets
/// the state as if every update had been sent. Values are as the federate gave them; they are coded
/// when they are sent, each by the time of its update. Replacing a value by one that is not longer
/// allocates nothing.
class SparedValues {
 public:
  explicit SparedValues(const Fom& fom) : fom_(fom), in_class_(fom.object_classes().size()) {}

  /// Attributes of the class that may have values here: the quick test before each update.
  AttributeSet in_class(ObjectClassHandle object_class) const {
    assert(object_class.value < in_class_.size());
    return in_class_[object_class.value].attributes;
  }
  bool is_empty() const { return objects_.size() == 0; }

  struct Spared {
    ObjectClassHandle object_class;
    AttributeSet attributes;  ///< that have a value here
    AttributeSet announced;   ///< of those: the RTI knows that it has no newer one
    std::vector<std::vector<std::byte>> values;  ///< by attribute
    std::vector<double> times;                   ///< by attribute: when the value was sent [s]
  };
  /// Keeps the values of `attributes`. Returns the object's entry, for the caller to note what it
  /// announced.
  Spared& keep(ObjectHandle object, ObjectClassHandle object_class, AttributeSet attributes,
               Bytes values, double time);
  /// Forgets values of `attributes`, which were sent otherwise or are no longer wanted.
  void forget(ObjectHandle object, AttributeSet attributes = AttributeSet::all());
  const Spared* find(ObjectHandle object) const { return objects_.find(object); }
  /// The objects of a class, or of all, that have values of `attributes` here, in ascending order.
  std::vector<ObjectHandle> list(ObjectClassHandle object_class, AttributeSet attributes) const;

  std::size_t memory_bytes() const;
  /// Asserts that every entry has a value and is counted in its class.
  void check() const;

 private:
  const Fom& fom_;
  struct InClass {
    AttributeSet attributes;
    std::uint32_t objects = 0;
  };
  std::vector<InClass> in_class_;
  ObjectMap<Spared> objects_;
};

}  // namespace rink::rti
