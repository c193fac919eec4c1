// What is in the datagrams that were sent and not yet acknowledged, so that the newest state of
// what got lost can be sent again.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "rti/buffering/sent_records.h"
#include "rti/types.h"
#include "rti/wire/datagram.h"

namespace rink::rti {

/// Of one destination. What a datagram says is kept as handles only: what is sent again is the
/// newest state then, not what was lost. Of what many are sent alike, there is one list for all, in
/// `lists`, which must outlive it. An entry takes 16 bytes: with 1,000 destinations it is memory
/// that costs, not work.
class DatagramLedger {
 public:
  explicit DatagramLedger(SentRecordPool& lists) : lists_(&lists) {}
  ~DatagramLedger();
  DatagramLedger(const DatagramLedger&) = delete;
  DatagramLedger& operator=(const DatagramLedger&) = delete;

  /// An object whose state may not have arrived.
  struct Lost {
    std::uint32_t handle;
    AttributeSet attributes;
  };

  /// Notes the next datagram and returns its number. `now` [s]; `sent` names what it says and is
  /// held for us.
  std::uint32_t note(double now, SentRecordPool::Number sent = SentRecordPool::none);

  /// Settles what has arrived. What is overtaken by three that have arrived, or too old to be told,
  /// is lost: appended to `lost`, unless a later datagram says the same attributes of the same
  /// object. False if it acknowledges what was never sent.
  bool acknowledge(const AcknowledgeDatagramsMessage& message, double now, std::vector<Lost>& lost);
  /// The same for what was sent longer ago than a round trip ever took.
  void expire(double now, std::vector<Lost>& lost);
  /// All that is unsettled is lost: there is no way any more.
  void abandon(std::vector<Lost>& lost);

  /// Since when everything has gone unanswered [s]; nothing if all is settled or an answer came
  /// since.
  std::optional<double> unanswered_since() const { return unanswered_since_; }
  std::size_t unsettled() const { return size_; }
  /// Asserts that the ring holds what is unsettled, from the oldest on, and lists that are held.
  void check() const;

 private:
  struct Entry {
    double sent_s = 0.0;
    SentRecordPool::Number sent = SentRecordPool::none;
    bool is_settled = false;
  };
  static constexpr std::uint32_t overtaken_by = 3;
  Entry& at(std::uint32_t number) { return ring_[number & (ring_.size() - 1)]; }
  const Entry& at(std::uint32_t number) const { return ring_[number & (ring_.size() - 1)]; }
  std::uint32_t oldest() const { return next_ - static_cast<std::uint32_t>(size_); }
  Bytes groups(const Entry& entry) const {
    return entry.sent == SentRecordPool::none ? Bytes() : lists_->groups(entry.sent);
  }
  void drop_oldest();
  /// Of those that were given up: `is_lost(number)`, asked of all unsettled ones from the newest
  /// back to the oldest.
  template <class IsLost>
  void lose(IsLost is_lost, std::vector<Lost>& lost);
  void forget_settled();

  SentRecordPool* lists_;
  std::vector<Entry> ring_;  ///< a power of two of them
  std::uint32_t next_ = 1;   ///< number of the next datagram
  std::size_t size_ = 0;     ///< from the oldest unsettled one to the newest
  double oldest_sent_s_ = 0.0;
  double smoothed_s_ = 0.0;  ///< round trip with the receiver's delay
  std::optional<double> unanswered_since_;
};

}  // namespace rink::rti
