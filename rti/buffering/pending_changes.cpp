// Supersedes 64 objects at a time.
#include "rti/buffering/pending_changes.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace rink::rti {

void PendingChanges::add(std::span<const UpdateRun> runs) {
  for (const UpdateRun& run : runs) {
    supersede(run);
    Bitmap& objects = changes_[place_of(run.owner, run.attributes, run.stamp)].objects;
    for (std::size_t i = run.first_word; i <= run.last_word; ++i)
      objects.insert_word(i, run.members.word(i));
  }
}

/// Takes the run's attributes of its objects out of what was added before; other attributes that
/// were updated together with them stay.
void PendingChanges::supersede(const UpdateRun& run) {
  const std::size_t before = size_;
  for (std::size_t k = 0; k < before; ++k) {
    if (changes_[k].owner != run.owner || (changes_[k].attributes & run.attributes).is_empty())
      continue;
    const AttributeSet rest = changes_[k].attributes.without(run.attributes);
    for (std::size_t i = run.first_word; i <= run.last_word; ++i) {
      const std::uint64_t both = changes_[k].objects.word(i) & run.members.word(i);
      if (both == 0) continue;
      changes_[k].objects.erase_word(i, both);
      if (rest.is_empty()) continue;
      const Stamp stamp = changes_[k].stamp;  // a copy: a new place may move all of them
      const std::size_t place = place_of(run.owner, rest, stamp);
      changes_[place].objects.insert_word(i, both);
    }
  }
}

/// The change with these properties, which is empty if there was none.
std::size_t PendingChanges::place_of(std::uint32_t owner, AttributeSet attributes,
                                     const Stamp& stamp) {
  for (std::size_t k = size_; k > 0; --k) {
    const Change& change = changes_[k - 1];
    if (change.owner == owner && change.attributes == attributes && change.stamp == stamp)
      return k - 1;
  }
  if (size_ == changes_.size()) changes_.emplace_back();
  Change& change = changes_[size_];
  change.owner = owner;
  change.attributes = attributes;
  change.stamp = stamp;
  return size_++;
}

std::span<const UpdateRun> PendingChanges::seal(const ObjectTable& objects) {
  order_.resize(size_);
  std::iota(order_.begin(), order_.end(), std::size_t{0});
  std::ranges::sort(order_, [this](std::size_t a, std::size_t b) {
    return std::pair(changes_[a].stamp.time, a) < std::pair(changes_[b].stamp.time, b);
  });
  for (const std::size_t place : order_) {
    const Change& change = changes_[place];
    change.objects.for_each([&](ObjectSlot slot) {
      const Object& object = objects[slot];
      // A slot may have another object by now: whoever has that in scope is sent its full state.
      const AttributeSet attributes = change.attributes & object.valued;
      if (!object.is_alive || attributes.is_empty()) return;
      values_.clear();
      objects.append(slot, attributes, values_);
      runs_.append({.owner = change.owner,
                    .slot = slot,
                    .object = object,
                    .attributes = attributes,
                    .stamp = change.stamp,
                    .values = values_});
    });
  }
  runs_.seal();
  return runs_.runs();
}

void PendingChanges::clear() {
  for (std::size_t k = 0; k < size_; ++k) changes_[k].objects.clear();
  size_ = 0;
  runs_.clear();
}

}  // namespace rink::rti
