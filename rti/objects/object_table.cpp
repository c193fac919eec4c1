// Slots, handles and latest values.
#include "rti/objects/object_table.h"

#include <cassert>
#include <cstring>

#include "rti/wire/message.h"

namespace rink::rti {

namespace {

/// True if all values take the same number of bytes on their way.
bool is_fixed(const Attribute& attribute) { return attribute.size && !attribute.codec; }

}  // namespace

ObjectTable::ObjectTable(const Fom& fom) : fom_(fom) {
  for (const ObjectClass& each : fom.object_classes()) {
    Layout& layout = layouts_.emplace_back();
    for (const Attribute& attribute : each.attributes) {
      layout.offsets.push_back(layout.fixed_size);
      const std::optional<std::uint32_t> size = is_fixed(attribute) ? attribute.size : std::nullopt;
      layout.fixed_size += size.value_or(0);
      layout.has_varying |= !size;
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

void ObjectTable::store(ObjectSlot slot, AttributeSet set, Bytes coded) {
  Object& object = objects_[slot];
  const Layout& layout = layouts_[object.object_class];
  const ObjectClass& object_class = fom_.object_classes()[object.object_class];
  for (std::uint32_t bits = set.bits; bits != 0; bits &= bits - 1) {
    const auto index = static_cast<std::uint32_t>(std::countr_zero(bits));
    const Attribute& attribute = object_class.attributes[index];
    std::size_t size = 0;
    if (is_fixed(attribute)) {
      size = *attribute.size;
      if (size != 0) std::memcpy(object.fixed.data() + layout.offsets[index], coded.data(), size);
    } else {
      const AttributeSet one(1u << index);
      size = bits == one.bits ? coded.size() : coded_size(object_class, one, coded).value_or(0);  // the last one takes the rest
      object.varying[index].assign(coded.begin(), coded.begin() + static_cast<std::ptrdiff_t>(size));
    }
    coded = coded.subspan(size);
  }
  object.valued = object.valued | set;
}

void ObjectTable::append(ObjectSlot slot, AttributeSet set, std::vector<std::byte>& bytes) const {
  const Object& object = objects_[slot];
  assert(object.valued.includes(set));
  const Layout& layout = layouts_[object.object_class];
  const ObjectClass& object_class = fom_.object_classes()[object.object_class];
  for (std::uint32_t bits = set.bits; bits != 0; bits &= bits - 1) {
    const auto index = static_cast<std::size_t>(std::countr_zero(bits));
    const Attribute& attribute = object_class.attributes[index];
    const Bytes value = is_fixed(attribute) ? Bytes(object.fixed).subspan(layout.offsets[index], *attribute.size) : Bytes(object.varying[index]);
    bytes.insert(bytes.end(), value.begin(), value.end());
  }
}

}  // namespace rink::rti
