// A share of a second's events for each tick, small enough that ticks come in time.
#include "game/net/server/tick_budget.h"

#include <algorithm>
#include <cassert>
#include <sstream>

#include "game/physics/overrun.h"

namespace rink::game {

std::string text_of(const TickBudgetCounters& counters) {
  std::ostringstream text;
  text << counters.ticks_cut_short << " ticks were cut short, and the game fell "
       << counters.wanted_s - counters.played_s << " s behind";
  return text.str();
}

TickBudget::TickBudget(const TickBudgetSettings& settings) : settings_(settings) {
  assert(settings.tick_s > 0.0);
  begin();
}

void TickBudget::begin() {
  if (settings_.events_per_s > 0) events_.emplace(settings_.events_per_s);
}

std::uint64_t TickBudget::share() const {
  constexpr double part = 0.25;  // of a tick's
  const double events = part * settings_.tick_s * static_cast<double>(settings_.events_per_s);
  return std::max(std::uint64_t{1}, static_cast<std::uint64_t>(events));
}

bool TickBudget::advance(Game& game, double until) {
  if (!events_) {
    game.advance(until);
    return true;
  }
  if (events_->is_exceeded()) events_->grant(share());
  const double begin = game.now();
  const bool goes_on = settings_.has_whole_ticks && game.is_cut_short(),
             has_arrived = game.advance(until, *events_);
  assert(begin <= game.now() && game.now() <= until);
  if (!has_arrived) ++counters_.ticks_cut_short;
  if (!has_arrived || goes_on) {
    counters_.played_s += game.now() - begin;
    counters_.wanted_s += settings_.has_whole_ticks ? settings_.tick_s : until - begin;
  }
  if (counters_.ticks_cut_short >= said_at_) say(game);
  return has_arrived;
}

void TickBudget::say(const Game& game) {
  said_at_ *= 10;
  std::ostringstream text;
  if (counters_.ticks_cut_short == 1)
    text << physics::text_of(physics::overrun_of(game.world(), *events_))
         << "; the game goes on more slowly, by at most " << share() << " events a tick"
         << (settings_.has_whole_ticks ? ", and shows ticks only once they are played" : "");
  else
    text << "the game goes on at " << counters_.pace()
         << " of its pace: " << counters_.ticks_cut_short << " ticks were cut short, " << game.now()
         << " s are played";
  complaint_ = text.str();
}

}  // namespace rink::game
