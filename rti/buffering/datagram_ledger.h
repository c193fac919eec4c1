// The contents of datagrams that were sent and not yet acknowledged, so that the newest state of
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

/// The ledger of one destination. It keeps only the handles in a datagram: a repair sends the
/// newest state, not what was lost. Destinations that are sent the same share one list in `lists`,
/// which must outlive the ledger. An entry takes 16 bytes: with 1,000 destinations it is memory
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

  /// Notes the next datagram and returns its number. `now` [s]; `sent` names its contents and is
  /// held for this ledger.
  std::uint32_t note(double now, SentRecordPool::Number sent = SentRecordPool::none);

  /// Settles datagrams that have arrived. One that three later arrivals have overtaken, or that is
  /// too old for an acknowledgement to name, is lost: its contents are appended to `lost`, unless a
  /// later datagram has the same attributes of the same object. False if the message acknowledges a
  /// datagram that was never sent.
  bool acknowledge(const AcknowledgeDatagramsMessage& message, double now, std::vector<Lost>& lost);
  /// Gives up datagrams that were sent longer ago than any round trip took, as above.
  void expire(double now, std::vector<Lost>& lost);
  /// Gives up all that is unacknowledged, since the channel has closed.
  void abandon(std::vector<Lost>& lost);

  /// The time since which everything has gone unanswered [s]; nothing if all is settled or an
  /// answer came since.
  std::optional<double> unanswered_since() const { return unanswered_since_; }
  std::size_t unsettled() const { return size_; }
  /// Asserts that the ring has the unacknowledged datagrams from the oldest on, and that their
  /// lists are held.
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
  /// Gives up the datagrams for which `is_lost(number)` is true, asked from the newest unsettled
  /// one back to the oldest.
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
