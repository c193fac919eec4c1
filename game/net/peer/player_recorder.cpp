// Records a player's scope as changes, and its replicas as samples.
#include "game/net/peer/player_recorder.h"

#include <algorithm>

namespace rink::game {

namespace {

constexpr double window_s =
    0.05;  ///< over which updates are counted for a sample: that of the bots of a server

}  // namespace

void PlayerRecorder::note_commit(double instant_s, double matched_s) {
  matched_s_ = matched_s;
  interest_.list_scope(listed_);
  std::sort(listed_.begin(), listed_.end());
  const auto note = [&](const std::vector<std::uint32_t>& these,
                        const std::vector<std::uint32_t>& others, bool is_in) {
    for (const std::uint32_t body : these)
      if (!std::binary_search(others.begin(), others.end(), body))
        trace_.bots.front().changes.push_back({instant_s, body, is_in});
  };
  note(scope_, listed_, false);
  note(listed_, scope_, true);
  scope_ = listed_;
  matched_.clear();
  for (const std::uint32_t body : scope_)
    matched_.push_back(interest_.position_at(body, matched_s_));
  for (const PeerReplicas::Received& received : interest_.replicas().received())
    received_.emplace_back(instant_s, received);
  interest_.replicas().forget_received();
  std::erase_if(received_,
                [&](const auto& received) { return received.first <= instant_s - 2.0 * window_s; });
}

void PlayerRecorder::sample(double instant_s) {
  std::erase_if(received_,
                [&](const auto& received) { return received.first <= instant_s - window_s; });
  const std::size_t first = trace_.replicas.size();
  for (std::size_t k = 0; k < scope_.size(); ++k)
    trace_.replicas.push_back({.object = scope_[k],
                               .bytes = 0,
                               .is_in_scope = true,
                               .matched = matched_[k],
                               .displayed = interest_.position_at(scope_[k], instant_s)});
  for (const auto& [heard_s, received] : received_) {
    const auto place = std::lower_bound(scope_.begin(), scope_.end(), received.body);
    if (place != scope_.end() && *place == received.body)
      trace_.replicas[first + static_cast<std::size_t>(place - scope_.begin())].bytes +=
          received.bytes;
    else trace_.replicas.push_back({.object = received.body, .bytes = received.bytes});
  }
  trace_.samples.push_back({.displayed_s = instant_s,
                            .matched_s = matched_s_,
                            .window_s = window_s,
                            .first = first,
                            .last = trace_.replicas.size()});
}

}  // namespace rink::game
