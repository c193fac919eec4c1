// How objects enter a federate's records and leave them.
#include "rti/federate/books/object_book.h"

#include <algorithm>
#include <utility>

namespace rink::rti {

bool ObjectBook::add_block(std::uint32_t block) {
  if (further_block_ || block == block_) return false;
  further_block_ = block;
  return true;
}

bool ObjectBook::is_in_former_block(ObjectHandle object) const {
  return std::ranges::find(former_blocks_, object.value / object_block) != former_blocks_.end();
}

bool ObjectBook::is_gone(ObjectHandle object) const {
  if (is_ours(object)) return object.value % object_block < registered_count_;
  return is_in_former_block(object) || others_.find(object) != nullptr ||
         std::ranges::find(gone_, object, &GoneObject::object) != gone_.end();
}

/// Only the objects left of the used block are kept, so memory follows their number.
void ObjectBook::begin_further_block() {
  for (std::uint32_t number = 0; number < own_.size(); ++number)
    if (own_[number].object_class != KnownObject::unknown) others_[handle(number)] = own_[number];
  own_.clear();
  former_blocks_.push_back(block_);
  block_ = *std::exchange(further_block_, std::nullopt);
  registered_count_ = 0;
}

ObjectHandle ObjectBook::add(ObjectClassHandle object_class) {
  assert(has_handle() && object_class.value < KnownObject::unknown);
  if (registered_count_ == object_block) begin_further_block();
  own_.push_back({static_cast<std::uint16_t>(object_class.value), true});
  const ObjectHandle object = handle(registered_count_++);
  assert(own_.size() == registered_count_ && find(object) != nullptr);
  return object;
}

bool ObjectBook::discover(ObjectHandle object, ObjectClassHandle object_class) {
  assert(object_class.value < KnownObject::unknown);
  if (!object || was_registered_here(object) || others_.find(object) != nullptr) return false;
  std::erase_if(gone_, [object](const GoneObject& each) { return each.object == object; });
  others_[object] = {static_cast<std::uint16_t>(object_class.value), false};
  return true;
}

/// The place of an object that is known or hidden; nothing moves.
KnownObject& ObjectBook::place_of(ObjectHandle object) {
  if (!is_ours(object)) {
    KnownObject* known = others_.find(object);
    assert(known != nullptr);
    return *known;
  }
  assert(object.value % object_block < own_.size());
  return own_[object.value % object_block];
}

void ObjectBook::remove(ObjectHandle object) {
  if (is_ours(object)) own_[object.value % object_block] = {};
  else others_.erase(object);
  assert(find(object) == nullptr);
}

void ObjectBook::leave(ObjectHandle object) {
  assert(find(object) != nullptr);
  remove(object);
  if (!was_registered_here(object)) gone_.push_back({object});
  assert(is_gone(object));
}

void ObjectBook::settle_gone(ObjectHandle object) {
  for (GoneObject& each : gone_)
    if (each.object == object) each.is_settled = true;
}

void ObjectBook::sweep() {
  if (!gone_.empty()) std::erase_if(gone_, [](const GoneObject& each) { return each.is_settled; });
}

KnownObject ObjectBook::hide(ObjectHandle object) {
  assert(find(object) != nullptr);
  return std::exchange(place_of(object), KnownObject{});
}

void ObjectBook::restore(ObjectHandle object, const KnownObject& known) {
  if (is_ours(object)) place_of(object) = known;
  else others_[object] = known;  // its block may be used up by now
}

std::size_t ObjectBook::memory_bytes() const {
  return own_.capacity() * sizeof own_[0] + others_.memory_bytes() +
         gone_.capacity() * sizeof gone_[0] + former_blocks_.capacity() * sizeof former_blocks_[0];
}

bool ObjectBook::is_sound() const {
  bool is_sound = block_ < object_block_max && registered_count_ <= object_block &&
                  own_.size() == registered_count_ &&
                  (!further_block_ || *further_block_ < object_block_max);
  others_.for_each([&](ObjectHandle each, const KnownObject&) { is_sound &= !is_ours(each); });
  return is_sound;
}

}  // namespace rink::rti
