// Keeps values back, object by object.
#include "rti/objects/spared_values.h"

#include <algorithm>
#include <cassert>

#include "im/basics/checked.h"

namespace rink::rti {

SparedValues::Spared& SparedValues::keep(ObjectHandle object, ObjectClassHandle object_class,
                                         AttributeSet attributes, Bytes values, double time) {
  assert(object_class.value < in_class_.size() && !attributes.is_empty());
  Spared& spared = objects_[object];
  assert(spared.values.empty() || spared.object_class == object_class);
  const std::size_t count = fom_.at(object_class).attributes.size();
  if (spared.values.empty()) {
    spared.object_class = object_class;
    ++in_class_[object_class.value].objects;
    spared.values.resize(count);
    spared.times.resize(count);
  }
  for (const AttributeHandle attribute : attributes) {
    const Bytes value = fom_.value(object_class, attributes, attribute, values);
    spared.values[attribute.value].assign(value.begin(), value.end());
    spared.times[attribute.value] = time;
  }
  spared.attributes = spared.attributes | attributes;
  in_class_[object_class.value].attributes = in_class_[object_class.value].attributes | attributes;
  return spared;
}

void SparedValues::forget(ObjectHandle object, AttributeSet attributes) {
  Spared* spared = objects_.find(object);
  if (spared == nullptr) return;
  spared->attributes = spared->attributes.without(attributes);
  spared->announced = spared->announced.without(attributes);
  if (!spared->attributes.is_empty()) return;
  InClass& in_class = in_class_[spared->object_class.value];
  assert(in_class.objects > 0);
  if (--in_class.objects == 0) in_class.attributes = {};
  objects_.erase(object);
}

std::vector<ObjectHandle> SparedValues::list(ObjectClassHandle object_class,
                                             AttributeSet attributes) const {
  if constexpr (checks_whole_structures) check();
  std::vector<ObjectHandle> found;
  objects_.for_each([&](ObjectHandle object, const Spared& spared) {
    if ((!object_class || spared.object_class == object_class) &&
        !(spared.attributes & attributes).is_empty())
      found.push_back(object);
  });
  std::ranges::sort(found, {}, &ObjectHandle::value);
  return found;
}

void SparedValues::check() const {
  std::vector<std::uint32_t> counts(in_class_.size());
  objects_.for_each([&](ObjectHandle, const Spared& spared) {
    ++counts[spared.object_class.value];
    assert(!spared.attributes.is_empty() && spared.attributes.includes(spared.announced));
    assert(in_class_[spared.object_class.value].attributes.includes(spared.attributes));
    assert(spared.values.size() == spared.times.size());
  });
  for (std::size_t i = 0; i < counts.size(); ++i) {
    assert(counts[i] == in_class_[i].objects);
    assert(counts[i] > 0 || in_class_[i].attributes.is_empty());
  }
}

std::size_t SparedValues::memory_bytes() const {
  std::size_t bytes = objects_.memory_bytes() + in_class_.capacity() * sizeof in_class_[0];
  objects_.for_each([&](ObjectHandle, const Spared& spared) {
    bytes += spared.values.capacity() * sizeof spared.values[0] +
             spared.times.capacity() * sizeof(double);
    for (const auto& value : spared.values) bytes += value.capacity();
  });
  return bytes;
}

}  // namespace rink::rti
