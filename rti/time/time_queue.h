// The messages that wait for one federate's time, least first.
#pragma once

#include <algorithm>
#include <functional>
#include <vector>

#include "rti/time/time_management.h"

namespace rink::rti {

/// Two heaps: what waits, and what of it was withdrawn and is struck out when it comes to the top.
/// So a retraction costs no more than a message.
class TimeQueue {
 public:
  bool is_empty() const { return waiting_.empty(); }
  /// Entries kept, withdrawn ones included.
  std::size_t size() const { return waiting_.size(); }
  /// Time stamp of the next entry, infinite if there is none.
  double next_time() const { return waiting_.empty() ? time_unbounded : waiting_.front().time; }
  void push(const TimedEntry& entry) { push(waiting_, entry); }
  /// The queue must not be empty.
  TimedEntry pop() {
    const TimedEntry entry = pop(waiting_);
    strike_out();
    return entry;
  }
  /// The entry must be waiting.
  void withdraw(const TimedEntry& entry) {
    push(withdrawn_, entry);
    strike_out();
  }

 private:
  using Heap = std::vector<TimedEntry>;
  static void push(Heap& heap, const TimedEntry& entry) {
    heap.push_back(entry);
    std::push_heap(heap.begin(), heap.end(), std::greater<>());
  }
  static TimedEntry pop(Heap& heap) {
    std::pop_heap(heap.begin(), heap.end(), std::greater<>());
    const TimedEntry entry = heap.back();
    heap.pop_back();
    return entry;
  }
  void strike_out() {
    while (!withdrawn_.empty() && waiting_.front() == withdrawn_.front()) {
      pop(waiting_);
      pop(withdrawn_);
    }
  }

  Heap waiting_, withdrawn_;
};

}  // namespace rink::rti
