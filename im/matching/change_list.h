// Pairs whose interest changed, gathered in any order and given out by (subscriber, entity).
#pragma once

#include <cstdint>
#include <span>

#include "im/filter.h"
#include "im/matching/buffer.h"
#include "im/matching/group_join.h"
#include "im/matching/join.h"

namespace rink::im {

class ChangeList {
 public:
  void clear() { keys_.clear(); }
  /// Adds all that subscribers found among entities.
  void add_by_subscriber(const Join& join);
  /// Adds all that entities found among subscribers.
  void add_by_entity(const Join& join);
  /// Adds from numbers whose high half is the asker, and whose low half is the found id with
  /// `entered_bit`.
  void add_by_subscriber(std::span<const std::uint64_t> found);
  void add_by_entity(std::span<const std::uint64_t> found);
  /// The changes that a group join found, of subscribers below `subscriber_count`; nothing was
  /// added. Valid until the next call.
  std::span<const Change> ordered(const GroupJoin& join, std::size_t subscriber_count);
  /// Orders the changes of subscribers below `subscriber_count`. A pair that is there twice entered
  /// and left, and is left out. Valid until the next call.
  std::span<const Change> ordered(std::size_t subscriber_count);
  /// Asserts that what was given out last is in order, each pair once.
  void check() const;

  std::size_t bytes() const {
    return sizeof(std::uint64_t) * (keys_.capacity() + sorted_.capacity()) +
           sizeof(std::uint32_t) * (starts_.capacity() + lows_.capacity() + spare_.capacity()) +
           sizeof(Change) * changes_.capacity();
  }

 private:
  void sort(std::size_t subscriber_count);
  void sort_run(std::uint64_t* first, std::uint64_t* end);
  void sort_by_digits();

  Buffer<std::uint64_t> keys_, sorted_;  // subscriber, entity, entered
  Buffer<std::uint32_t> starts_, lows_, spare_;
  Buffer<Change> changes_;
};

}  // namespace rink::im
