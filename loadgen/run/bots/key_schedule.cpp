// Lists each bot's keys once, so that a turn costs what is due and not the plan of all.
#include "loadgen/run/bots/key_schedule.h"

#include <cassert>

namespace rink::loadgen {

KeySchedule::KeySchedule(std::span<const game::InputEvent> plan, const PlanPart& part) {
  for (const game::InputEvent& event : plan) {
    const bool is_key =
        event.kind == game::InputKind::key_down || event.kind == game::InputKind::key_up;
    if (!is_key || event.player < part.first || event.player - part.first >= part.count ||
        event.time >= part.until_s || (part.begun_s > 0.0 && event.time <= part.begun_s))
      continue;
    keys_.push_back({event.time,
                     event.player - part.first,
                     {event.key, event.kind == game::InputKind::key_down}});
  }
  list_by_bot(part.count);
}

void KeySchedule::list_by_bot(std::uint32_t bot_count) {
  end_of_bot_.resize(bot_count);
  for (const DueKey& key : keys_) ++end_of_bot_[key.bot];
  std::uint32_t begin = 0;
  for (std::uint32_t& end : end_of_bot_) {
    const std::uint32_t count = end;
    next_of_bot_.push_back(begin);
    end = begin;
    begin += count;
  }
  by_bot_.resize(keys_.size());
  for (std::uint32_t number = 0; number < keys_.size(); ++number)
    by_bot_[end_of_bot_[keys_[number].bot]++] = number;
}

std::optional<double> KeySchedule::next_s() const {
  return next_ < keys_.size() ? std::optional(keys_[next_].time) : std::nullopt;
}

const DueKey& KeySchedule::take() {
  assert(next_ < keys_.size());
  return keys_[next_++];
}

const DueKey* KeySchedule::take_due(std::uint32_t bot, double instant) {
  if (bot >= next_of_bot_.size() || next_of_bot_[bot] == end_of_bot_[bot]) return nullptr;
  const DueKey& key = keys_[by_bot_[next_of_bot_[bot]]];
  if (key.time > instant) return nullptr;
  ++next_of_bot_[bot];
  return &key;
}

}  // namespace rink::loadgen
