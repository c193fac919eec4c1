// The attributes of objects in a federate's scope whose newest values it has not been sent yet.
#pragma once

#include <bit>
#include <cstdint>
#include <vector>

#include "rti/objects/bitmap.h"
#include "rti/types.h"

namespace rink::rti {

/// Sets of objects by their numbers, 64 at once as in `Bitmap`: one bit for each object and each
/// attribute that was ever late. The object table has the values.
class LateStates {
 public:
  void put_off(std::size_t word, std::uint64_t objects, AttributeSet attributes) {
    if (objects == 0) return;
    any_.insert_word(word, objects);
    attributes.for_each([&](AttributeHandle each) {
      if (each.value >= by_attribute_.size()) by_attribute_.resize(each.value + std::size_t{1});
      by_attribute_[each.value].insert_word(word, objects);
    });
  }
  void sent(std::size_t word, std::uint64_t objects) {
    any_.erase_word(word, objects);
    for (Bitmap& each : by_attribute_) each.erase_word(word, objects);
  }
  void sent(std::uint32_t object) { sent(object / 64, std::uint64_t{1} << object % 64); }

  std::uint64_t any(std::size_t word) const { return any_.word(word); }
  std::size_t word_count() const { return any_.word_count(); }
  /// Objects with late attributes other than `attributes`.
  std::uint64_t beyond(std::size_t word, AttributeSet attributes) const {
    std::uint64_t objects = 0;
    for (std::uint32_t each = 0; each < by_attribute_.size(); ++each)
      if (!attributes.contains({each})) objects |= by_attribute_[each].word(word);
    return objects;
  }
  /// The late attributes of one object.
  AttributeSet of(std::uint32_t object) const {
    AttributeSet set;
    for (std::uint32_t each = 0; each < by_attribute_.size(); ++each)
      if (by_attribute_[each].contains(object)) set.insert({each});
    return set;
  }

 private:
  Bitmap any_;
  std::vector<Bitmap> by_attribute_;
};

}  // namespace rink::rti
