// What a stage keeps of each pair: a list per subscriber, by entity.
#pragma once

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <vector>

#include "im/filter.h"
#include "im/matching/buffer.h"

namespace rink::im {

/// `Entry` is a plain struct with a member `entity`. The entries of a subscriber ascend by it.
/// Removing an entity looks at the list of every subscriber.
template <class Entry>
class PairLists {
 public:
  using List = Buffer<Entry>;

  /// Subscribers from 0 up to this have lists.
  std::size_t size() const { return lists_.size(); }
  List& operator[](Subscriber subscriber) {
    assert(subscriber < lists_.size());
    return lists_[subscriber];
  }
  /// That of `subscriber`, made if there is none yet.
  List& list_of(Subscriber subscriber) {
    if (subscriber >= lists_.size()) lists_.resize(subscriber + std::size_t{1});
    return lists_[subscriber];
  }

  /// Null if there is none. Valid until the list changes.
  static Entry* find(List& list, Entity entity) {
    Entry* const place = place_of(list, entity);
    return place != list.data() + list.size() && place->entity == entity ? place : nullptr;
  }
  Entry* find(Subscriber subscriber, Entity entity) {
    return subscriber < lists_.size() ? find(lists_[subscriber], entity) : nullptr;
  }
  /// `entry` is of an entity that `list` does not have.
  static void insert(List& list, const Entry& entry) {
    const auto at = static_cast<std::size_t>(place_of(list, entry.entity) - list.data()),
               count = list.size();
    assert(at == count || list[at].entity != entry.entity);
    list.push_back(entry);
    std::copy_backward(list.data() + at, list.data() + count, list.data() + count + 1);
    list[at] = entry;
  }
  /// `entry` is in `list`.
  static void erase(List& list, Entry* entry) {
    assert(list.data() <= entry && entry < list.data() + list.size());
    std::copy(entry + 1, list.data() + list.size(), entry);
    list.resize(list.size() - 1);
  }

  /// Of an entity that the list of `subscriber` may lack.
  void erase(Subscriber subscriber, Entity entity) {
    if (Entry* const entry = find(subscriber, entity)) erase(lists_[subscriber], entry);
  }

  void remove_entity(Entity entity) {
    for (List& list : lists_)
      if (Entry* const entry = find(list, entity)) erase(list, entry);
  }
  void remove_subscriber(Subscriber subscriber) {
    if (subscriber < lists_.size()) lists_[subscriber].clear();
  }

  /// Asserts that entries ascend and that each `is_sound`.
  template <class IsSound>
  void check([[maybe_unused]] const IsSound& is_sound) const {
    for (const List& list : lists_)
      for (std::size_t i = 0; i < list.size(); ++i) {
        assert(i == 0 || list[i - 1].entity < list[i].entity);
        assert(is_sound(list[i]));
      }
  }

 private:
  static Entry* place_of(List& list, Entity entity) {
    return std::lower_bound(list.data(), list.data() + list.size(), entity,
                            [](const Entry& entry, Entity id) { return entry.entity < id; });
  }

  std::vector<List> lists_;
};

}  // namespace rink::im
