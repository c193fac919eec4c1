// Values kept back, object by object.
#include "rti/objects/spared_values.h"

#include <algorithm>
#include <bit>

namespace rink::rti {

SparedValues::Spared& SparedValues::keep(ObjectHandle object, ObjectClassHandle object_class,
                                         AttributeSet attributes, Bytes values, double time) {
  Spared& spared = objects_[object];
  const std::size_t count = fom_.at(object_class).attributes.size();
  if (spared.values.empty()) {
    spared.object_class = object_class;
    ++in_class_[object_class.value].objects;
    spared.values.resize(count);
    spared.times.resize(count);
  }
  for (std::uint32_t bits = attributes.bits; bits != 0; bits &= bits - 1) {
    const AttributeHandle attribute{static_cast<std::uint32_t>(std::countr_zero(bits))};
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
  if (--in_class.objects == 0) in_class.attributes = {};
  objects_.erase(object);
}

std::vector<ObjectHandle> SparedValues::list(ObjectClassHandle object_class,
                                             AttributeSet attributes) const {
  std::vector<ObjectHandle> found;
  objects_.for_each([&](ObjectHandle object, const Spared& spared) {
    if ((!object_class || spared.object_class == object_class) &&
        !(spared.attributes & attributes).is_empty())
      found.push_back(object);
  });
  std::ranges::sort(found, {}, &ObjectHandle::value);
  return found;
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
