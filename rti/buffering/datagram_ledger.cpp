// Settling and losing datagrams.
#include "rti/buffering/datagram_ledger.h"

#include <algorithm>
#include <unordered_map>

namespace rink::rti {

std::uint32_t DatagramLedger::begin(double now) {
  if (size_ == ring_.size()) {
    std::vector<Entry> larger(std::max<std::size_t>(8, 2 * ring_.size()));
    for (std::uint32_t number = oldest(); number != next_; ++number) larger[number & (larger.size() - 1)] = std::move(at(number));
    ring_.swap(larger);
  }
  Entry& entry = at(next_);
  entry.sent_s = now;
  entry.is_settled = false;
  entry.said.clear();
  if (!unanswered_since_) unanswered_since_ = now;
  ++size_;
  return next_++;
}

void DatagramLedger::carry(AttributeSet attributes, std::span<const std::uint32_t> handles) {
  std::vector<std::uint32_t>& said = at(next_ - 1).said;
  said.push_back(attributes.bits);
  said.push_back(static_cast<std::uint32_t>(handles.size()));
  said.insert(said.end(), handles.begin(), handles.end());
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
  if (entry.said.empty()) return;
  // Rare, so it may search: what later datagrams say of the same objects is looked up only when one is lost.
  std::unordered_map<std::uint32_t, std::uint32_t> said_later;
  const auto for_each = [](const Entry& each, auto visit) {
    for (std::size_t i = 0; i < each.said.size(); i += 2 + each.said[i + 1])
      for (std::uint32_t k = 0; k < each.said[i + 1]; ++k) visit(each.said[i + 2 + k], each.said[i]);
  };
  for (std::uint32_t later = number + 1; later != next_; ++later) for_each(at(later), [&](std::uint32_t handle, std::uint32_t bits) { said_later[handle] |= bits; });
  for_each(entry, [&](std::uint32_t handle, std::uint32_t bits) {
    const auto found = said_later.find(handle);
    const std::uint32_t missing = found == said_later.end() ? bits : bits & ~found->second;
    if (missing != 0) lost.push_back({handle, AttributeSet(missing)});
  });
}

void DatagramLedger::forget_settled() {
  while (size_ > 0 && at(oldest()).is_settled) --size_;
}

}  // namespace rink::rti
