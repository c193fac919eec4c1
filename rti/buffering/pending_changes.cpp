// Supersedes 64 objects at a time.
#include "rti/buffering/pending_changes.h"

#include <algorithm>
#include <utility>

namespace rink::rti {

void PendingChanges::add(std::span<const UpdateRun> runs) {
  if (runs.empty()) return;
  ++flush_number_;
  for (const UpdateRun& run : runs) {
    supersede(run);
    Change& change = place_of({.flush = flush_number_,
                               .owner = run.owner,
                               .attributes = run.attributes,
                               .stamp = run.stamp,
                               .objects = {}});
    for (std::size_t i = run.first_word; i <= run.last_word; ++i)
      change.objects.insert_word(i, run.members.word(i));
    change.first_word = std::min(change.first_word, run.first_word);
    change.end_word = std::max(change.end_word, run.last_word + 1);
  }
  // Where everything changes at every flush, all but the newest are empty now.
  keep_if([](const Change& change) { return change.first_word < change.end_word; });
}

/// Takes the run's attributes of its objects out of what was added before; other attributes that
/// were updated together with them stay.
void PendingChanges::supersede(const UpdateRun& run) {
  const std::size_t before = size_;
  for (std::size_t k = 0; k < before; ++k) {
    if (changes_[k].owner != run.owner || (changes_[k].attributes & run.attributes).is_empty())
      continue;
    const AttributeSet rest = changes_[k].attributes.without(run.attributes);
    const std::size_t end = std::min(run.last_word + 1, changes_[k].end_word);
    for (std::size_t i = std::max(run.first_word, changes_[k].first_word); i < end; ++i) {
      const std::uint64_t both = changes_[k].objects.word(i) & run.members.word(i);
      if (both == 0) continue;
      changes_[k].objects.erase_word(i, both);
      if (rest.is_empty()) continue;
      Change like{.flush = changes_[k].flush,
                  .owner = run.owner,
                  .attributes = rest,
                  .stamp = changes_[k].stamp,
                  .objects = {}};  // a copy: a new place may move all of them
      Change& left = place_of(like);
      left.objects.insert_word(i, both);
      left.first_word = std::min(left.first_word, i);
      left.end_word = std::max(left.end_word, i + 1);
    }
    Change& cut = changes_[k];
    while (cut.first_word < cut.end_word && cut.objects.word(cut.first_word) == 0) ++cut.first_word;
    while (cut.first_word < cut.end_word && cut.objects.word(cut.end_word - 1) == 0) --cut.end_word;
  }
}

/// The change with these properties, which is empty if there was none.
PendingChanges::Change& PendingChanges::place_of(const Change& like) {
  for (std::size_t k = size_; k > 0; --k) {
    Change& change = changes_[k - 1];
    if (change.flush == like.flush && change.owner == like.owner &&
        change.attributes == like.attributes && change.stamp == like.stamp)
      return change;
  }
  if (size_ == changes_.size()) changes_.emplace_back();
  Change& change = changes_[size_++];
  change.flush = like.flush;
  change.owner = like.owner;
  change.attributes = like.attributes;
  change.stamp = like.stamp;
  change.first_word = static_cast<std::size_t>(-1);
  change.end_word = 0;
  return change;
}

std::span<const UpdateRun> PendingChanges::seal(const ObjectTable& objects, std::uint64_t since) {
  runs_.clear();
  order_.clear();
  for (std::size_t k = 0; k < size_; ++k)
    if (changes_[k].flush > since) order_.push_back(k);
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

void PendingChanges::list_objects(std::uint64_t since, Bitmap& objects) const {
  for (std::size_t k = 0; k < size_; ++k)
    if (changes_[k].flush > since)
      for (std::size_t i = changes_[k].first_word; i < changes_[k].end_word; ++i)
        objects.insert_word(i, changes_[k].objects.word(i));
}

void PendingChanges::forget(std::uint64_t until) {
  keep_if([until](const Change& change) { return change.flush > until; });
}

/// Keeps the order of the others, and the memory of all.
template <class IsKept>
void PendingChanges::keep_if(IsKept is_kept) {
  std::size_t kept = 0;
  for (std::size_t k = 0; k < size_; ++k) {
    if (!is_kept(changes_[k])) changes_[k].objects.clear();
    else if (const std::size_t to = kept++; to != k) std::swap(changes_[to], changes_[k]);
  }
  size_ = kept;
}

}  // namespace rink::rti
