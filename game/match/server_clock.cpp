// Estimates use the latest recent arrival and the longest recent round trip, so that keys are
// seldom late and updates seldom missing; stalled samples are left out.
#include "game/match/server_clock.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <functional>
#include <limits>

#include "im/basics/checked.h"

namespace rink::game {
namespace {

double slewed(double from, double to, double most, double jump_from) {
  assert(most >= 0.0 && jump_from >= 0.0);
  return std::abs(to - from) > jump_from ? to : std::clamp(to, from - most, from + most);
}

}  // namespace

std::optional<std::uint64_t> ServerClock::ask(double now_s) {
  if (now_s < next_at_s_) return std::nullopt;
  // The first few follow quickly: a single one would neither show the spread nor which of them a
  // window that is still opening has delayed.
  next_at_s_ = now_s + (next_ <= hasty ? 0.1 : 1.0) * question_period;
  questions_.push_back({next_, now_s, false});
  while (questions_.size() > 2 * remembered) questions_.pop_front();
  assert(next_at_s_ > now_s);
  return next_++;
}

void ServerClock::answered(std::uint64_t number, double server_s, double now_s) {
  const auto question =
      std::find_if(questions_.begin(), questions_.end(),
                   [number](const Question& asked) { return asked.number == number; });
  if (question == questions_.end() || question->is_answered || !std::isfinite(server_s)) return;
  assert(now_s >= question->sent_s && "an answer follows its question");
  question->is_answered = true;
  const Answer answer{.offset = server_s - question->sent_s + margin,
                      .round_trip = now_s - question->sent_s};
  if (!answers_.empty())
    jitter_ += (std::abs(answer.round_trip - answers_.back().round_trip) - jitter_) / 16.0;
  answers_.push_back(answer);
  while (answers_.size() > remembered) answers_.pop_front();
  advance(now_s);
  if constexpr (checks_whole_structures) check();
}

void ServerClock::check() const {
  assert(questions_.size() <= 2 * remembered && answers_.size() <= remembered);
  assert(std::ranges::adjacent_find(questions_, std::greater_equal<>(), &Question::number) ==
         questions_.end());
  assert(std::ranges::all_of(questions_, [this](const Question& q) { return q.number < next_; }));
  assert(std::ranges::is_sorted(questions_, {}, &Question::sent_s));
  assert(std::ranges::none_of(answers_, [](const Answer& a) { return a.round_trip < 0.0; }));
  assert(is_set() != is_first_ && "the first answer sets the estimates");
  assert(round_trip_ >= 0.0 && jitter_ >= 0.0);
}

void ServerClock::advance(double now_s) {
  const double most = slew * std::max(0.0, now_s - now_s_);
  now_s_ = now_s;
  if (answers_.empty()) return;
  std::array<double, remembered> trips{};
  const auto middle = trips.begin() + static_cast<std::ptrdiff_t>(answers_.size() / 2);
  const auto end = std::ranges::transform(answers_, trips.begin(), &Answer::round_trip).out;
  std::nth_element(trips.begin(), middle, end);
  // A stopped process or a redrawn window delays samples: counting on them would delay all that
  // follows by as much.
  const double held_up_from = held_up_times * *middle + held_up_more;
  double offset = -std::numeric_limits<double>::infinity(), round_trip = 0.0;
  for (const Answer& answer : answers_) {
    if (answer.round_trip > held_up_from) continue;
    offset = std::max(offset, answer.offset);
    round_trip = std::max(round_trip, answer.round_trip);
  }
  assert(std::isfinite(offset) && "the middle answer always counts");
  offset_ = is_first_ ? offset : slewed(offset_, offset, most, jump_from);
  round_trip_ = is_first_ ? round_trip : slewed(round_trip_, round_trip, most, jump_from);
  is_first_ = false;
}

double ServerClock::loss() const {
  std::size_t asked = 0, lost = 0;
  for (const Question& question : questions_) {
    if (question.is_answered || now_s_ - question.sent_s > 1.0) ++asked;
    if (!question.is_answered && now_s_ - question.sent_s > 1.0) ++lost;
  }
  assert(lost <= asked);
  return asked == 0 ? 0.0 : static_cast<double>(lost) / static_cast<double>(asked);
}

}  // namespace rink::game
