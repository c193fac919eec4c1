// A tally of the last events by body and by partner.
#include "game/physics/overrun.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <iomanip>
#include <map>
#include <sstream>
#include <utility>

namespace rink::physics::inline RINK_PRECISION {
namespace {

constexpr double no_room_path = 1e-6;  // of a body's size
constexpr double light_ratio = 100.0;
constexpr double pressed_share = 0.125;  // of a body's events that were hops
constexpr double outstanding = 8.0;      // times the share of an average body

struct Tally {
  std::size_t events = 0, hops = 0;
  std::map<Partner, std::size_t> with{};
};

/// Parts of the field are one partner.
std::map<std::uint32_t, Tally> tallies_of(const std::vector<ChargedEvent>& events) {
  std::map<std::uint32_t, Tally> tallies;
  const auto count = [&](std::uint32_t body, Partner other, bool is_hop) {
    Tally& tally = tallies[body];
    ++tally.events;
    if (is_hop) ++tally.hops;
    ++tally.with[is_body(other) ? other : partner::none];
  };
  for (const ChargedEvent& event : events) {
    count(event.body, event.partner, event.is_hop);
    if (is_body(event.partner)) count(event.partner, event.body, event.is_hop);
  }
  return tallies;
}

Partner main_partner(const Tally& tally) {
  return std::max_element(tally.with.begin(), tally.with.end(),
                          [](const auto& a, const auto& b) { return a.second < b.second; })
      ->first;
}

bool is_driven(const World& world, BodyId body) {
  return world.thrust(body) != RealVector(0.0, 0.0);
}

bool is_pressed(const World& world, const BusyBody& busy, const Tally& tally) {
  return static_cast<double>(tally.hops) >= pressed_share * static_cast<double>(tally.events) ||
         is_driven(world, busy.body) || (busy.partner && is_driven(world, *busy.partner));
}

OverrunReason reason_of(const World& world, const BusyBody& busy, const Tally& tally) {
  const auto size = static_cast<double>(world.half_extent(busy.body).minCoeff());
  if (is_pressed(world, busy, tally)) return OverrunReason::pressed;
  if (busy.free_path < no_room_path * size) return OverrunReason::no_room;
  if (busy.mass_ratio >= light_ratio) return OverrunReason::light;
  const double average = 2.0 / world.body_count();
  return busy.share < outstanding * average ? OverrunReason::common : OverrunReason::fast;
}

/// Who does not move at this instant may have done so at others: the fastest bounds them all.
Real greatest_speed(const World& world, const std::map<std::uint32_t, Tally>& tallies) {
  Real speed = 0.0;
  for (const auto& [body, tally] : tallies) speed = std::max(speed, world.velocity({body}).norm());
  return speed;
}

BusyBody busy_body(const World& world, std::uint32_t body, const Tally& tally,
                   const Overrun& overrun, Real speed) {
  const auto events = static_cast<double>(tally.events);
  BusyBody busy{.body = {body}, .share = events / static_cast<double>(overrun.looked_at)};
  if (const Partner other = main_partner(tally); is_body(other)) busy.partner = BodyId{other};
  for (const auto& [other, count] : tally.with)
    if (const Real mass = is_body(other) ? world.mass({other}) : 0.0; std::isfinite(mass))
      busy.mass_ratio = std::max(busy.mass_ratio, static_cast<double>(mass / world.mass({body})));
  busy.free_path = static_cast<double>(speed * overrun.span) / events;
  busy.reason = reason_of(world, busy, tally);
  return busy;
}

void write(std::ostream& text, const BusyBody& busy) {
  const std::string partner =
      busy.partner ? "body " + std::to_string(busy.partner->index) : "the field";
  text << std::setprecision(3) << "body " << busy.body.index << " in " << 100.0 * busy.share
       << " % of them, ";
  switch (busy.reason) {
    case OverrunReason::pressed:
      text << "pressed by thrust, mostly against " << partner;
      return;
    case OverrunReason::no_room:
      text << "with no room: at most " << std::setprecision(2) << busy.free_path
           << " m between two, mostly with " << partner;
      return;
    case OverrunReason::light:
      text << "being light: others are " << busy.mass_ratio << " times as heavy";
      return;
    case OverrunReason::common:
      text << "no more than others";
      return;
    case OverrunReason::fast:
      text << "being fast: up to " << std::setprecision(2) << busy.free_path
           << " m between two, mostly with " << partner;
      return;
  }
  assert(false);
}

}  // namespace

Overrun overrun_of(const World& world, const EventBudget& budget) {
  assert(budget.is_exceeded());
  const std::vector<ChargedEvent> events = budget.recent();
  Overrun overrun{.time = world.now(),
                  .events = budget.spent(),
                  .events_per_s = budget.events_per_s(),
                  .looked_at = events.size(),
                  .span = events.back().time - events.front().time};
  const std::map<std::uint32_t, Tally> tallies = tallies_of(events);
  std::vector<std::pair<std::size_t, std::uint32_t>> order;
  for (const auto& [body, tally] : tallies)
    if (std::isfinite(world.mass({body}))) order.emplace_back(tally.events, body);
  std::ranges::stable_sort(order, [](const auto& a, const auto& b) { return a.first > b.first; });
  order.resize(std::min(order.size(), Overrun::busiest_max));
  const Real speed = greatest_speed(world, tallies);
  for (const auto& [count, body] : order)
    overrun.busiest.push_back(busy_body(world, body, tallies.at(body), overrun, speed));
  return overrun;
}

std::string text_of(const Overrun& overrun) {
  std::ostringstream text;
  text << overrun.events << " events within a simulated second where " << overrun.events_per_s
       << " may be, at " << std::setprecision(17) << static_cast<double>(overrun.time)
       << " s; the last " << overrun.looked_at << " took " << std::setprecision(2)
       << static_cast<double>(overrun.span) << " s";
  for (const BusyBody& busy : overrun.busiest) write(text << "; ", busy);
  return text.str();
}

}  // namespace rink::physics::inline RINK_PRECISION
