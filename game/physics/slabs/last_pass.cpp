// A tile without edges, and the engine for all that a tile does not know.
#include "game/physics/slabs/last_pass.h"

#include <algorithm>
#include <cassert>

namespace rink::physics::inline RINK_PRECISION {

LastPass::LastPass(Engine& engine, SharedWindow& shared, std::uint32_t number, std::uint32_t count)
    : engine_(engine),
      parts_(engine.parts()),
      shared_(shared),
      tile_(parts_, shared, number, count),
      images_(parts_.bodies, parts_.history, parts_.jams, parts_.bodies.count()) {}

void LastPass::begin_window() {
  tile_.begin_window();
  images_.begin();
  orders_.clear();
  solver_failed_ = false;
  goal_ = infinity;
  played_ = 0;
}

void LastPass::play() {
  NextEvents& events = parts_.events;
  EventOrder latest{-1.0, 0, 0};
  for (std::uint32_t body = events.first(shared_.end); body != NextEvents::none && !solver_failed_;
       body = events.first(shared_.end)) {
    const EventOrder order = events.order_of(body);
    // Brought about by one of its own instant: no order of times and ids tells when it came. That
    // matters to all but crossings, which move nothing.
    if (precedes(order, latest) && !crosses(body)) return void(solver_failed_ = true);
    latest = std::max(latest, order, precedes);
    if (scores(body)) return void(goal_ = order.time);
    ++played_;
    if (!tile_.play_first_of_all(body)) process(body, order);
  }
}

/// Whether that is its next event.
bool LastPass::crosses(std::uint32_t body) const {
  return parts_.events[body].crossing_time < parts_.events[body].impact_time;
}

/// The same of a goal.
bool LastPass::scores(std::uint32_t body) const {
  return parts_.events[body].partner == partner::goal_line && !crosses(body);
}

void LastPass::process(std::uint32_t body, const EventOrder& order) {
  const NextEvent& slot = parts_.events[body];
  const Partner partner = slot.partner;
  const bool crosses = this->crosses(body);
  const bool is_stale =
      !crosses && is_body(partner) && parts_.bodies[partner].version != slot.partner_version;
  const bool is_late = tile_.mark(body, crosses ? partner::none : partner, order.time);
  if (!crosses && !is_stale && is_body(partner) && !tile_.put_back(partner, order.time))
    solver_failed_ = true;
  const Counters before = parts_.record.counters();
  changed_.clear();
  time_ = order.time;
  parts_.observers = {this, shared_.observers.journal};
  parts_.ledger.postpone(&transfers_);
  engine_.process(body, order.time);
  parts_.ledger.postpone(nullptr);
  parts_.observers = {};
  tile_.impact().journal().take(order);
  for (const EnergyTransfer& transfer : transfers_)
    tile_.impact().book().push_back({order, transfer});
  transfers_.clear();
  const Counters& after = parts_.record.counters();
  orders_.resize(parts_.record.events().size(), order);
  if (const std::uint64_t count = after.recordable() - before.recordable();
      count > 0 && shared_.is_charged)
    tile_.impact().charged().push_back(
        {.time = order.time, .body = order.lower, .partner = order.higher, .count = count});
  if (crosses) tile_.note_speed(body);
  for (const std::uint32_t other : changed_) {
    tile_.note_speed(other);
    if (parts_.places.grid().is_listed(other)) tile_.mark(other, partner::none, order.time);
  }
  const bool is_usual = after.hops == before.hops && after.freezes == before.freezes &&
                        after.rests == before.rests &&
                        after.joint_impacts == before.joint_impacts && changed_.size() <= 2;
  if (!is_usual || parts_.clock.solver_failed) solver_failed_ = true;
  if (crosses) tile_.mark(body, partner::none, order.time);  // the cell that it came to
  if (!is_late) return;
  if (crosses || is_stale) tile_.note_late(body, order.time);
  for (const std::uint32_t other : changed_) tile_.note_late(other, order.time);
}

void LastPass::keep(std::uint32_t body) {
  images_.keep(body);
  replace(body, parts_.bodies[body], parts_.bodies[body].version);
}

/// A free impact tells when it is over.
void LastPass::keep_flight(std::uint32_t body, const Flight& flight) {
  replace(body, flight, parts_.bodies[body].version - 1);
}

void LastPass::keep_state(std::uint32_t body, const BodyState& before) {
  images_.keep_state(body, before);
  replace(body, before.flight, parts_.bodies[body].version - 1);
}

void LastPass::replace(std::uint32_t body, const Flight& flight, std::uint32_t version) {
  if (std::find(changed_.begin(), changed_.end(), body) != changed_.end()) return;
  changed_.push_back(body);
  tile_.courses().replace(body, flight, version, time_, shared_.latest[body]);
}

}  // namespace rink::physics::inline RINK_PRECISION
