// Reads the journal of a run, and makes claims of it.
#include "game/peer/window/claim_trace.h"

#include <algorithm>
#include <bit>
#include <cassert>

#include "game/peer/rounding.h"

namespace rink::peer {

namespace {

constexpr std::uint64_t factor = 0x9e3779b97f4a7c15ULL, body_mark = 0x9ae16a3b2f90404fULL;

/// Each word can be undone, so a digest of known words but one tells that one.
std::uint64_t digest(std::uint64_t before, std::uint64_t word) {
  before = (before ^ word) * factor;
  return before ^ (before >> 31);
}
constexpr std::uint64_t inverse_of(std::uint64_t odd) {
  std::uint64_t inverse = odd;  // right in its three lowest bits, then in twice as many each time
  for (int bits = 3; bits < 64; bits *= 2) inverse *= 2 - odd * inverse;
  return inverse;
}
static_assert(factor * inverse_of(factor) == 1);
/// What was before digest(before, word), or the word if `word` is what was before.
std::uint64_t undone(std::uint64_t after, std::uint64_t word) {
  return (after ^ (after >> 31) ^ (after >> 62)) * inverse_of(factor) ^ word;
}
std::uint64_t participant(std::uint32_t body) { return digest(body_mark, std::uint64_t{body}); }
std::uint64_t digest(std::uint64_t before, double number) {
  return digest(before, std::bit_cast<std::uint64_t>(number));
}

ClaimedFlight claimed(double begin, std::uint64_t state, const Box& box) {
  return {begin,
          state,
          rounded_down(box.low_x),
          rounded_down(box.low_y),
          rounded_up(box.high_x),
          rounded_up(box.high_y)};
}

/// How far the box reaches beyond the nearest of these zones [m]; negative inside.
double excess_of(const Box& box, std::span<const Box> zones) {
  double least = infinity;
  for (const Box& zone : zones)
    least = std::min(least, std::max({zone.low_x - box.low_x, zone.low_y - box.low_y,
                                      box.high_x - zone.high_x, box.high_y - zone.high_y}));
  return least;
}

/// How far the box reaches from a place in it.
double farthest_side(const Box& box, const Vector2& place) {
  return std::max({place.x() - box.low_x, place.y() - box.low_y, box.high_x - place.x(),
                   box.high_y - place.y()});
}

}  // namespace

void ClaimTrace::follow(const Window& window) {
  assert(window.end >= window.start);
  find_steps();
  lay_out_paths(window);
}

void ClaimTrace::find_steps() {
  const physics::Journal& journal = share_.subdomain().journal();
  const std::vector<physics::Change>& changes = journal.changes;
  steps_.clear(), mixed_.clear();
  own_events_ = journal.quiet_events, ghost_events_ = 0;
  for (std::size_t begin = 0, end = 0; begin < changes.size(); begin = end) {
    bool has_own = false, has_ghost = false, has_edge = false;
    for (end = begin; end < changes.size() && changes[end].event == changes[begin].event; ++end) {
      const bool is_own = share_.owns(changes[end].body);
      has_own = has_own || is_own;
      has_ghost = has_ghost || !is_own;
      has_edge = has_edge || (is_own && homes_.is_at_edge(changes[end].body));
    }
    ++(has_own ? own_events_ : ghost_events_);
    if (has_ghost || has_edge) enter({begin, end});
    if (has_own && has_ghost) mixed_.push_back({begin, end});
  }
  std::sort(steps_.begin(), steps_.end(), [](const Step& a, const Step& b) {
    return a.body != b.body ? a.body < b.body : a.change < b.change;
  });
}

void ClaimTrace::enter(const Event& event) {
  const std::vector<physics::Change>& changes = share_.subdomain().journal().changes;
  assert(event.begin < event.end && event.end <= changes.size());
  std::uint64_t concerned = 0;
  for (std::size_t k = event.begin; k < event.end; ++k) concerned += participant(changes[k].body);
  for (std::size_t k = event.begin; k < event.end; ++k) {
    const physics::Change& c = changes[k];
    if (share_.owns(c.body) && !homes_.is_at_edge(c.body)) continue;
    const std::uint64_t state = digest(
        digest(digest(digest(digest(digest(concerned, c.conditions), c.x), c.y), c.vx), c.vy),
        c.since);
    steps_.push_back({c.body, static_cast<std::uint32_t>(k), state});
  }
}

std::uint64_t ClaimTrace::partner_in(std::uint64_t state, const FreeFlightState& flight,
                                     std::uint8_t mouth) {
  for (const double number : {flight.time, flight.velocity.y(), flight.velocity.x(),
                              flight.position.y(), flight.position.x()})
    state = undone(state, std::bit_cast<std::uint64_t>(number));
  return undone(undone(state, std::uint64_t{mouth}) - participant(flight.number), body_mark);
}

std::span<const ClaimTrace::Step> ClaimTrace::steps_of(std::uint32_t body) const {
  const auto [begin, end] =
      std::equal_range(steps_.begin(), steps_.end(), Step{body, 0, 0},
                       [](const Step& a, const Step& b) { return a.body < b.body; });
  return {begin, end};
}

double ClaimTrace::time_of(const Step& step) const {
  assert(step.change < share_.subdomain().journal().changes.size());
  return share_.subdomain().journal().changes[step.change].time;
}

double ClaimTrace::reach_of(const Step& step) const {
  assert(step.change < share_.subdomain().journal().changes.size());
  return share_.subdomain().journal().changes[step.change].reach;
}

physics::Motion ClaimTrace::motion_after(const Step& step) const {
  const physics::Journal& journal = share_.subdomain().journal();
  assert(step.change < journal.changes.size());
  const physics::Change& c = journal.changes[step.change];
  assert(c.body == step.body);
  assert(c.motion == physics::Change::straight || c.motion < journal.motions.size());
  if (c.motion != physics::Change::straight) return journal.motions[c.motion];
  return {c.since,
          {c.x, c.y},
          {c.vx, c.vy},
          {0.0, 0.0},
          Vector2::Constant(share_.world().spec().puck_drag)};
}

void ClaimTrace::lay_out_paths(const Window& window) {
  paths_.clear(), flights_.clear();
  for (const std::uint32_t body : homes_.edge())
    if (!share_.subdomain().was_gone(body)) lay_out_path(body, window);
  hull_ = {infinity, infinity, -infinity, -infinity};
  for (const PathFlight& flight : flights_) hull_ = hull_.with(flight.box);
}

void ClaimTrace::lay_out_path(std::uint32_t body, const Window& window) {
  const std::span<const Step> steps = steps_of(body);
  const Vector2 extent = share_.extent_of(body);
  const std::size_t first = flights_.size();
  const auto begin_of = [&](std::size_t k) {
    return k < steps.size() ? time_of(steps[k]) : window.end;
  };
  // A body that was not watched at the window's start may have had impacts without entries, all of
  // them at home.
  flights_.push_back(
      {window.start, begin_of(0), 0,
       homes_.was_unwatched(body)
           ? homes_.room_of(body).grown(extent.x(), extent.y())
           : swept(share_.subdomain().motion_before(body), window.start, begin_of(0), extent)});
  for (std::size_t k = 0; k < steps.size(); ++k) {
    const physics::Motion motion = motion_after(steps[k]);
    // As far as the event looked, whoever is there may have been in it.
    const double reach = reach_of(steps[k]);
    const bool is_out = k + 1 == steps.size() && !share_.world().is_in_play({body});
    const Box box = is_out ? Box::around(motion.position, extent)
                           : swept(motion, begin_of(k), begin_of(k + 1), extent);
    flights_.push_back({begin_of(k), begin_of(k + 1), steps[k].state, box.grown(reach)});
  }
  assert(flights_.size() == first + 1 + steps.size());
  paths_.push_back({body, first, flights_.size()});
}

Claims ClaimTrace::claims_for(PeerNumber peer, const Window& window, const Halos& halos) const {
  assert(peer < halos.peer_count() && peer != halos.number());
  Claims message;
  message.window = window.number;
  message.known_count = static_cast<std::uint32_t>(share_.known(peer).size());
  for (const Path& path : paths_) {
    const bool is_known = share_.knows(peer, path.body);
    const auto comes_near = [&](const PathFlight& flight) {
      return halos.is_near(peer, flight.box);
    };
    const std::size_t begin = is_known ? path.begin + 1 : path.begin;
    if (is_known ? begin == path.end
                 : std::none_of(&flights_[path.begin],
                                &flights_[path.begin] + (path.end - path.begin), comes_near))
      continue;
    message.bodies.push_back({path.body, static_cast<std::uint32_t>(path.end - begin), is_known});
    for (std::size_t k = begin; k < path.end; ++k)
      message.flights.push_back(claimed(flights_[k].begin, flights_[k].state, flights_[k].box));
  }
  return message;
}

bool ClaimTrace::may_touch(const PathFlight& foreign) const {
  const Box box = foreign.box.grown(touch_margin);
  // Most doubtful ghosts are at the rim of the halo, where no own body comes.
  return hull_.meets(box) &&
         std::any_of(flights_.begin(), flights_.end(), [&](const PathFlight& flight) {
           return flight.begin - time_margin <= foreign.end &&
                  foreign.begin <= flight.end + time_margin && flight.box.meets(box);
         });
}

double ClaimTrace::needed_halo(std::span<const Box> zones) const {
  assert(!zones.empty() || flights_.empty());
  double most = 0.0;
  for (const PathFlight& flight : flights_)
    most = std::max(most, excess_of(flight.box.grown(touch_margin), zones));
  return most;
}

float ClaimTrace::reach_for_strangers(const Halos& halos) const {
  double from_place = share_.extent_max(), beyond = 0.0;
  for (const Reach& reach : homes_.outskirts()) {
    from_place =
        std::max(from_place, farthest_side(reach.box, share_.world().position({reach.body})));
    beyond = std::max(beyond, excess_of(reach.box, halos.own_zones()));
  }
  const double widest = std::max(from_place > halos.usual_reach() - touch_margin ? from_place : 0.0,
                                 beyond > halos.own() - touch_margin ? beyond : 0.0);
  return widest > 0.0 ? rounded_up(widest + touch_margin) : 0.0f;
}

}  // namespace rink::peer
