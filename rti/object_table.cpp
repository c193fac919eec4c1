// Slots, handles and latest values.
#include "rti/object_table.h"

#include <cassert>
#include <cstring>

#include "rti/message.h"

namespace rink::rti {

ObjectTable::ObjectTable(const Fom& fom) : fom_(fom) {
  for (const ObjectClass& each : fom.object_classes()) {
    Layout& layout = layouts_.emplace_back();
    for (const Attribute& attribute : each.attributes) {
      layout.offsets.push_back(layout.fixed_size);
      layout.fixed_size += attribute.size.value_or(0);
      layout.has_varying |= !attribute.size;
    }
  }
}

ObjectSlot ObjectTable::insert(ObjectHandle handle, std::uint32_t owner, std::uint16_t object_class, std::string_view name) {
  assert(!was_registered(handle));
  ObjectSlot slot = slot_count();
  if (free_.empty()) {
    objects_.emplace_back();
  } else {
    slot = free_.back();
    free_.pop_back();
    objects_[slot] = {};
  }
  Object& object = objects_[slot];
  object.handle = handle;
  object.owner = owner;
  object.object_class = object_class;
  object.is_alive = true;
  object.name = name;
  object.fixed.resize(layouts_[object_class].fixed_size);
  if (layouts_[object_class].has_varying) object.varying.resize(layouts_[object_class].offsets.size());
  const std::uint32_t block = handle.value / object_block, number = handle.value % object_block;
  if (block >= slots_.size()) slots_.resize(block + 1);
  if (number >= slots_[block].size()) slots_[block].resize(number + 1, never);
  slots_[block][number] = slot;
  ++size_;
  return slot;
}

void ObjectTable::erase(ObjectSlot slot) {
  Object& object = objects_[slot];
  assert(object.is_alive);
  object.is_alive = false;
  slots_[object.handle.value / object_block][object.handle.value % object_block] = gone;
  leaving_.push_back(slot);
  --size_;
}

void ObjectTable::recycle() {
  free_.insert(free_.end(), leaving_.begin(), leaving_.end());
  leaving_.clear();
}

ObjectSlot ObjectTable::find(ObjectHandle handle) const {
  const std::uint32_t block = handle.value / object_block, number = handle.value % object_block;
  if (block >= slots_.size() || number >= slots_[block].size() || slots_[block][number] >= gone) return no_object;
  return slots_[block][number];
}

bool ObjectTable::was_registered(ObjectHandle handle) const {
  const std::uint32_t block = handle.value / object_block, number = handle.value % object_block;
  return block < slots_.size() && number < slots_[block].size() && slots_[block][number] != never;
}

void ObjectTable::store(ObjectSlot slot, AttributeSet set, Bytes values, const Stamp& stamp) {
  Object& object = objects_[slot];
  const Layout& layout = layouts_[object.object_class];
  const ObjectClass& object_class = fom_.object_classes()[object.object_class];
  for (std::uint32_t bits = set.bits; bits != 0; bits &= bits - 1) {
    const auto index = static_cast<std::size_t>(std::countr_zero(bits));
    std::size_t size = 0;
    if (const auto fixed_size = object_class.attributes[index].size) {
      size = *fixed_size;
      if (size != 0) std::memcpy(object.fixed.data() + layout.offsets[index], values.data(), size);
    } else {
      std::uint32_t length = 0;
      std::memcpy(&length, values.data(), sizeof length);
      size = sizeof length + length;
      object.varying[index].assign(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(size));
    }
    values = values.subspan(size);
  }
  object.valued = object.valued | set;
  object.stamp = stamp;
}

void ObjectTable::append(ObjectSlot slot, AttributeSet set, std::vector<std::byte>& bytes) const {
  const Object& object = objects_[slot];
  assert(object.valued.includes(set));
  const Layout& layout = layouts_[object.object_class];
  const ObjectClass& object_class = fom_.object_classes()[object.object_class];
  for (std::uint32_t bits = set.bits; bits != 0; bits &= bits - 1) {
    const auto index = static_cast<std::size_t>(std::countr_zero(bits));
    const auto fixed_size = object_class.attributes[index].size;
    const Bytes value = fixed_size ? Bytes(object.fixed).subspan(layout.offsets[index], *fixed_size) : Bytes(object.varying[index]);
    bytes.insert(bytes.end(), value.begin(), value.end());
  }
}

}  // namespace rink::rti
