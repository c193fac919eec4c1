// Who of those that are relevant to a subscriber is to be sent first, when not all fit.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "im/filter.h"
#include "im/matching/buffer.h"

namespace rink::im {

/// What was sent, and what not, in two classes: the whole state of who entered, and updates of who was there.
struct PriorityCounts {
  std::uint64_t states = 0, state_bytes = 0;
  std::uint64_t updates = 0, update_bytes = 0;
  std::uint64_t put_off = 0;  ///< that a fill had no room for
};

/// Who entered comes first, the nearest before the others; then whose state is due: urgency is the number of matches since it was last sent, divided by 1 + d / r with d the
/// distance of the middles and r half the shorter side of the subscription, and by 2^tier. Urgency grows with every match, so nobody starves. Equals come by entity.
class PriorityOrder {
 public:
  struct Item {
    Entity entity;
    bool is_state;  ///< its whole state is due
  };

  /// All of them, the most urgent first. Valid until the next call of any member of this or its filter. Nothing is computed until it is asked for.
  std::span<const Item> order(Subscriber subscriber);
  /// Takes note that an item was sent in so many bytes.
  void sent(Subscriber subscriber, const Item& item, std::size_t bytes);

  /// Takes from the front of the order as long as `bytes_of(item)` fit into `budget`, and stops at the first that does not, so that large ones get their turn; one that alone
  /// exceeds the budget is taken alone. Notes them as sent. Valid until the next call.
  template <class BytesOf>
  std::span<const Item> fill(Subscriber subscriber, std::size_t budget, const BytesOf& bytes_of);

  const PriorityCounts& counts() const { return counts_; }

  // What its filter tells it.
  void place_entity(Entity entity, const Region& region) { place(entities_, entity, region); }
  void place_subscriber(Subscriber subscriber, const Region& region) { place(subscribers_, subscriber, region); }
  void remove_entity(Entity entity);
  void remove_subscriber(Subscriber subscriber);
  void take(std::span<const Change> changes);

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
  };
  static void place(std::vector<Region>& places, std::uint32_t id, const Region& region);
  Entry* find(Subscriber subscriber, Entity entity);

  std::uint64_t now_ = 0;
  std::vector<Region> entities_, subscribers_;
  std::vector<Buffer<Entry>> entries_;  // by subscriber, ascending
  Buffer<Ranked> ranked_;
  Buffer<Item> items_, filled_;
  PriorityCounts counts_;
};

template <class BytesOf>
std::span<const PriorityOrder::Item> PriorityOrder::fill(Subscriber subscriber, std::size_t budget, const BytesOf& bytes_of) {
  filled_.clear();
  std::size_t used = 0;
  const std::span<const Item> all = order(subscriber);
  for (const Item& item : all) {
    const std::size_t bytes = bytes_of(item);
    if (used + bytes > budget && !filled_.empty()) break;
    used += bytes;
    filled_.push_back(item);
    sent(subscriber, item, bytes);
    if (used >= budget) break;
  }
  counts_.put_off += all.size() - filled_.size();
  return filled_.span();
}

}  // namespace rink::im
