// Net changes of overlap between two sets of moving boxes: the one matching engine behind all
// schemes that are overlap of rectangles.
#pragma once

#include <cstdint>
#include <span>

#include "im/matching/change_list.h"
#include "im/matching/disc.h"
#include "im/matching/group_join.h"
#include "im/matching/index/box_index.h"
#include "im/matching/index/line_index.h"
#include "im/matching/index/live_index.h"
#include "im/matching/join.h"
#include "im/matching/region_history.h"

namespace rink::im {

/// Keeps no pairs: a pair has changed if its overlap before and now differ, so both places are
/// looked at at once. Two ways, the same result: when many moved, all boxes are binned anew by the
/// hull of their two places and joined; when few did, first the moved entities query the
/// subscribers at their old places, then the moved subscribers query the entities at their new
/// places, and a pair that changed twice has not changed.
class ChangeJoin {
 public:
  explicit ChangeJoin(const Region& world, Instructions instructions = Instructions::best,
                      Shape shape = Shape::rectangle);

  /// Every change, ordered by (subscriber, entity); `moved_...` are the ids whose place has
  /// changed, ascending. Valid until the next call.
  std::span<const Change> find(const RegionHistory& entities,
                               std::span<const std::uint32_t> moved_entities,
                               const RegionHistory& subscribers,
                               std::span<const std::uint32_t> moved_subscribers);

  /// Sets where most are from now on, for callers whose coordinates have a new scale. What is kept
  /// is built anew at the next match, so this pays only where nearly all move at once.
  void expect(const Region& world);

  /// Sets a worker that takes half where there is enough to match (worker.h), or null for none, as
  /// at first. It must outlive this. Changes and their order are the same.
  void share_with(Worker* worker) { worker_ = worker; }

  /// `place` is the region at the last match, maybe nowhere.
  void forget_entity(std::uint32_t entity, const Region& place) { entities_.forget(entity, place); }
  void forget_subscriber(std::uint32_t subscriber, const Region& place) {
    subscribers_.forget(subscriber, place);
  }

  /// Asserts that the data kept of either set from match to match agrees.
  void check() const;
  std::uint64_t pairs_tested() const { return pairs_tested_; }
  std::size_t bytes() const;

 private:
  /// The data kept of a set from match to match.
  struct Standing {
    LineIndex lines;              // of rectangles
    LiveIndex live;               // of discs, and of what is asked about them
    bool is_live = false;         // the index agrees with where all were before
    Buffer<std::uint32_t> order;  // of ids in space when everyone was last joined
    bool is_ordered = false;      // all who were somewhere before are in it
    BoxIndex swept;               // everyone, if everyone was joined at the last match
    bool is_placed = false;       // `swept` holds all who were somewhere before, where they were
    void forget(std::uint32_t id, const Region& place);
    void check(Shape shape) const;
    std::size_t bytes() const {
      return lines.bytes() + live.bytes() + sizeof(std::uint32_t) * order.capacity() +
             swept.bytes();
    }
  };
  /// One of the two sets, at this match.
  struct Side {
    const RegionHistory& regions;
    std::span<const std::uint32_t> moved;
    Standing& standing;
  };
  void join_everyone(const Side& entities, const Side& subscribers);
  void join_movers(const Side& entities, const Side& subscribers);
  void join_groups(const Side& entities, const Side& subscribers);
  void stage(const Side& side);
  void place(const Side& side);
  void list(const Side& movers);
  template <Region Motion::*place>
  void ask_lines(const Side& askers, const Side& asked, bool is_by_entity);
  template <Region Motion::*place>
  void ask_live(const Side& askers, const Side& asked, Question question);
  void put(const Side& movers);
  template <class Askers>
  void join(const BoxIndex& asked, const Askers& askers, const Side& entities,
            const Side& subscribers);

  Region world_;
  Instructions instructions_;
  Shape shape_;
  Standing entities_, subscribers_;
  ProbeList probes_;
  Join join_;
  GroupJoin group_join_;
  LineIndex::Answers answers_, other_answers_;
  ChangeList changes_;
  std::uint64_t pairs_tested_ = 0;
  bool are_grouped_ = false;  // subscribers ask eight at a time
  Worker* worker_ = nullptr;
};

}  // namespace rink::im
