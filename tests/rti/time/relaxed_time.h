// Time management judged by brute force while it works: bounds by relaxation, every grant and
// delivery against them.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <set>
#include <vector>

#include "rti/federation_services.h"
#include "rti/time/conservative_time.h"

namespace rink::rti::testing {

/// Stands between a federation execution and the time management that it really uses, keeps its own
/// record of what was asked and told, and works every bound out anew from the definitions: a
/// federate's GALT is the least that any other may still send, and one that waits for its next
/// message may send from what it could be granted next on. From "nobody sends anything" downwards,
/// until nothing changes.
class RelaxedTime final : public TimeManagement, private TimeListener {
 public:
  explicit RelaxedTime(
      std::unique_ptr<TimeManagement> judged = std::make_unique<ConservativeTime>())
      : judged_(std::move(judged)) {}

  bool enable_regulation(std::uint32_t federate, double lookahead) override {
    const bool is_done = judged_->enable_regulation(federate, lookahead);
    if (is_done) record(federate).awaits_regulation = true, record(federate).lookahead = lookahead;
    return is_done;
  }
  bool disable_regulation(std::uint32_t federate) override {
    record(federate).is_regulating = record(federate).awaits_regulation = false;
    return judged_->disable_regulation(federate);
  }
  bool enable_constrained(std::uint32_t federate) override {
    const bool is_done = judged_->enable_constrained(federate);
    if (is_done) record(federate).awaits_constraint = true;
    return is_done;
  }
  bool disable_constrained(std::uint32_t federate) override {
    record(federate).is_constrained = record(federate).awaits_constraint = false;
    return judged_->disable_constrained(federate);
  }
  bool modify_lookahead(std::uint32_t federate, double lookahead) override {
    const bool is_done = judged_->modify_lookahead(federate, lookahead);
    if (is_done)
      record(federate).lookahead = lookahead,
      promise(record(federate), record(federate).time + lookahead);
    return is_done;
  }
  bool request(std::uint32_t federate, AdvanceKind kind, double time) override {
    if (!judged_->request(federate, kind, time)) return false;
    Record& mine = record(federate);
    mine.is_advancing = true;
    mine.kind = kind;
    mine.asked = time;
    if (!is_next_message(kind) && kind != AdvanceKind::flush_queue)
      promise(mine, earliest_stamp(time, mine.lookahead, kind));
    return true;
  }
  void remove(std::uint32_t federate, TimeListener& listener) override {
    judged_->remove(federate, listener);
    record(federate) = {};
  }
  bool may_send(std::uint32_t federate, double time) const override {
    return judged_->may_send(federate, time);
  }
  double earliest(std::uint32_t federate) const override { return judged_->earliest(federate); }
  bool is_constrained(std::uint32_t federate) const override {
    return judged_->is_constrained(federate);
  }
  bool is_regulating(std::uint32_t federate) const override {
    return judged_->is_regulating(federate);
  }
  double galt(std::uint32_t federate) const override { return judged_->galt(federate); }
  double lits(std::uint32_t federate) const override { return judged_->lits(federate); }
  double time(std::uint32_t federate) const override { return judged_->time(federate); }
  void enqueue(std::uint32_t federate, const TimedEntry& entry) override {
    EXPECT_GE(entry.time, record(federate).time)
        << "a message in the past of federate " << federate;
    if (record(federate).has_heard_all) {
      EXPECT_GT(entry.time, record(federate).time)
          << "a message at an instant of which federate " << federate << " has heard all";
    }
    EXPECT_TRUE(record(federate).queue.insert(entry).second);
    judged_->enqueue(federate, entry);
  }
  void withdraw(std::uint32_t federate, const TimedEntry& entry) override {
    EXPECT_EQ(record(federate).queue.erase(entry), 1u);
    judged_->withdraw(federate, entry);
  }

  void settle(TimeListener& listener) override {
    listener_ = &listener;
    judged_->settle(*this);
    const std::vector<double> bounds = relax();
    for (std::uint32_t i = 0; i < records_.size(); ++i) {
      EXPECT_EQ(judged_->galt(i), galt_by(bounds, i)) << "federate " << i;
      EXPECT_EQ(judged_->lits(i), std::min(galt_by(bounds, i), next(records_[i])))
          << "federate " << i;
      EXPECT_FALSE(can_be_granted(records_[i], galt_by(bounds, i)))
          << "federate " << i << " is kept waiting";
      EXPECT_FALSE(records_[i].awaits_constraint && records_[i].time <= galt_by(bounds, i))
          << "federate " << i << " is kept waiting";
    }
    ++settled_;
  }
  std::uint64_t settled() const { return settled_; }
  std::uint64_t granted() const { return granted_; }

 private:
  struct Record {
    bool is_regulating = false, is_constrained = false, awaits_regulation = false,
         awaits_constraint = false, is_advancing = false, has_heard_all = false;
    AdvanceKind kind = AdvanceKind::time_advance;
    double time = 0.0, asked = 0.0, lookahead = 0.0, promised = 0.0, last_delivered = -1.0;
    std::set<TimedEntry> queue;
  };
  Record& record(std::uint32_t federate) {
    if (federate >= records_.size()) records_.resize(federate + 1);
    return records_[federate];
  }
  static void promise(Record& record, double earliest) {
    record.promised = std::max(record.promised, earliest);
  }
  static double next(const Record& record) {
    return record.queue.empty() ? time_unbounded : record.queue.begin()->time;
  }
  static double goal(const Record& record) {
    return is_next_message(record.kind) ? std::min(record.asked, next(record)) : record.asked;
  }
  static bool can_be_granted(const Record& record, double galt) {
    if (!record.is_advancing) return false;
    if (!record.is_constrained || record.kind == AdvanceKind::flush_queue) return true;
    return is_complete(record.kind) ? goal(record) < galt : goal(record) <= galt;
  }
  static double galt_by(const std::vector<double>& bounds, std::size_t federate) {
    double least = time_unbounded;
    for (std::size_t i = 0; i < bounds.size(); ++i)
      if (i != federate) least = std::min(least, bounds[i]);
    return least;
  }
  std::vector<double> relax() const {
    std::vector<double> bounds(records_.size(), time_unbounded);
    for (bool is_changed = true; is_changed;) {
      is_changed = false;
      for (std::size_t i = 0; i < records_.size(); ++i) {
        const Record& each = records_[i];
        if (!each.is_regulating && !each.awaits_regulation) continue;
        double bound = each.promised;
        if (each.is_advancing && each.is_constrained && is_next_message(each.kind))
          bound = std::max(bound, earliest_stamp(std::min(goal(each), galt_by(bounds, i)),
                                                 each.lookahead, each.kind));
        if (each.awaits_regulation)
          bound = judged_->earliest(
              static_cast<std::uint32_t>(i));  // the promise is told with what was enabled
        is_changed |= bound != bounds[i];
        bounds[i] = bound;
      }
    }
    return bounds;
  }

  void deliver(std::uint32_t federate, const TimedEntry& entry) override {
    Record& mine = record(federate);
    ASSERT_FALSE(mine.queue.empty());
    EXPECT_EQ(*mine.queue.begin(), entry) << "out of order";
    mine.queue.erase(entry);
    mine.last_delivered = entry.time;
    if (mine.is_constrained && mine.is_advancing && mine.kind != AdvanceKind::flush_queue) {
      EXPECT_LT(entry.time, is_complete(mine.kind) ? galt_by(relax(), federate) : time_unbounded);
    }
    listener_->deliver(federate, entry);
  }
  void discard(std::uint32_t federate, const TimedEntry& entry) override {
    listener_->discard(federate, entry);
  }
  void regulation_enabled(std::uint32_t federate, double time, double earliest) override {
    Record& mine = record(federate);
    mine.awaits_regulation = false;
    mine.is_regulating = true;
    EXPECT_GE(time, mine.time);
    if (time > mine.time) mine.has_heard_all = false;
    mine.time = time;
    mine.promised = earliest;
    for (std::uint32_t i = 0; i < records_.size(); ++i)
      if (i != federate && records_[i].is_constrained) {
        EXPECT_GE(earliest,
                  records_[i].has_heard_all ? just_after(records_[i].time) : records_[i].time)
            << "it could speak in the past of " << i;
      }
    listener_->regulation_enabled(federate, time, earliest);
  }
  void constrained_enabled(std::uint32_t federate, double time) override {
    Record& mine = record(federate);
    EXPECT_TRUE(mine.awaits_constraint);
    EXPECT_LE(time, galt_by(relax(), federate));
    mine.awaits_constraint = false;
    mine.is_constrained = true;
    mine.has_heard_all = false;
    listener_->constrained_enabled(federate, time);
  }
  void grant(std::uint32_t federate, double time) override {
    Record& mine = record(federate);
    const double galt = galt_by(relax(), federate);
    EXPECT_TRUE(mine.is_advancing);
    EXPECT_GE(time, mine.time);
    EXPECT_LE(time, mine.asked);
    if (mine.is_constrained && !(mine.kind == AdvanceKind::flush_queue && time == mine.time)) {
      EXPECT_LE(time, galt);
    }
    if (mine.is_constrained && is_complete(mine.kind)) {
      EXPECT_LT(time, galt);
    }
    if (mine.kind != AdvanceKind::flush_queue) {
      EXPECT_TRUE(time == mine.asked ||
                  (is_next_message(mine.kind) && time == mine.last_delivered));
    }
    if (mine.kind != AdvanceKind::flush_queue) {
      EXPECT_GT(next(mine), time) << "a grant before what belongs to it";
    }
    if (mine.kind == AdvanceKind::flush_queue) {
      EXPECT_TRUE(mine.queue.empty());
    }
    mine.has_heard_all = is_complete(mine.kind) || (mine.has_heard_all && time == mine.time);
    mine.is_advancing = false;
    mine.time = time;
    promise(mine, earliest_stamp(time, mine.lookahead, mine.kind));
    ++granted_;
    listener_->grant(federate, time);
  }

  std::unique_ptr<TimeManagement> judged_;
  TimeListener* listener_ = nullptr;
  std::vector<Record> records_;
  std::uint64_t settled_ = 0, granted_ = 0;
};

/// A federation execution whose time management is judged all the time.
inline FederationServices relaxed() {
  FederationServices services;
  services.time_management = [] { return std::make_unique<RelaxedTime>(); };
  return services;
}

}  // namespace rink::rti::testing
