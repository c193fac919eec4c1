// Slots, handles and latest values.
#include "rti/objects/object_table.h"

#include <cassert>
#include <cstring>

#include "im/basics/checked.h"
#include "rti/fom/coded_values.h"
#include "rti/wire/message.h"

namespace rink::rti {

namespace {

/// True if all values take the same number of bytes on their way.
bool is_fixed(const Attribute& attribute) { return attribute.size && !attribute.codec; }

}  // namespace

ObjectTable::ObjectTable(const Fom& fom) : fom_(fom) {
  classes_.resize(fom.object_classes().size());
  for (const ObjectClass& each : fom.object_classes()) {
    Layout& layout = layouts_.emplace_back();
    for (const Attribute& attribute : each.attributes) {
      layout.offsets.push_back(layout.fixed_size);
      const std::optional<std::uint32_t> size = is_fixed(attribute) ? attribute.size : std::nullopt;
      layout.fixed_size += size.value_or(0);
      layout.has_varying |= !size;
      if (attribute.is_static)
        layout.statics.insert({static_cast<std::uint32_t>(layout.offsets.size() - 1)});
    }
  }
}

ObjectSlot ObjectTable::insert(ObjectHandle handle, std::uint32_t owner, std::uint16_t object_class,
                               std::string_view name) {
  assert(handle && !was_registered(handle));  // handles are not used twice
  assert(object_class < layouts_.size());
  ObjectSlot slot = slot_count();
  if (free_.empty()) {
    objects_.emplace_back();
  } else {
    slot = free_.back();
    free_.pop_back();
  }
  Object& object = objects_[slot];
  assert(!object.is_alive && object.negotiation == Object::no_negotiation);
  object.handle = handle;
  object.owner = owner;
  object.object_class = object_class;
  object.is_alive = true;
  object.name = name;
  object.fixed.resize(layouts_[object_class].fixed_size);
  if (layouts_[object_class].has_varying)
    object.varying.resize(layouts_[object_class].offsets.size());
  const std::uint32_t number = handle.value % object_block;
  Block& block = block_of(handle);
  if (number >= block.slots.size()) block.slots.resize(number + 1, no_object);
  block.slots[number] = slot;
  block.registered = number + 1;
  ++block.alive;
  ++size_;
  classes_[object_class].slots.insert(slot);
  ++classes_[object_class].count;
  return slot;
}

void ObjectTable::erase(ObjectSlot slot) {
  assert(slot < slot_count());
  Object& object = objects_[slot];
  assert(object.is_alive);
  object.is_alive = false;
  Block& block = block_of(object.handle);
  assert(find(object.handle) == slot && block.alive > 0);
  block.slots[object.handle.value % object_block] = no_object;
  if (--block.alive == 0 && block.is_closed) block.slots = {};
  leaving_.push_back(slot);
  --size_;
  classes_[object.object_class].slots.erase(slot);
  --classes_[object.object_class].count;
}

ObjectTable::Block& ObjectTable::block_of(ObjectHandle handle) {
  const std::size_t block = handle.value / object_block;
  if (block >= blocks_.size()) blocks_.resize(block + 1);
  return blocks_[block];
}

void ObjectTable::pass_over(ObjectHandle handle) {
  block_of(handle).registered = handle.value % object_block + 1;
}

void ObjectTable::close_block(std::uint32_t block) {
  if (block >= blocks_.size()) return;
  blocks_[block].is_closed = true;
  if (blocks_[block].alive == 0) blocks_[block].slots = {};
}

void ObjectTable::recycle() {
  for (const ObjectSlot slot : leaving_) objects_[slot] = {};  // with its name and values
  free_.insert(free_.end(), leaving_.begin(), leaving_.end());
  leaving_.clear();
  if constexpr (checks_whole_structures) check();
}

void ObjectTable::check() const {
  [[maybe_unused]] std::size_t alive = 0;
  for (ObjectSlot slot = 0; slot < slot_count(); ++slot) {
    if (!objects_[slot].is_alive) continue;
    ++alive;
    assert(find(objects_[slot].handle) == slot);
    assert(objects_[slot].object_class < layouts_.size());
    assert(of_class(objects_[slot].object_class).contains(slot));
  }
  [[maybe_unused]] std::size_t of_classes = 0;
  for (const Members& each : classes_) of_classes += each.count;
  assert(of_classes == alive);
  assert(alive == size_ && alive + free_.size() + leaving_.size() == objects_.size());
  for (const Block& block : blocks_) {
    [[maybe_unused]] std::size_t in_block = 0;
    for (const ObjectSlot slot : block.slots) in_block += slot != no_object ? 1u : 0u;
    assert(in_block == block.alive && block.registered <= object_block);
    assert(block.slots.size() <= block.registered);
  }
  for ([[maybe_unused]] const ObjectSlot slot : free_)
    assert(!objects_[slot].is_alive && objects_[slot].valued.is_empty());
}

ObjectSlot ObjectTable::find(ObjectHandle handle) const {
  const std::uint32_t block = handle.value / object_block, number = handle.value % object_block;
  return block < blocks_.size() && number < blocks_[block].slots.size()
             ? blocks_[block].slots[number]
             : no_object;
}

bool ObjectTable::was_registered(ObjectHandle handle) const {
  const std::uint32_t block = handle.value / object_block, number = handle.value % object_block;
  return block < blocks_.size() && number < blocks_[block].registered;
}

void ObjectTable::store(ObjectSlot slot, AttributeSet set, Bytes coded) {
  assert(slot < slot_count());
  Object& object = objects_[slot];
  const Layout& layout = layouts_[object.object_class];
  const ObjectClass& object_class = fom_.object_classes()[object.object_class];
  for (auto next = set.begin(); next != set.end();) {
    const AttributeHandle each = *next;
    const std::uint32_t index = each.value;
    ++next;
    const Attribute& attribute = object_class.attributes[index];
    std::size_t size = 0;
    if (is_fixed(attribute)) {
      size = *attribute.size;
      assert(size <= coded.size());
      if (size != 0) std::memcpy(object.fixed.data() + layout.offsets[index], coded.data(), size);
    } else {
      const AttributeSet one{each};
      size = next == set.end()
                 ? coded.size()
                 : coded_size(object_class, one, coded).value_or(0);  // the last one takes the rest
      object.varying[index].assign(coded.begin(),
                                   coded.begin() + static_cast<std::ptrdiff_t>(size));
    }
    coded = coded.subspan(size);
  }
  assert(coded.empty());
  object.changed_static = object.changed_static | (set & object.valued & layout.statics);
  object.valued = object.valued | set;
}

std::size_t ObjectTable::size_of(ObjectSlot slot, AttributeSet set) const {
  assert(slot < slot_count());
  const Object& object = objects_[slot];
  std::size_t size = 0;
  set.for_each([&](AttributeHandle each) {
    const Attribute& attribute = fom_.object_classes()[object.object_class].attributes[each.value];
    size += is_fixed(attribute) ? *attribute.size : object.varying[each.value].size();
  });
  return size;
}

Bytes ObjectTable::value(ObjectSlot slot, AttributeHandle attribute) const {
  const Object& object = objects_[slot];
  const std::size_t index = attribute.value;
  const Attribute& declared = fom_.object_classes()[object.object_class].attributes[index];
  if (!is_fixed(declared)) return object.varying[index];
  return Bytes(object.fixed).subspan(layouts_[object.object_class].offsets[index], *declared.size);
}

void ObjectTable::append(ObjectSlot slot, AttributeSet set, std::vector<std::byte>& bytes) const {
  assert(objects_[slot].valued.includes(set));
  for (const AttributeHandle each : set) {
    const Bytes one = value(slot, each);
    bytes.insert(bytes.end(), one.begin(), one.end());
  }
}

}  // namespace rink::rti
