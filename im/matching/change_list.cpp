// Orders changes by counting sort over subscribers, few of them by comparison.
#include "im/matching/change_list.h"

#include <algorithm>
#include <bit>
#include <cassert>

#include "im/basics/checked.h"
#include "im/matching/short_sort.h"

namespace rink::im {
namespace {

/// Of the counts of so many values most stay in the first-level cache.
constexpr unsigned digit_bits_max = 12;

/// The last bit is the transition: it does not decide the order of pairs.
std::uint64_t key(std::uint32_t subscriber, std::uint32_t entity, bool is_entered) {
  assert((entity & entered_bit) == 0 && (subscriber & entered_bit) == 0);
  return std::uint64_t{subscriber} << 32 | entity << 1 | (is_entered ? 1u : 0u);
}

Change change(std::uint64_t key) {
  return {static_cast<Subscriber>(key >> 32), static_cast<Entity>(key) >> 1,
          (key & 1u) != 0 ? Transition::entered : Transition::left};
}

}  // namespace

/// Keys of one subscriber differ in their low halves alone.
void ChangeList::sort_run(std::uint64_t* first, std::uint64_t* end) {
  if (end - first < 2) return;
  const std::uint64_t subscriber = *first >> 32 << 32;
  const auto count = static_cast<std::size_t>(end - first);
  lows_.resize(count);
  for (std::size_t i = 0; i < count; ++i) lows_[i] = static_cast<std::uint32_t>(first[i]);
  sort_short({lows_.data(), count}, spare_);
  for (std::size_t i = 0; i < count; ++i) first[i] = subscriber | lows_[i];
}

void ChangeList::add_by_subscriber(const Join& join) {
  std::size_t count = keys_.size();
  keys_.resize(count + join.found_count());
  for (std::size_t i = 0; i < join.asker_count(); ++i) {
    const std::size_t first = count;
    for (const std::uint32_t found : join.found(i))
      keys_[count++] = key(join.asker(i), found & ~entered_bit, (found & entered_bit) != 0);
    sort_run(keys_.data() + first, keys_.data() + count);
  }
  assert(count == keys_.size());  // every answer has an asker
}

void ChangeList::add_by_entity(const Join& join) {
  std::size_t count = keys_.size();
  keys_.resize(count + join.found_count());
  for (std::size_t i = 0; i < join.asker_count(); ++i)
    for (const std::uint32_t found : join.found(i))
      keys_[count++] = key(found & ~entered_bit, join.asker(i), (found & entered_bit) != 0);
  assert(count == keys_.size());
}

void ChangeList::add_by_subscriber(std::span<const std::uint64_t> found) {
  for (const std::uint64_t pair : found)
    keys_.push_back(key(static_cast<std::uint32_t>(pair >> 32),
                        static_cast<std::uint32_t>(pair) & ~entered_bit,
                        (pair & entered_bit) != 0));
}

void ChangeList::add_by_entity(std::span<const std::uint64_t> found) {
  for (const std::uint64_t pair : found)
    keys_.push_back(key(static_cast<std::uint32_t>(pair) & ~entered_bit,
                        static_cast<std::uint32_t>(pair >> 32), (pair & entered_bit) != 0));
}

/// From the last digit to the first. Above the highest bits that differ nothing is looked at, and
/// digits are as wide as makes the fewest steps: over the keys twice for each digit, over its
/// values once.
void ChangeList::sort_by_digits() {
  assert(!keys_.empty());
  std::uint64_t varying = 0;
  for (const std::uint64_t key : keys_.span()) varying |= key ^ keys_[0];
  const auto low_bits = static_cast<unsigned>(std::bit_width(varying & 0xFFFFFFFFu)),
             bits = low_bits + static_cast<unsigned>(std::bit_width(varying >> 32));
  const auto digit_count = [&](unsigned width) { return (bits + width - 1) / width; };
  const auto steps = [&](unsigned width) {
    return digit_count(width) * (2 * keys_.size() + (std::size_t{1} << width));
  };
  unsigned width = 4;
  for (unsigned wider = 5; wider <= digit_bits_max; ++wider)
    if (steps(wider) < steps(width)) width = wider;
  // The bits of the entity and, next to them, those of the subscriber.
  const std::uint64_t mask = (std::uint64_t{1} << width) - 1,
                      low_mask = (std::uint64_t{1} << low_bits) - 1;
  const auto digit = [=](std::uint64_t key, unsigned shift) {
    return ((key >> 32 << low_bits) | (key & low_mask)) >> shift & mask;
  };
  sorted_.resize(keys_.size());
  for (unsigned shift = 0; shift < bits; shift += width) {
    starts_.fill(mask + 2, 0);
    for (const std::uint64_t key : keys_.span()) ++starts_[digit(key, shift) + 1];
    for (std::size_t i = 1; i <= mask; ++i) starts_[i] += starts_[i - 1];
    for (const std::uint64_t key : keys_.span()) sorted_[starts_[digit(key, shift)]++] = key;
    std::swap(keys_, sorted_);
  }
}

void ChangeList::sort(std::size_t subscriber_count) {
  if (std::is_sorted(keys_.data(), keys_.data() + keys_.size())) return;
  if (keys_.size() < 64) return std::sort(keys_.data(), keys_.data() + keys_.size());
  // Below this, going over all subscribers takes longer.
  if (keys_.size() < subscriber_count) return sort_by_digits();
  starts_.fill(subscriber_count + 1, 0);
  for (const std::uint64_t key : keys_.span()) ++starts_[(key >> 32) + 1];
  for (std::size_t i = 1; i <= subscriber_count; ++i) starts_[i] += starts_[i - 1];
  assert(starts_[subscriber_count] == keys_.size());
  sorted_.resize(keys_.size());
  // Afterwards a start is where its run ends. Runs from one join are in order already.
  for (const std::uint64_t key : keys_.span()) sorted_[starts_[key >> 32]++] = key;
  for (std::size_t i = 0, first = 0; i < subscriber_count; first = starts_[i++])
    sort_run(sorted_.data() + first, sorted_.data() + starts_[i]);
  std::swap(keys_, sorted_);
}

/// Each subscriber's are in order, and in one place.
std::span<const Change> ChangeList::ordered(const GroupJoin& join, std::size_t subscriber_count) {
  assert(keys_.empty());
  starts_.fill(subscriber_count + 1, 0);
  join.for_each_asker([this](std::uint32_t asker, std::span<const std::uint32_t> found) {
    starts_[asker + 1] = static_cast<std::uint32_t>(found.size());
  });
  for (std::size_t i = 1; i <= subscriber_count; ++i) starts_[i] += starts_[i - 1];
  assert(starts_[subscriber_count] == join.found_count());
  changes_.resize(join.found_count());
  join.for_each_asker([this](std::uint32_t asker, std::span<const std::uint32_t> found) {
    Change* out = changes_.data() + starts_[asker];
    for (const std::uint32_t each : found)
      *out++ = {asker, each >> 1, (each & 1u) != 0 ? Transition::entered : Transition::left};
  });
  if constexpr (checks_whole_structures) check();
  return changes_.span();
}

std::span<const Change> ChangeList::ordered(std::size_t subscriber_count) {
  sort(subscriber_count);
  assert(keys_.empty() || keys_[keys_.size() - 1] >> 32 < subscriber_count);
  changes_.resize(keys_.size());
  std::size_t count = 0;
  for (std::size_t i = 0; i < keys_.size(); ++i) {
    changes_[count++] = change(keys_[i]);
    if (i > 0 && (keys_[i] ^ keys_[i - 1]) == 1) count -= 2;
  }
  changes_.resize(count);
  if constexpr (checks_whole_structures) check();
  return changes_.span();
}

void ChangeList::check() const {
  assert(std::is_sorted(keys_.data(), keys_.data() + keys_.size()));
  assert(keys_.empty() ||
         (changes_.size() <= keys_.size() && (keys_.size() - changes_.size()) % 2 == 0));
  for (std::size_t i = 1; i < changes_.size(); ++i)
    assert(changes_[i - 1].subscriber < changes_[i].subscriber ||
           (changes_[i - 1].subscriber == changes_[i].subscriber &&
            changes_[i - 1].entity < changes_[i].entity));
}

}  // namespace rink::im
