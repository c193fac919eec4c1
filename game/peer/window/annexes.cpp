// Follows events back from own bodies to the ghosts that decided about them.
#include "game/peer/window/annexes.h"

#include <algorithm>
#include <cassert>

#include "game/peer/rounding.h"

namespace rink::peer {

namespace {

/// For so many windows a box that was needed stays; when half of them are over, it is chosen anew.
constexpr std::uint32_t kept = 32, fresh = kept / 2;
/// Around a ghost, in extents of the widest body: who is nearer may touch it in the next window.
constexpr double room = 3.0;
constexpr std::uint32_t doublings_max = 8;
constexpr double of_late = 0.1;  // s
/// Who is so near to an own zone may touch who is in it [m].
constexpr double close_by = 0.1;

/// Boxes that meet become one, and so do all if there are too many.
void join(std::vector<Box>& boxes, std::size_t count_max = Annexes::count_max) {
  for (std::size_t k = 0; k < boxes.size(); ++k)
    for (std::size_t other = k + 1; other < boxes.size(); ++other) {
      if (!boxes[k].meets(boxes[other])) continue;
      boxes[k] = boxes[k].with(boxes[other]);
      boxes.erase(boxes.begin() + static_cast<std::ptrdiff_t>(other));
      other = k;  // it may meet those before now
    }
  if (boxes.size() <= count_max) return;
  for (const Box& box : boxes) boxes.front() = boxes.front().with(box);
  boxes.resize(1);
}

}  // namespace

/// Backwards, so that only what came before an event in which an own body was counts.
void Annexes::find_deciding() {
  for (const std::uint32_t body : deciding_) is_deciding_[body] = 0;
  deciding_.clear();
  is_deciding_.resize(share_.roles().body_count(), 0);
  const std::vector<physics::Change>& changes = share_.subdomain().journal().changes;
  const auto decides = [&](const physics::Change& change) {
    return share_.owns(change.body) || is_deciding_[change.body] != 0;
  };
  for (std::size_t end = changes.size(), begin = end; end > 0; end = begin) {
    while (begin > 0 && changes[begin - 1].event == changes[end - 1].event) --begin;
    const auto first = changes.begin() + static_cast<std::ptrdiff_t>(begin),
               last = changes.begin() + static_cast<std::ptrdiff_t>(end);
    if (std::none_of(first, last, decides)) continue;
    for (auto change = first; change != last; ++change)
      if (!share_.owns(change->body) && is_deciding_[change->body] == 0)
        is_deciding_[change->body] = 1, deciding_.push_back(change->body);
  }
}

/// It rests on others, or has hopped of late.
bool Annexes::is_pressed(std::uint32_t ghost, const Window& window) const {
  if (share_.world().is_held({ghost})) return true;
  const BodyState state = share_.state(ghost);
  return state.hops > 0 && state.last_hop >= window.start - of_late;
}

Box Annexes::place_of(std::uint32_t ghost) const {
  return Box::around(share_.world().position({ghost}), share_.extent_of(ghost));
}

/// Most runs need none.
bool Annexes::announce(bool accepts, const Window& window, const WindowVerdicts& verdicts,
                       Verdict& own) {
  const bool has_none = halos_.annexes(halos_.number()).empty();
  if (accepts && verdicts.attempts() == 0 && has_none) return false;
  const std::vector<Box> boxes =
      accepts ? to_go_on(window, verdicts.usual_halo()) : to_repeat(window, verdicts.attempts());
  for (const Box& box : boxes)
    own.annexes.push_back({rounded_down(box.low_x), rounded_down(box.low_y), rounded_up(box.high_x),
                           rounded_up(box.high_y)});
  return !accepts && has_found_;
}

/// Those until now, and boxes around doubtful ghosts that are close to each other, if some of them
/// are pressed, and some have decided about own bodies, or are close to them.
std::vector<Box> Annexes::to_repeat(const Window& window, std::uint32_t attempts) {
  find_deciding();
  const double margin = 2.0 * share_.extent_max() * (1u << std::min(attempts, doublings_max));
  std::vector<Box> found, deciding, pressed;
  for (const std::uint32_t ghost : share_.roles().ghosts()) {
    if (!check_.is_doubtful(ghost)) continue;
    const Box place = place_of(ghost);
    found.push_back(place.grown(margin));
    const bool is_close = halos_.division().is_near(halos_.number(), place, close_by);
    if (is_close || is_deciding_[ghost] != 0) deciding.push_back(place);
    if (is_pressed(ghost, window)) pressed.push_back(place);
  }
  join(found, found.size());
  std::erase_if(found, [&](const Box& box) {
    const auto is_in = [&](const Box& place) { return box.meets(place); };
    return std::ranges::none_of(deciding, is_in) || std::ranges::none_of(pressed, is_in);
  });
  has_found_ = !found.empty();
  for (const Box& box : found) needs_.push_back({box, window.number});
  const std::vector<Box>& until_now = halos_.annexes(halos_.number());
  found.insert(found.end(), until_now.begin(), until_now.end());
  join(found);
  return found;
}

/// Boxes around the pressed ghosts beyond `halo` [m] that decided about own bodies; for some
/// windows those of earlier ones.
std::vector<Box> Annexes::to_go_on(const Window& window, double halo) {
  find_deciding();
  std::vector<Box> found;
  for (const std::uint32_t ghost : deciding_)
    if (!halos_.division().is_near(halos_.number(), place_of(ghost), halo) &&
        is_pressed(ghost, window))
      found.push_back(place_of(ghost));
  has_found_ = !found.empty();
  std::erase_if(needs_, [&](const Need& need) { return window.number - need.window > kept; });
  std::erase_if(found, [&](const Box& place) {
    return std::ranges::any_of(needs_, [&](const Need& need) {
      return window.number - need.window < fresh && need.box.holds(place);
    });
  });
  for (Box& place : found) place = place.grown(room * share_.extent_max());
  join(found);
  for (const Box& box : found) needs_.push_back({box, window.number});
  std::vector<Box> all;
  for (const Need& need : needs_) all.push_back(need.box);
  join(all);
  return all;
}

}  // namespace rink::peer
