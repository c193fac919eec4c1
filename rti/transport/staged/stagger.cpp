// Holds writes until their slot's time has come.
#include "rti/transport/staged/stagger.h"

#include <algorithm>
#include <cassert>
#include <cstring>

#include "im/basics/checked.h"

namespace rink::rti {

void Stagger::poll(std::chrono::nanoseconds longest_wait, TransportListener& listener) {
  const double now = now_s_();
  release(now);
  if (slots_taken_ > 0) {
    const auto next = std::ranges::find_if(slots_, [](const auto& slot) { return !slot.empty(); });
    assert(next != slots_.end());
    const double wait_s =
        std::max(0.0, due_s(static_cast<std::size_t>(next - slots_.begin())) - now);
    longest_wait =
        std::min(longest_wait, std::chrono::nanoseconds(static_cast<std::int64_t>(wait_s * 1e9)));
  }
  poll_unnotified(longest_wait, listener);
  if (slots_taken_ > 0) release(now_s_());
}

void Stagger::send(ConnectionId connection, std::span<const Bytes> parts) {
  std::size_t size = 0;
  for (const Bytes part : parts) size += part.size();
  if (size == 0) return;
  const double now = now_s_();
  if (window_s_ <= 0.0) {
    measure(size, now);
    return TransportStage::send(connection, parts);
  }
  if (connection >= waiting_.size())
    waiting_.resize(connection + 1), joined_writes_.resize(connection + 1);
  std::vector<std::byte>& waiting = waiting_[connection];
  if (!waiting.empty()) {
    ++joined_writes_[connection];
  } else {
    if (slots_taken_ == 0) begun_s_ = now;
    std::vector<ConnectionId>& slot = slots_[connection % slot_count];
    if (slot.empty()) ++slots_taken_;
    slot.push_back(connection);
  }
  std::size_t at = waiting.size();
  waiting.resize(at + size);
  for (const Bytes part : parts) {
    if (part.empty()) continue;
    std::memcpy(waiting.data() + at, part.data(), part.size());
    at += part.size();
  }
  assert(at == waiting.size());
  if constexpr (checks_whole_structures) check();
}

void Stagger::check() const {
  assert(waiting_.size() == joined_writes_.size());
  [[maybe_unused]] std::size_t taken = 0;
  for (std::size_t slot = 0; slot < slot_count; ++slot) {
    taken += slots_[slot].empty() ? 0u : 1u;
    for ([[maybe_unused]] const ConnectionId connection : slots_[slot])
      assert(connection % slot_count == slot && connection < waiting_.size());
  }
  assert(taken == slots_taken_);
  for (ConnectionId connection = 0; connection < waiting_.size(); ++connection)
    assert(waiting_[connection].empty() ||
           std::ranges::find(slots_[connection % slot_count], connection) !=
               slots_[connection % slot_count].end());
}

void Stagger::release(double now) {
  bool has_given = false;
  for (std::size_t slot = 0; slot < slot_count && slots_taken_ > 0 && due_s(slot) <= now; ++slot) {
    if (slots_[slot].empty()) continue;
    for (const ConnectionId connection : slots_[slot]) give_waiting(connection, now);
    slots_[slot].clear();
    --slots_taken_;
    has_given = true;
  }
  if (has_given) TransportStage::push();
}

void Stagger::give_waiting(ConnectionId connection, double now) {
  assert(connection < waiting_.size());
  const Bytes bytes = waiting_[connection];
  if (bytes.empty()) return;  // closed since
  measure(bytes.size(), now);
  TransportStage::send(connection, std::span(&bytes, 1));
  waiting_[connection].clear();
}

void Stagger::measure(std::size_t size, double now) {
  if (now - burst_begun_s_ >= burst_s) {
    burst_begun_s_ = now;
    burst_bytes_ = 0;
  }
  burst_bytes_ += size;
  burst_bytes_max_ = std::max(burst_bytes_max_, burst_bytes_);
}

void Stagger::close(ConnectionId connection) {
  if (connection < waiting_.size()) give_waiting(connection, now_s_());
  TransportStage::close(connection);
}

TransportCounters Stagger::counters(ConnectionId connection) const {
  TransportCounters counters = TransportStage::counters(connection);
  if (connection < joined_writes_.size()) counters.writes += joined_writes_[connection];
  return counters;
}

void Stagger::push() {
  if (slots_taken_ > 0) release(now_s_());
  TransportStage::push();
}

}  // namespace rink::rti
