// Settles acknowledged datagrams and finds those that are lost.
#include "rti/buffering/datagram_ledger.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <unordered_map>

#include "im/basics/checked.h"

namespace rink::rti {

DatagramLedger::~DatagramLedger() {
  while (size_ > 0) drop_oldest();
}

std::uint32_t DatagramLedger::note(double now, SentRecordPool::Number sent) {
  if (size_ == ring_.size()) {
    std::vector<Entry> larger(std::max<std::size_t>(8, 2 * ring_.size()));
    for (std::uint32_t number = oldest(); number != next_; ++number)
      larger[number & (larger.size() - 1)] = at(number);
    ring_.swap(larger);
  }
  assert(std::has_single_bit(ring_.size()) && size_ < ring_.size());
  at(next_) = {.sent_s = now, .sent = sent, .is_settled = false};
  if (!unanswered_since_) unanswered_since_ = now;
  if (size_++ == 0) oldest_sent_s_ = now;
  return next_++;
}

void DatagramLedger::drop_oldest() {
  assert(size_ > 0);
  const Entry& entry = at(oldest());
  if (entry.sent != SentRecordPool::none) lists_->release(entry.sent);
  if (--size_ > 0) oldest_sent_s_ = at(oldest()).sent_s;
}

/// Goes from the newest back to the oldest, so that what later datagrams carry of the same objects
/// is gathered once, however many are lost. Losses are rare, so this may allocate.
template <class IsLost>
void DatagramLedger::lose(IsLost is_lost, std::vector<Lost>& lost) {
  std::unordered_map<std::uint32_t, AttributeSet> sent_later;
  for (std::uint32_t number = next_ - 1; number != oldest() - 1; --number) {
    Entry& entry = at(number);
    const bool is_given_up = !entry.is_settled && is_lost(number);
    entry.is_settled |= is_given_up;
    for_each_sent(groups(entry), [&](std::uint32_t handle, AttributeSet set) {
      AttributeSet& later = sent_later[handle];
      const AttributeSet missing = set.without(later);
      if (is_given_up && !missing.is_empty()) lost.push_back({handle, missing});
      later = later | set;
    });
  }
}

bool DatagramLedger::acknowledge(const AcknowledgeDatagramsMessage& message, double now,
                                 std::vector<Lost>& lost) {
  if (message.newest == 0 || message.newest >= next_) return false;
  unanswered_since_.reset();
  if (message.newest - oldest() < size_) {
    const double trip_s = now - at(message.newest).sent_s;
    smoothed_s_ = std::max(trip_s, 0.875 * smoothed_s_ + 0.125 * trip_s);
  }
  bool is_overtaken = false;
  for (std::uint32_t number = oldest(); number != next_ && number <= message.newest; ++number) {
    if (at(number).is_settled) continue;
    if (message.has(number)) at(number).is_settled = true;
    else is_overtaken |= message.newest - number >= overtaken_by;
  }
  if (is_overtaken)
    lose(
        [&](std::uint32_t number) {
          return number <= message.newest && message.newest - number >= overtaken_by;
        },
        lost);
  forget_settled();
  if (size_ > 0) unanswered_since_ = now;
  return true;
}

void DatagramLedger::expire(double now, std::vector<Lost>& lost) {
  const double patience_s = 0.1 + DatagramReceipts::longest_delay_s + 2.0 * smoothed_s_;
  if (size_ == 0 || now - oldest_sent_s_ <= patience_s) return;
  smoothed_s_ =
      std::min(1.0, 2.0 * std::max(smoothed_s_,
                                   0.05));  // an acknowledgement after giving up is never timed
  lose([&](std::uint32_t number) { return now - at(number).sent_s > patience_s; }, lost);
  forget_settled();
}

void DatagramLedger::abandon(std::vector<Lost>& lost) {
  lose([](std::uint32_t) { return true; }, lost);
  forget_settled();
  unanswered_since_.reset();
}

void DatagramLedger::forget_settled() {
  while (size_ > 0 && at(oldest()).is_settled) drop_oldest();
  if constexpr (checks_whole_structures) check();
}

void DatagramLedger::check() const {
  assert(size_ <= ring_.size());
  if (size_ == 0) return;
  assert(std::has_single_bit(ring_.size()));
  assert(!at(oldest()).is_settled && at(oldest()).sent_s == oldest_sent_s_);
  for (std::uint32_t number = oldest(); number != next_; ++number)
    groups(at(number));  // which asserts that the list is held
}

}  // namespace rink::rti
