// The order in which entities relevant to a subscriber are sent when not all fit.
#pragma once

#include <algorithm>
#include <cassert>
#include <cstdint>
#include <span>
#include <vector>

#include "im/composition/pair_lists.h"
#include "im/filter.h"
#include "im/matching/buffer.h"

namespace rink::im {

/// What was sent and what was not, in two classes: full states of entities that entered, and
/// updates of the others.
struct PriorityCounts {
  std::uint64_t states = 0, state_bytes = 0;
  std::uint64_t updates = 0, update_bytes = 0;
  std::uint64_t put_off = 0;  ///< that a fill had no room for
};

/// Entities that entered come first, then those with updates due; in each class the most urgent.
/// Urgency is the number of matches since it was last sent, or for a state on entry one more than
/// since it entered, divided by 1 + d / r with d the distance of the middles and r half the shorter
/// side of the subscription, and by 2^tier. It grows with every match, and where states and updates
/// are both due they come first in turns (by `fill`), so none starves. Ties are broken by entity.
class PriorityOrder {
 public:
  static constexpr std::size_t not_now = ~std::size_t{0};

  /// `budget` [bytes] is for one subscriber and match, and the sender must keep it; 0: none.
  explicit PriorityOrder(std::size_t budget = 0) : budget_(budget) {}
  std::size_t budget() const { return budget_; }

  struct Item {
    Entity entity;
    bool is_state;  ///< its whole state is due
  };

  /// All of them, the most urgent first. Valid until the next call of any member of this or its
  /// filter. Nothing is computed until it is asked for.
  std::span<const Item> order(Subscriber subscriber);
  /// Takes note that an item was sent in so many bytes.
  void sent(Subscriber subscriber, const Item& item, std::size_t bytes);

  /// Takes from the front of the order as long as `bytes_of(item)` fit into `budget`, and stops at
  /// the first that does not, so that large ones get their turn; one that alone exceeds the budget
  /// is taken alone. Notes them as sent. An item of 0 bytes has nothing due and counts as sent, in
  /// no list; one that is `not_now` goes on waiting, in no list either. Valid until the next call.
  template <class BytesOf>
  std::span<const Item> fill(Subscriber subscriber, std::size_t budget, const BytesOf& bytes_of);

  /// Those for which the last `fill` had no room, in no order. Valid until the next call.
  std::span<const Item> put_off() const { return put_off_.span(); }

  const PriorityCounts& counts() const { return counts_; }

  // Notices from its filter.
  void place_entity(Entity entity, const Region& region) { place(entities_, entity, region); }
  void place_subscriber(Subscriber subscriber, const Region& region) {
    place(subscribers_, subscriber, region);
  }
  void remove_entity(Entity entity) { entries_.remove_entity(entity); }
  void remove_subscriber(Subscriber subscriber) { entries_.remove_subscriber(subscriber); }
  void take(std::span<const Change> changes);
  /// Asserts that lists are in order, and that no item lacks a place or was sent in the future.
  void check() const;

 private:
  struct Entry {
    Entity entity;
    std::uint8_t tier;
    bool is_state;
    std::uint64_t sent;  ///< at which match
  };
  struct Ranked {
    double urgency;
    Item item;
    std::size_t bytes;
  };
  /// Where a subscriber is: half the middle of its region, and half its shorter side.
  struct Watch {
    double x, y, reach;
    explicit Watch(const Region& own);
  };
  static bool is_less_urgent(const Ranked& a, const Ranked& b) {
    return a.urgency != b.urgency ? a.urgency < b.urgency : a.item.entity > b.item.entity;
  }
  /// Into `ranked_`, states first, else in no order; returns how many states.
  template <class BytesOf>
  std::size_t rank(Subscriber subscriber, const BytesOf& bytes_of);
  double urgency(const Watch& watch, const Entry& entry) const;
  std::size_t gather_states();
  static void place(std::vector<Region>& places, std::uint32_t id, const Region& region);

  std::size_t budget_;
  std::uint64_t now_ = 0;
  std::vector<Region> entities_, subscribers_;
  PairLists<Entry> entries_;
  Buffer<Ranked> ranked_;
  Buffer<Item> items_, filled_, put_off_;
  PriorityCounts counts_;
};

template <class BytesOf>
std::size_t PriorityOrder::rank(Subscriber subscriber, const BytesOf& bytes_of) {
  ranked_.clear();
  if (subscriber >= entries_.size()) return 0;
  Buffer<Entry>& entries = entries_[subscriber];
  assert(entries.empty() || subscriber < subscribers_.size());
  if (entries.empty()) return 0;
  const Watch watch(subscribers_[subscriber]);
  for (std::size_t i = 0; i < entries.size(); ++i) {
    Entry& entry = entries.data()[i];
    const Item item{entry.entity, entry.is_state};
    const std::size_t bytes = bytes_of(item);
    if (bytes == not_now) continue;
    if (bytes > 0) ranked_.push_back({urgency(watch, entry), item, bytes});
    else entry.is_state = false, entry.sent = now_;
  }
  return gather_states();
}

/// Few of many fit, so they are taken from heaps and the rest is never sorted: 24 ms where sorting
/// took 42, for 1,000 subscribers who take 25 of 360 each.
template <class BytesOf>
std::span<const PriorityOrder::Item> PriorityOrder::fill(Subscriber subscriber, std::size_t budget,
                                                         const BytesOf& bytes_of) {
  filled_.clear();
  put_off_.clear();
  std::size_t used = 0;
  const std::size_t states = rank(subscriber, bytes_of);
  Ranked *const first_state = ranked_.data(), *const first_update = first_state + states,
                *const last = first_state + ranked_.size();
  const auto take = [&](Ranked* first, Ranked* end) {
    std::make_heap(first, end, is_less_urgent);
    for (; first != end && used < budget; --end) {
      if (used + first->bytes > budget && !filled_.empty()) break;
      used += first->bytes;
      filled_.push_back(first->item);
      sent(subscriber, first->item, first->bytes);
      std::pop_heap(first, end, is_less_urgent);
    }
    for (; first != end; ++first) put_off_.push_back(first->item);
  };
  const bool are_updates_first = now_ % 2 == 0;
  if (are_updates_first) take(first_update, last);
  take(first_state, first_update);
  if (!are_updates_first) take(first_update, last);
  assert(filled_.size() + put_off_.size() == ranked_.size());
  counts_.put_off += put_off_.size();
  return filled_.span();
}

}  // namespace rink::im
