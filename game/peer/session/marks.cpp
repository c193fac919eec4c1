// Digests rounds and states, and compares them.
#include "game/peer/session/marks.h"

#include <algorithm>
#include <cassert>

#include "im/basics/fnv_hash.h"

namespace rink::peer {

namespace {

std::uint64_t digest_of(std::span<const std::vector<std::uint8_t>> words) {
  Fnv64 hash;
  for (const std::vector<std::uint8_t>& word : words)
    for (const std::uint8_t byte : word) hash.add(byte);
  return hash.value();
}

Mark mark_of(const State& state) {
  return {state.step, 0, digest_of({{written(Entry{.state = state})}})};
}

}  // namespace

void Marks::note_round(std::uint64_t step, std::span<const std::vector<std::uint8_t>> words) {
  const bool is_first = rounds_.empty() || rounds_.back().step != step;
  rounds_.push_back({step, is_first ? 1 : rounds_.back().round + 1, digest_of(words)});
  if (rounds_.size() > 2) rounds_.erase(rounds_.begin());
  assert(rounds_.size() <= 2 && rounds_.back().round > 0);
}

std::vector<Mark> Marks::told(const State& now, const State& before) const {
  std::vector<Mark> marks = rounds_;
  marks.push_back(mark_of(now));
  if (before.step != now.step) marks.push_back(mark_of(before));
  return marks;
}

bool Marks::differ(std::span<const Mark> own, std::span<const Mark> others) {
  return std::ranges::any_of(others, [&](const Mark& other) {
    return std::ranges::any_of(own, [&](const Mark& mark) {
      return mark.step == other.step && mark.round == other.round && mark.digest != other.digest;
    });
  });
}

}  // namespace rink::peer
