// Settling and losing datagrams.
#include "rti/buffering/datagram_ledger.h"

#include <algorithm>
#include <unordered_map>

namespace rink::rti {

DatagramLedger::~DatagramLedger() {
  while (size_ > 0) drop_oldest();
}

std::uint32_t DatagramLedger::note(double now, SaidLists::Number said) {
  if (size_ == ring_.size()) {
    std::vector<Entry> larger(std::max<std::size_t>(8, 2 * ring_.size()));
    for (std::uint32_t number = oldest(); number != next_; ++number) larger[number & (larger.size() - 1)] = at(number);
    ring_.swap(larger);
  }
  at(next_) = {.sent_s = now, .said = said, .is_settled = false};
  if (!unanswered_since_) unanswered_since_ = now;
  if (size_++ == 0) oldest_sent_s_ = now;
  return next_++;
}

void DatagramLedger::drop_oldest() {
  const Entry& entry = at(oldest());
  if (entry.said != SaidLists::none) lists_->release(entry.said);
  if (--size_ > 0) oldest_sent_s_ = at(oldest()).sent_s;
}

bool DatagramLedger::acknowledge(const AcknowledgeDatagramsMessage& message, double now, std::vector<Lost>& lost) {
  if (message.newest == 0 || message.newest >= next_) return false;
  unanswered_since_.reset();
  if (message.newest - oldest() < size_) {
    const double trip_s = now - at(message.newest).sent_s;
    smoothed_s_ = std::max(trip_s, 0.875 * smoothed_s_ + 0.125 * trip_s);
  }
  for (std::uint32_t number = oldest(); number != next_ && number <= message.newest; ++number) {
    if (at(number).is_settled) continue;
    if (message.has(number)) at(number).is_settled = true;
    else if (message.newest - number >= overtaken_by) lose(number, lost);
  }
  forget_settled();
  if (size_ > 0) unanswered_since_ = now;
  return true;
}

void DatagramLedger::expire(double now, std::vector<Lost>& lost) {
  const double patience_s = 0.1 + DatagramReceipts::longest_delay_s + 2.0 * smoothed_s_;
  if (size_ == 0 || now - oldest_sent_s_ <= patience_s) return;
  for (std::uint32_t number = oldest(); number != next_ && now - at(number).sent_s > patience_s; ++number)
    if (!at(number).is_settled) lose(number, lost);
  forget_settled();
}

void DatagramLedger::abandon(std::vector<Lost>& lost) {
  for (std::uint32_t number = oldest(); number != next_; ++number)
    if (!at(number).is_settled) lose(number, lost);
  forget_settled();
  unanswered_since_.reset();
}

void DatagramLedger::lose(std::uint32_t number, std::vector<Lost>& lost) {
  Entry& entry = at(number);
  entry.is_settled = true;
  // Rare, so it may search: what later datagrams say of the same objects is looked up only when one is lost.
  std::unordered_map<std::uint32_t, std::uint32_t> said_later;
  for (std::uint32_t later = number + 1; later != next_; ++later)
    for_each_said(groups(at(later)), [&](std::uint32_t handle, AttributeSet set) { said_later[handle] |= set.bits; });
  for_each_said(groups(entry), [&](std::uint32_t handle, AttributeSet set) {
    const auto found = said_later.find(handle);
    const std::uint32_t missing = found == said_later.end() ? set.bits : set.bits & ~found->second;
    if (missing != 0) lost.push_back({handle, AttributeSet(missing)});
  });
}

void DatagramLedger::forget_settled() {
  while (size_ > 0 && at(oldest()).is_settled) drop_oldest();
}

}  // namespace rink::rti
