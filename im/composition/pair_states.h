// The last decisions of several filters about each pair, and the resulting level.
#pragma once

#include <algorithm>
#include <cassert>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "im/basics/checked.h"
#include "im/composition/pair_lists.h"
#include "im/filter.h"
#include "im/matching/buffer.h"

namespace rink::im {

/// Keeps the pairs that some filter holds relevant, 8 bytes each, and evaluates only those again
/// about which a filter's decision changed.
class PairStates {
 public:
  /// Bit k: filter k holds the pair relevant.
  using Decisions = std::uint16_t;
  static constexpr std::size_t filter_max = 16;
  /// 0: irrelevant; else 1 + tier.
  using Level = std::uint16_t;

  /// Forget the pairs of an id. Removing an entity looks at the list of every subscriber.
  void remove_entity(Entity entity) { entries_.remove_entity(entity); }
  void remove_subscriber(Subscriber subscriber) { entries_.remove_subscriber(subscriber); }
  /// Have all pairs of an id evaluated again. Touching an entity looks at the list of every
  /// subscriber.
  void touch_entity(Entity entity);
  void touch_subscriber(Subscriber subscriber);

  /// Takes the changes of filter `k` at this match; to be called for each of them before `review`.
  void take(std::size_t k, std::span<const Change> changes);
  /// Asks `decide(subscriber, entity, decisions, was)` for the level of each pair about which
  /// something was taken, and appends what changed to `changes`, ordered. Returns how many it asked
  /// about.
  template <class Decide>
  std::size_t review(const Decide& decide, Buffer<Change>& changes);
  /// Asserts that lists are in order and keep no pair that no filter holds relevant.
  void check() const;

 private:
  struct Entry {
    Entity entity;
    Decisions decisions;
    Level level;
  };
  struct News {
    Subscriber subscriber;
    Entity entity;
    Decisions on, off;
  };
  static bool is_before(const News& a, const News& b) {
    return a.subscriber != b.subscriber ? a.subscriber < b.subscriber : a.entity < b.entity;
  }
  void join_news();
  template <class Decide>
  void look(const News& news, Entry entry, const Decide& decide, Buffer<Change>& changes);

  PairLists<Entry> entries_;
  Buffer<News> news_;
  Buffer<Entry> merged_;
};

template <class Decide>
void PairStates::look(const News& news, Entry entry, const Decide& decide,
                      Buffer<Change>& changes) {
  const Level was = entry.level;
  // A filter reports changes only: no pair enters twice, or leaves without having entered.
  assert((entry.decisions & news.on) == 0 && (news.off & ~entry.decisions) == 0);
  entry.decisions = static_cast<Decisions>((entry.decisions | news.on) & ~news.off);
  entry.level = decide(news.subscriber, news.entity, entry.decisions, was);
  assert(entry.level <= filter_max);
  const auto tier = static_cast<std::uint8_t>(entry.level == 0 ? 0 : entry.level - 1);
  if ((was == 0) != (entry.level == 0))
    changes.push_back(
        {news.subscriber, news.entity, was == 0 ? Transition::entered : Transition::left, tier});
  else if (was != entry.level)
    changes.push_back({news.subscriber, news.entity, Transition::tier_changed, tier});
  if (entry.decisions != 0 || entry.level != 0) merged_.push_back(entry);
}

template <class Decide>
std::size_t PairStates::review(const Decide& decide, Buffer<Change>& changes) {
  join_news();
  for (std::size_t next = 0; next < news_.size();) {
    const Subscriber subscriber = news_[next].subscriber;
    Buffer<Entry>& entries = entries_.list_of(subscriber);
    merged_.clear();
    std::size_t i = 0;
    for (; next < news_.size() && news_[next].subscriber == subscriber; ++next) {
      const News& news = news_[next];
      for (; i < entries.size() && entries[i].entity < news.entity; ++i)
        merged_.push_back(entries[i]);
      const bool is_known = i < entries.size() && entries[i].entity == news.entity;
      look(news, is_known ? entries[i++] : Entry{news.entity, 0, 0}, decide, changes);
    }
    for (; i < entries.size(); ++i) merged_.push_back(entries[i]);
    entries.resize(merged_.size());
    std::copy_n(merged_.data(), merged_.size(), entries.data());
  }
  const std::size_t count = news_.size();
  news_.clear();
  if constexpr (checks_whole_structures) check();
  return count;
}

}  // namespace rink::im
