// Collects the events of a window, and makes claims of them: docs/peer-to-peer.md, "The rule".
#include <algorithm>
#include <bit>
#include <cassert>
#include <utility>

#include "game/peer/peer.h"
#include "game/peer/rounding.h"

namespace rink::peer {

namespace {

std::uint64_t mixed(std::uint64_t digest, std::uint64_t word) {
  digest = (digest ^ word) * 0x9e3779b97f4a7c15ULL;
  return digest ^ (digest >> 31);
}
std::uint64_t mixed(std::uint64_t digest, double number) {
  return mixed(digest, std::bit_cast<std::uint64_t>(number));
}

ClaimedFlight claimed(double begin, std::uint64_t state, const Box& box) {
  return {begin,
          state,
          rounded_down(box.low_x),
          rounded_down(box.low_y),
          rounded_up(box.high_x),
          rounded_up(box.high_y)};
}

}  // namespace

/// Collects all that the rule needs of the run.
void Peer::survey() {
  find_edge();
  trace();
  lay_out_paths();
}

void Peer::trace() {
  const std::vector<physics::Change>& changes = subdomain_.journal().changes;
  steps_.clear(), mixed_.clear();
  own_events_ = subdomain_.journal().quiet_events, ghost_events_ = 0;
  for (std::size_t begin = 0, end = 0; begin < changes.size(); begin = end) {
    bool has_own = false, has_ghost = false, has_edge = false;
    for (end = begin; end < changes.size() && changes[end].event == changes[begin].event; ++end) {
      const bool is_own = roles_[changes[end].body] == own;
      has_own = has_own || is_own;
      has_ghost = has_ghost || !is_own;
      has_edge = has_edge || (is_own && is_edge_[changes[end].body] != 0);
    }
    ++(has_own ? own_events_ : ghost_events_);
    if (has_ghost || has_edge) enter_event({begin, end});
    if (has_own && has_ghost) mixed_.push_back({begin, end});
  }
  std::sort(steps_.begin(), steps_.end(), [](const Step& a, const Step& b) {
    return a.body != b.body ? a.body < b.body : a.change < b.change;
  });
}

void Peer::enter_event(Events event) {
  const std::vector<physics::Change>& changes = subdomain_.journal().changes;
  assert(event.begin < event.end && event.end <= changes.size());
  std::uint64_t concerned = 0;
  for (std::size_t k = event.begin; k < event.end; ++k)
    concerned += mixed(0x9ae16a3b2f90404fULL, std::uint64_t{changes[k].body});
  for (std::size_t k = event.begin; k < event.end; ++k) {
    const physics::Change& c = changes[k];
    if (roles_[c.body] == own && is_edge_[c.body] == 0) continue;
    const std::uint64_t state = mixed(
        mixed(mixed(mixed(mixed(mixed(concerned, c.conditions), c.x), c.y), c.vx), c.vy), c.since);
    steps_.push_back({c.body, static_cast<std::uint32_t>(k), state});
  }
}

std::span<const Peer::Step> Peer::steps_of(std::uint32_t body) const {
  const auto [begin, end] =
      std::equal_range(steps_.begin(), steps_.end(), Step{body, 0, 0},
                       [](const Step& a, const Step& b) { return a.body < b.body; });
  return {begin, end};
}

physics::Motion Peer::motion_after(const Step& step) const {
  const physics::Journal& journal = subdomain_.journal();
  assert(step.change < journal.changes.size());
  const physics::Change& c = journal.changes[step.change];
  assert(c.body == step.body);
  assert(c.motion == physics::Change::straight || c.motion < journal.motions.size());
  if (c.motion != physics::Change::straight) return journal.motions[c.motion];
  return {c.since,
          {c.x, c.y},
          {c.vx, c.vy},
          {0.0, 0.0},
          Vector2::Constant(subdomain_.world().spec().puck_drag)};
}

void Peer::lay_out_paths() {
  paths_.clear(), flights_.clear();
  const std::vector<physics::Change>& changes = subdomain_.journal().changes;
  for (const std::uint32_t body : edge_) {
    if (subdomain_.was_gone(body)) continue;
    const std::span<const Step> steps = steps_of(body);
    const Vector2 extent = extent_of(body);
    const std::size_t first = flights_.size();
    const auto time_of = [&](std::size_t k) {
      return k < steps.size() ? changes[steps[k].change].time : end_;
    };
    // A body that was not watched at the window's start may have had impacts without entries, all
    // of them at home.
    const bool is_late = is_watched_[body] == late;
    flights_.push_back({start_, time_of(0), 0,
                        is_late
                            ? room_at_home(body).grown(extent.x(), extent.y())
                            : swept(subdomain_.motion_before(body), start_, time_of(0), extent)});
    for (std::size_t k = 0; k < steps.size(); ++k) {
      const physics::Motion motion = motion_after(steps[k]);
      const bool is_out = k + 1 == steps.size() && !subdomain_.world().is_in_play({body});
      flights_.push_back({time_of(k), time_of(k + 1), steps[k].state,
                          is_out ? Box::around(motion.position, extent)
                                 : swept(motion, time_of(k), time_of(k + 1), extent)});
    }
    assert(flights_.size() == first + 1 + steps.size());
    paths_.push_back({body, first, flights_.size()});
  }
  hull_ = {infinity, infinity, -infinity, -infinity};
  for (const PathFlight& flight : flights_) hull_ = hull_.with(flight.box);
}

Claims Peer::claims_for(PeerNumber peer) {
  assert(peer < known_.size() && peer != number_);
  Claims message;
  message.window = window_;
  message.known_count = static_cast<std::uint32_t>(known_[peer].size());
  for (const Path& path : paths_) {
    const bool is_known = knows(peer, path.body);
    const auto comes_near = [&](const PathFlight& flight) {
      return is_in_region(peer, flight.box);
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
  message.presses = std::exchange(presses_[peer], {});
  counters_.claim_bytes += measured(message);
  return message;
}

}  // namespace rink::peer
