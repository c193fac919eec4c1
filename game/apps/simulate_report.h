// The output of rink simulate: states and events as CSV, and a summary as JSON.
#pragma once

#include <optional>
#include <ostream>
#include <span>
#include <string>

#include "game/control/game.h"
#include "game/control/goal_rate.h"
#include "game/physics/event_budget.h"

namespace rink::game {

/// kind,id,x,y,vx,vy of every entity at now(), in SI with 17 digits, which read back to the same
/// bits.
void write_states(std::ostream& stream, const Game& game);

/// The heading of the events' file: time,kind,body,other.
void write_events_heading(std::ostream& stream);
/// One line per event, times with 17 digits; `other` is empty where only one body, or a part of the
/// field, is concerned.
void write_events(std::ostream& stream, std::span<const physics::Event> events);

/// Counts, energies, momentum, overlap, escapes, score and hash as one JSON object with its
/// `schema`. `wall_s` is how long the run took. If a `budget` is given, the object also says
/// whether it was exceeded, by which bodies and why.
std::string summary_of(const Game& game, const physics::SimulatorChoice& engine, double wall_s,
                       const std::optional<physics::EventBudget>& budget);

/// What `plan`'s games came to, as one JSON object with its `schema`.
std::string summary_of(const Scene& scene, const GoalRatePlan& plan, const GoalRate& rate);

}  // namespace rink::game
