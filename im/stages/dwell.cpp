// The stage `dwell`: a pair that became relevant stays so for some matches at least.
#include <algorithm>
#include <cassert>

#include "im/basics/checked.h"
#include "im/composition/parts.h"
#include "im/stages/stages.h"

namespace rink::im {
namespace {

/// Matches are counted; a pair that would leave too early is kept on a list of those due at the
/// match at which it may.
class Dwell final : public Parts {
 public:
  Dwell(std::vector<std::unique_ptr<Filter>> inner, std::uint32_t matches)
      : Parts(std::move(inner)), matches_(matches), due_(matches + std::size_t{1}) {
    assert(matches_ >= 1);
  }

  void remove_entity(Entity entity) override {
    Parts::remove_entity(entity);
    for (Buffer<Entry>& entries : entries_)
      if (Entry* const entry = find(entries, entity)) erase(entries, entry);
  }
  void remove_subscriber(Subscriber subscriber) override {
    Parts::remove_subscriber(subscriber);
    if (subscriber < entries_.size()) entries_[subscriber].clear();
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

  static Entry* place_of(Buffer<Entry>& entries, Entity entity) {
    return std::lower_bound(entries.data(), entries.data() + entries.size(), entity,
                            [](const Entry& entry, Entity id) { return entry.entity < id; });
  }
  static Entry* find(Buffer<Entry>& entries, Entity entity) {
    Entry* const place = place_of(entries, entity);
    return place != entries.data() + entries.size() && place->entity == entity ? place : nullptr;
  }
  static void erase(Buffer<Entry>& entries, Entry* entry) {
    std::copy(entry + 1, entries.data() + entries.size(), entry);
    entries.resize(entries.size() - 1);
  }
  static void insert(Buffer<Entry>& entries, const Entry& entry) {
    const auto at = static_cast<std::size_t>(place_of(entries, entry.entity) - entries.data()),
               count = entries.size();
    entries.push_back(entry);
    std::copy_backward(entries.data() + at, entries.data() + count, entries.data() + count + 1);
    entries[at] = entry;
  }

  /// Asserts that entries are in order and that none stays beyond its time.
  void check() const {
    for (const Buffer<Entry>& entries : entries_) {
      for (std::size_t i = 1; i < entries.size(); ++i)
        assert(entries[i - 1].entity < entries[i].entity);
      for ([[maybe_unused]] const Entry& entry : entries.span()) {
        assert(entry.since <= now_);
        assert(!entry.is_leaving || now_ < entry.since + matches_);
      }
    }
    assert(due_[now_ % due_.size()].empty());
  }

  void take(const Change& change) {
    assert(change.transition != Transition::tier_changed);  // `tiers` comes after
    if (change.subscriber >= entries_.size()) entries_.resize(change.subscriber + std::size_t{1});
    Buffer<Entry>& entries = entries_[change.subscriber];
    Entry* const entry = find(entries, change.entity);
    if (change.transition == Transition::entered) {
      assert(!entry || entry->is_leaving);  // a pair that enters was not in
      if (entry) return void((entry->is_leaving = false, ++called_off_));
      insert(entries, {change.entity, false, now_});
      changes_.push_back(change);
      return;
    }
    assert(entry && !entry->is_leaving);  // a pair that leaves was in
    if (now_ - entry->since >= matches_) {
      erase(entries, entry);
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
      Entry* const entry = each.subscriber < entries_.size()
                               ? find(entries_[each.subscriber], each.entity)
                               : nullptr;
      if (!entry || !entry->is_leaving || entry->since + matches_ != now_) continue;
      erase(entries_[each.subscriber], entry);
      changes_.push_back({each.subscriber, each.entity, Transition::left});
    }
    due.clear();
    std::sort(changes_.data(), changes_.data() + changes_.size());
  }

  std::uint32_t matches_;
  std::uint64_t now_ = 0, put_off_ = 0, called_off_ = 0;
  std::vector<Buffer<Entry>> entries_;  // by subscriber, ascending
  std::vector<Buffer<Due>> due_;        // by match, in a ring
};

}  // namespace

std::unique_ptr<Filter> make_dwell(std::unique_ptr<Filter> inner, std::uint32_t matches) {
  std::vector<std::unique_ptr<Filter>> parts;
  parts.push_back(std::move(inner));
  return std::make_unique<Dwell>(std::move(parts), matches);
}

}  // namespace rink::im
