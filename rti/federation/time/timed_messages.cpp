// Keeps messages in time-stamp order, and charges them to their senders.
#include "rti/federation/time/timed_messages.h"

#include <algorithm>
#include <cassert>
#include <utility>

namespace rink::rti {

namespace {

/// Limits of the memory that is used again: bytes of a body, and places once all are free. The
/// memory of a flood is freed.
constexpr std::size_t body_kept_max = 512, places_kept_max = 4096;

/// A sender's messages are searched when there are twice as many as were left the last time, but
/// not before there are these many.
constexpr std::size_t compact_least = 64, compact_bytes_least = 1u << 20;

}  // namespace

void clear(StampedMessage& message) {
  std::vector<std::byte> body = std::move(message.body);
  std::vector<StampedMessage::Receiver> receivers = std::move(message.receivers);
  body.clear();
  if (body.capacity() > body_kept_max) body = {};
  receivers.clear();
  message = {};
  message.body = std::move(body);
  message.receivers = std::move(receivers);
}

void TimedMessages::joined(std::uint32_t slot) {
  if (slot >= senders_.size()) senders_.resize(slot + 1);
  assert(senders_[slot].sent.empty());
}

void TimedMessages::left(std::uint32_t slot) {
  assert(slot < senders_.size());
  for (const Sent& each : senders_[slot].sent) {
    messages_[each.message].is_retractable = false;
    finish(each.message);
  }
  senders_[slot] = {};
}

bool TimedMessages::is_full() const {
  return messages_.size() - free_.size() >= settings_.timed_max ||
         bytes_ >= settings_.timed_bytes_max;
}

bool TimedMessages::may_be_next(std::uint32_t slot, std::uint64_t number) const {
  assert(slot < senders_.size());
  return number >= senders_[slot].next_number;
}

std::uint32_t TimedMessages::take_place() {
  if (free_.empty()) {
    messages_.emplace_back();
    return static_cast<std::uint32_t>(messages_.size() - 1);
  }
  const std::uint32_t index = free_.back();
  free_.pop_back();
  return index;
}

std::uint32_t TimedMessages::add(std::uint32_t slot, StampedMessage& message) {
  assert(may_be_next(slot, message.number) && message.receivers.empty());
  Sender& from = senders_[slot];
  const std::uint32_t index = take_place();
  std::swap(messages_[index], message);
  const StampedMessage& added = messages_[index];
  from.next_number = added.number + 1;
  from.sent.push_back({added.number, index});
  from.bytes += added.body.size();
  bytes_ += added.body.size();
  messages_[index].is_retractable = true;
  return index;
}

bool TimedMessages::is_forgetting_due(std::uint32_t slot) const {
  assert(slot < senders_.size());
  const Sender& from = senders_[slot];
  return from.sent.size() >= from.compact_at || from.bytes >= from.compact_bytes_at;
}

void TimedMessages::forget_final(std::uint32_t slot, double earliest) {
  assert(slot < senders_.size());
  Sender& from = senders_[slot];
  std::erase_if(from.sent, [&](const Sent& each) {
    if (messages_[each.message].stamp.time >= earliest) return false;
    from.bytes -= messages_[each.message].body.size();
    messages_[each.message].is_retractable = false;
    finish(each.message);
    return true;
  });
  // The search is rare, but always done where the sender's limit is passed.
  from.compact_at = std::min(std::max(compact_least, 2 * from.sent.size()),
                             settings_.timed_per_federate_max + std::size_t{1});
  from.compact_bytes_at = std::min(std::max(compact_bytes_least, 2 * from.bytes),
                                   settings_.timed_bytes_per_federate_max + 1);
}

bool TimedMessages::is_greedy(std::uint32_t slot) const {
  assert(slot < senders_.size());
  return senders_[slot].sent.size() > settings_.timed_per_federate_max ||
         senders_[slot].bytes > settings_.timed_bytes_per_federate_max;
}

std::optional<std::uint32_t> TimedMessages::retract(std::uint32_t slot, std::uint64_t number,
                                                    double earliest) {
  assert(slot < senders_.size());
  Sender& from = senders_[slot];
  const auto found = std::ranges::lower_bound(from.sent, number, {}, &Sent::number);
  if (found == from.sent.end() || found->number != number) return std::nullopt;
  const std::uint32_t index = found->message;
  StampedMessage& message = messages_[index];
  if (message.stamp.time < earliest) return std::nullopt;
  from.sent.erase(found);
  from.bytes -= message.body.size();
  message.is_retracted = true;
  message.is_retractable = false;
  return index;
}

void TimedMessages::add_receiver(std::uint32_t index, FederateHandle federate,
                                 AttributeSet attributes) {
  assert(index < messages_.size() && !messages_[index].is_distributed);
  messages_[index].receivers.push_back({federate, attributes});
}

void TimedMessages::enqueued(std::uint32_t index, std::uint32_t place) {
  StampedMessage& message = messages_[index];
  assert(place < message.receivers.size() && !message.receivers[place].is_waiting);
  message.receivers[place].is_waiting = true;
  ++message.waiting;
}

bool TimedMessages::dequeued(std::uint32_t index, std::uint32_t place) {
  StampedMessage& message = messages_[index];
  assert(place < message.receivers.size() && message.receivers[place].is_waiting);
  message.receivers[place].is_waiting = false;
  return --message.waiting == 0;
}

void TimedMessages::sent(std::uint32_t index, std::uint32_t place) {
  assert(place < messages_[index].receivers.size());
  messages_[index].receivers[place].has_it = true;
}

void TimedMessages::withdrawn(std::uint32_t index) {
  StampedMessage& message = messages_[index];
  assert(message.is_retracted);
  for (StampedMessage::Receiver& receiver : message.receivers) receiver.is_waiting = false;
  message.waiting = 0;
}

void TimedMessages::distributed(std::uint32_t index) {
  assert(!messages_[index].is_distributed);
  messages_[index].is_distributed = true;
}

void TimedMessages::finish(std::uint32_t index) {
  const StampedMessage& message = messages_[index];
  if (message.is_distributed && !message.is_retractable && message.waiting == 0) release(index);
}

void TimedMessages::release(std::uint32_t index) {
  assert(bytes_ >= messages_[index].body.size());
  bytes_ -= messages_[index].body.size();
  clear(messages_[index]);
  free_.push_back(index);
  if (free_.size() < messages_.size() || free_.size() <= places_kept_max) return;
  messages_ = {};
  free_ = {};
}

const StampedMessage& TimedMessages::operator[](std::uint32_t index) const {
  assert(index < messages_.size());
  return messages_[index];
}

}  // namespace rink::rti
