// The rules of Game::count_goal and Game::schedule, on numbers of bodies.
#include "game/peer/session/scoring.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <tuple>

#include "game/peer/message_bytes.h"
#include "im/basics/checked.h"

namespace rink::peer {

std::vector<std::uint8_t> written(FaceOffWord message) { return bytes_from(message); }
bool read(std::span<const std::uint8_t> bytes, FaceOffWord& message) {
  return read_whole(bytes, message);
}

void Scoring::check() const {
  assert(!is_over || face_offs.empty());
  assert(std::ranges::is_sorted(face_offs, {},
                                [](const FaceOff& due) { return std::tuple(due.time, due.puck); }));
}

void Scoring::count(std::vector<Goal> goals, const GoalRules& rules) {
  assert(rules.face_off_delay > 0.0 && (!rules.goals_to_win || *rules.goals_to_win > 0));
  std::sort(goals.begin(), goals.end(), [](const Goal& a, const Goal& b) {
    return std::tuple(a.time, a.puck) < std::tuple(b.time, b.puck);
  });
  for (const Goal& goal : goals) {
    if (is_over) return;
    std::uint32_t& scored = goal.is_left ? right : left;
    ++scored;
    is_over = rules.goals_to_win && scored >= *rules.goals_to_win;
    if (is_over) face_offs.clear(), halves = {};
    else schedule({goal.time + rules.face_off_delay, goal.puck, goal.is_left});
  }
  if constexpr (checks_whole_structures) check();
}

double Scoring::next_after(double time) const {
  const auto due = std::find_if(face_offs.begin(), face_offs.end(),
                                [time](const FaceOff& one) { return one.time > time; });
  const double back = due == face_offs.end() ? std::numeric_limits<double>::infinity() : due->time;
  return halves.next() > time ? std::min(back, halves.next()) : back;
}

void Scoring::schedule(const FaceOff& due) {
  const auto is_before = [](const FaceOff& a, const FaceOff& b) {
    return std::tuple(a.time, a.puck) < std::tuple(b.time, b.puck);
  };
  assert(std::isfinite(due.time) && !is_over);
  face_offs.insert(std::upper_bound(face_offs.begin(), face_offs.end(), due, is_before), due);
}

}  // namespace rink::peer
