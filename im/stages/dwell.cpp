// The stage `dwell`: a pair that became relevant stays so for some matches at least.
#include <algorithm>
#include <cassert>

#include "im/basics/checked.h"
#include "im/composition/pair_lists.h"
#include "im/composition/parts.h"
#include "im/stages/stages.h"

namespace rink::im {
namespace {

/// Matches are counted; a pair that would leave too early is kept on a list of those due at the
/// match at which it may.
class Dwell final : public Parts {
 public:
  Dwell(std::unique_ptr<Filter> inner, std::uint32_t matches)
      : Parts(std::move(inner)), matches_(matches), due_(matches + std::size_t{1}) {
    assert(matches_ >= 1);
  }

  void remove_entity(Entity entity) override {
    Parts::remove_entity(entity);
    entries_.remove_entity(entity);
  }
  void remove_subscriber(Subscriber subscriber) override {
    Parts::remove_subscriber(subscriber);
    entries_.remove_subscriber(subscriber);
  }
  std::span<const Change> match() override {
    ++now_;
    changes_.clear();
    for (const Change& change : parts_.front()->match()) take(change);
    release();
    if constexpr (checks_whole_structures) check();
    return reported(changes_.span());
  }
  void list_counts(std::vector<StageCount>& counts) const override {
    Parts::list_counts(counts);
    counts.push_back({"dwell", "departures put off", put_off_});
    counts.push_back({"dwell", "departures called off", called_off_});
  }

 private:
  /// A pair that is relevant here.
  struct Entry {
    Entity entity;
    bool is_leaving;      ///< the part reported that it left
    std::uint64_t since;  ///< the match at which it entered
  };
  struct Due {
    Subscriber subscriber;
    Entity entity;
  };

  /// Asserts that entries are in order and that none stays beyond its time.
  void check() const {
    entries_.check([this](const Entry& entry) {
      return entry.since <= now_ && (!entry.is_leaving || now_ < entry.since + matches_);
    });
    assert(due_[now_ % due_.size()].empty());
  }

  void take(const Change& change) {
    assert(change.transition != Transition::tier_changed);  // `tiers` comes after
    Buffer<Entry>& entries = entries_.list_of(change.subscriber);
    Entry* const entry = PairLists<Entry>::find(entries, change.entity);
    if (change.transition == Transition::entered) {
      assert(!entry || entry->is_leaving);  // a pair that enters was not in
      if (entry) return void((entry->is_leaving = false, ++called_off_));
      PairLists<Entry>::insert(entries, {change.entity, false, now_});
      changes_.push_back(change);
      return;
    }
    assert(entry && !entry->is_leaving);  // a pair that leaves was in
    if (now_ - entry->since >= matches_) {
      PairLists<Entry>::erase(entries, entry);
      changes_.push_back(change);
    } else {
      entry->is_leaving = true;
      due_[(entry->since + matches_) % due_.size()].push_back({change.subscriber, change.entity});
      ++put_off_;
    }
  }
  /// Releases pairs whose time is up and that did not come back; a pair may have been postponed
  /// more than once.
  void release() {
    Buffer<Due>& due = due_[now_ % due_.size()];
    if (due.empty()) return;
    for (const Due& each : due.span()) {
      Entry* const entry = entries_.find(each.subscriber, each.entity);
      if (!entry || !entry->is_leaving || entry->since + matches_ != now_) continue;
      PairLists<Entry>::erase(entries_[each.subscriber], entry);
      changes_.push_back({each.subscriber, each.entity, Transition::left});
    }
    due.clear();
    std::sort(changes_.data(), changes_.data() + changes_.size());
  }

  std::uint32_t matches_;
  std::uint64_t now_ = 0, put_off_ = 0, called_off_ = 0;
  PairLists<Entry> entries_;
  std::vector<Buffer<Due>> due_;  // by match, in a ring
};

}  // namespace

std::unique_ptr<Filter> make_dwell(std::unique_ptr<Filter> inner, std::uint32_t matches) {
  return std::make_unique<Dwell>(std::move(inner), matches);
}

}  // namespace rink::im
