// Chooses between binning all boxes and queries for the movers, and does either.
#include "im/matching/change_join.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <initializer_list>

#include "im/basics/checked.h"

namespace rink::im {
namespace {

/// With more movers than this part of all, binning all boxes costs less than a query for each
/// mover.
constexpr std::size_t few_means_one_in = 6;
/// With more subscribers than this their order in space decides how often a line of memory is
/// fetched twice.
constexpr std::size_t unordered_subscriber_max = 4096;
/// How many motions ahead memory is asked for.
constexpr std::size_t stage_ahead = 16;

struct ExactMotions {
  const RegionHistory &askers, &asked;
};

template <Question question>
bool is_met(const Region& asker, const Region& asked) {
  if constexpr (question == Question::rectangles) return overlap(asker, asked);
  return question == Question::of_discs ? touches_disc(asker, asked) : touches_disc(asked, asker);
}

Verdict verdict(bool was, bool is) {
  return was == is ? Verdict::no : is ? Verdict::entered : Verdict::match;
}

template <Question question>
Verdict judge_moved(const void* context, std::uint32_t asker, std::uint32_t asked) {
  const auto& exact = *static_cast<const ExactMotions*>(context);
  const Motion &a = exact.askers[asker], &b = exact.asked[asked];
  return verdict(is_met<question>(a.before, b.before), is_met<question>(a.now, b.now));
}

/// Decides while the queried box stays at its old place, or is at its new one already. Empty lanes
/// tie with a box as large as numbers go.
template <Question question, Region Motion::*place>
Verdict judge_standing(const void* context, std::uint32_t asker, std::uint32_t asked) {
  if (asked == LiveIndex::nobody) return Verdict::no;
  const auto& exact = *static_cast<const ExactMotions*>(context);
  const Motion& a = exact.askers[asker];
  const Region& b = exact.asked[asked].*place;
  return verdict(is_met<question>(a.before, b), is_met<question>(a.now, b));
}

using Judge = Verdict (*)(const void*, std::uint32_t, std::uint32_t);

Judge moved_judge(Question question) {
  return question == Question::rectangles ? judge_moved<Question::rectangles>
         : question == Question::of_discs ? judge_moved<Question::of_discs>
                                          : judge_moved<Question::about_discs>;
}
template <Region Motion::*place>
Judge standing_judge(Question question) {
  assert(question != Question::rectangles);  // which lines are asked about
  return question == Question::of_discs ? judge_standing<Question::of_discs, place>
                                        : judge_standing<Question::about_discs, place>;
}

Question of_subscribers(Shape shape) {
  return shape == Shape::rectangle ? Question::rectangles : Question::of_discs;
}

/// Widens a side of length zero.
Region with_area(Region world) {
  const auto widen = [](double& low, double& high) {
    if (high - low >= 1e-300 && high - low <= 1e300) return;
    const double middle = std::clamp(0.5 * low + 0.5 * high, -1e300, 1e300),
                 half = std::max(0.5, 1e-9 * std::abs(middle));
    low = middle - half, high = middle + half;
  };
  widen(world.low_x, world.high_x), widen(world.low_y, world.high_y);
  assert(is_valid(world) && world.low_x < world.high_x && world.low_y < world.high_y);
  return world;
}

}  // namespace

ChangeJoin::ChangeJoin(const Region& world, Instructions instructions, Shape shape)
    : world_(with_area(world)),
      instructions_(instructions),
      shape_(shape),
      join_(instructions),
      group_join_(instructions) {}

void ChangeJoin::expect(const Region& world) {
  world_ = with_area(world);
  for (Standing* standing : {&entities_, &subscribers_})
    standing->is_live = standing->is_ordered = standing->is_placed = false;
}

std::span<const Change> ChangeJoin::find(const RegionHistory& entities,
                                         std::span<const std::uint32_t> moved_entities,
                                         const RegionHistory& subscribers,
                                         std::span<const std::uint32_t> moved_subscribers) {
  assert(moved_entities.size() <= entities.size() &&
         moved_subscribers.size() <= subscribers.size());
  if constexpr (checks_whole_structures)
    assert(std::is_sorted(moved_entities.begin(), moved_entities.end()) &&
           std::is_sorted(moved_subscribers.begin(), moved_subscribers.end()));
  changes_.clear();
  const std::size_t moved = moved_entities.size() + moved_subscribers.size();
  if (moved == 0) return {};
  const Side entity_side{entities, moved_entities, entities_},
      subscriber_side{subscribers, moved_subscribers, subscribers_};
  are_grouped_ = false;
  if (moved * few_means_one_in > entities.size() + subscribers.size())
    join_everyone(entity_side, subscriber_side);
  else join_movers(entity_side, subscriber_side);
  if constexpr (checks_whole_structures) check();
  return are_grouped_ ? changes_.ordered(group_join_, subscribers.size())
                      : changes_.ordered(subscribers.size());
}

/// Stages all of `side`, in their order in space at the last match if that is known: then sorting
/// moves little.
void ChangeJoin::stage(const Side& side) {
  Standing& standing = side.standing;
  BoxIndex& index = standing.swept;
  index.begin(world_, side.regions.size(), are_grouped_ ? Boxes::moving_for_groups : Boxes::moving);
  if (!standing.is_ordered) {
    for (std::uint32_t id = 0; id < side.regions.size(); ++id)
      if (!is_nowhere(side.regions[id].now)) index.stage(id, side.regions[id]);
    return;
  }
  const std::span<const std::uint32_t> order = standing.order.span();
  for (std::size_t i = 0; i < order.size(); ++i) {
    if (i + stage_ahead < order.size()) side.regions.prefetch(order[i + stage_ahead]);
    if (!is_nowhere(side.regions[order[i]].before)) index.stage(order[i], side.regions[order[i]]);
  }
  for (const std::uint32_t id : side.moved)
    if (is_nowhere(side.regions[id].before)) index.stage(id, side.regions[id]);
}

/// Puts all of `side` into the index: boxes that it had at the last match stay in their cells while
/// they are near.
void ChangeJoin::place(const Side& side) {
  Standing& standing = side.standing;
  if (standing.is_placed && standing.swept.size() == side.regions.present_count() &&
      standing.swept.follow(side.regions, instructions_))
    return;
  stage(side);
  standing.swept.build();
  assert(standing.swept.size() == side.regions.present_count());
  const std::span<const std::uint32_t> ids = standing.swept.ids();
  standing.order.resize(ids.size());
  std::copy(ids.begin(), ids.end(), standing.order.data());
  standing.is_ordered = standing.is_placed = true;
}

void ChangeJoin::join_everyone(const Side& entities, const Side& subscribers) {
  Worker* const worker = for_regions(worker_, entities.regions.size() + subscribers.regions.size());
  const bool is_ordered = subscribers.regions.size() > unordered_subscriber_max;
  are_grouped_ = is_ordered && shape_ == Shape::rectangle;
  join_.share_with(worker);
  const auto index_entities = [&] { place(entities); };
  const auto index_subscribers = [&] {
    probes_.begin(world_);
    subscribers.standing.is_placed = subscribers.standing.is_placed && is_ordered;
    if (is_ordered) return place(subscribers);
    for (std::uint32_t id = 0; id < subscribers.regions.size(); ++id)
      if (!is_nowhere(subscribers.regions[id].now)) probes_.add(id, subscribers.regions[id]);
  };
  // Few subscribers are listed sooner than a worker wakes up.
  run_both(is_ordered ? worker : nullptr, index_entities, index_subscribers);
  if (are_grouped_) join_groups(entities, subscribers);
  else if (is_ordered)
    join(entities.standing.swept, subscribers.standing.swept, entities, subscribers);
  else join(entities.standing.swept, probes_, entities, subscribers);
  // What few movers are looked up in does not follow.
  for (const Side* side : {&entities, &subscribers})
    side->standing.is_live = side->standing.is_live && side->moved.empty();
}

void ChangeJoin::join_groups(const Side& entities, const Side& subscribers) {
  const BoxIndex &asked = entities.standing.swept, &askers = subscribers.standing.swept;
  const ExactMotions exact{subscribers.regions, entities.regions};
  group_join_.clear();
  group_join_.share_with(
      for_regions(worker_, entities.regions.size() + subscribers.regions.size()));
  group_join_.add_changes(
      asked, askers,
      {!(asked.is_exact() && askers.is_exact()), moved_judge(Question::rectangles), &exact});
  pairs_tested_ += group_join_.candidate_count();
}

template <class Askers>
void ChangeJoin::join(const BoxIndex& asked, const Askers& askers, const Side& entities,
                      const Side& subscribers) {
  const ExactMotions exact{subscribers.regions, entities.regions};
  join_.clear();
  const Question question = of_subscribers(shape_);
  join_.add_changes(asked, askers,
                    {question != Question::rectangles || !(asked.is_exact() && askers.is_exact()),
                     moved_judge(question), &exact},
                    question);
  changes_.add_by_subscriber(join_);
  pairs_tested_ += join_.candidate_count();
}

/// Lists the movers as queries.
void ChangeJoin::list(const Side& movers) {
  probes_.begin(world_);
  for (std::size_t i = 0; i < movers.moved.size(); ++i) {
    if (i + stage_ahead < movers.moved.size())
      movers.regions.prefetch(movers.moved[i + stage_ahead]);
    probes_.add(movers.moved[i], movers.regions[movers.moved[i]]);
  }
}

/// Finds the changes with `asked`, all of which are at `place`, while the askers move from their
/// old to their new places.
template <Region Motion::*place>
void ChangeJoin::ask_lines(const Side& askers, const Side& asked, bool is_by_entity) {
  assert(shape_ == Shape::rectangle && probes_.size() == askers.moved.size());
  LineIndex& lines = asked.standing.lines;
  if (!asked.standing.is_live || lines.is_outgrown()) lines.build(world_, asked.regions, place);
  asked.standing.is_live = true;
  const ExactMotions exact{askers.regions, asked.regions};
  const TieJudge judge{true, judge_standing<Question::rectangles, place>, &exact};
  Worker* const worker = for_movers(worker_, askers.moved.size());
  const std::size_t count = probes_.size(), middle = worker != nullptr ? count / 2 : count;
  answers_.clear(), other_answers_.clear();
  const auto find = [&](std::size_t begin, std::size_t end, LineIndex::Answers& answers) {
    lines.find_changes(
        {.askers = probes_, .begin = begin, .end = end, .judge = judge, .regions = asked.regions},
        instructions_, answers);
  };
  run_both(
      worker, [&] { find(0, middle, answers_); }, [&] { find(middle, count, other_answers_); });
  for (const LineIndex::Answers* answers : {&answers_, &other_answers_}) {
    if (is_by_entity) changes_.add_by_entity(answers->found.span());
    else changes_.add_by_subscriber(answers->found.span());
    pairs_tested_ += answers->candidate_count;
  }
}

template <Region Motion::*place>
void ChangeJoin::ask_live(const Side& askers, const Side& asked, Question question) {
  assert(shape_ == Shape::disc && probes_.size() == askers.moved.size());
  LiveIndex& live = asked.standing.live;
  if (!asked.standing.is_live || live.is_outgrown()) live.build(world_, asked.regions, place);
  asked.standing.is_live = true;
  const ExactMotions exact{askers.regions, asked.regions};
  join_.share_with(for_movers(worker_, askers.moved.size()));
  join_.clear();
  join_.add_changes(live, probes_, {true, standing_judge<place>(question), &exact}, question);
  pairs_tested_ += join_.candidate_count();
}

void ChangeJoin::put(const Side& movers) {
  if (!movers.standing.is_live) return;
  if (shape_ == Shape::rectangle) movers.standing.lines.put(probes_);
  else movers.standing.live.put(movers.moved, movers.regions);
  assert(
      (shape_ == Shape::rectangle ? movers.standing.lines.size() : movers.standing.live.size()) ==
      movers.regions.present_count());
}

void ChangeJoin::Standing::forget(std::uint32_t id, const Region& place) {
  is_placed = false;
  live.remove(id);
  if (is_live && lines.is_built() && !is_nowhere(place)) lines.remove(id, place);
}

/// First the entities move, then the subscribers: so no query needs to know whether the other has
/// moved as well, and opposite changes cancel out.
void ChangeJoin::join_movers(const Side& entities, const Side& subscribers) {
  if (!entities.moved.empty()) {
    list(entities);
    if (shape_ == Shape::rectangle) {
      ask_lines<&Motion::before>(entities, subscribers, true);
    } else {
      ask_live<&Motion::before>(entities, subscribers, Question::about_discs);
      changes_.add_by_entity(join_);
    }
    put(entities);
  }
  if (!subscribers.moved.empty()) {
    list(subscribers);
    if (shape_ == Shape::rectangle) {
      ask_lines<&Motion::now>(subscribers, entities, false);
    } else {
      ask_live<&Motion::now>(subscribers, entities, Question::of_discs);
      changes_.add_by_subscriber(join_);
    }
    put(subscribers);
  }
  for (const Side* side : {&entities, &subscribers}) {
    side->standing.is_placed = false;
    const auto is_newcomer = [&](std::uint32_t id) { return is_nowhere(side->regions[id].before); };
    side->standing.is_ordered = side->standing.is_ordered &&
                                std::none_of(side->moved.begin(), side->moved.end(), is_newcomer);
  }
}

void ChangeJoin::check() const { entities_.check(shape_), subscribers_.check(shape_); }

void ChangeJoin::Standing::check([[maybe_unused]] Shape shape) const {
  assert(!is_placed || (is_ordered && swept.size() == order.size()));
  if (!is_live) return;
  assert(shape != Shape::rectangle || lines.is_built());
  assert(shape != Shape::disc || !lines.is_built());
}

std::size_t ChangeJoin::bytes() const {
  return entities_.bytes() + subscribers_.bytes() + probes_.bytes() + join_.bytes() +
         group_join_.bytes() + answers_.bytes() + other_answers_.bytes() + changes_.bytes();
}

}  // namespace rink::im
