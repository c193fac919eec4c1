// The messages that wait for one federate's time, least first.
#pragma once

#include <algorithm>
#include <cassert>
#include <functional>
#include <vector>

#include "rti/time/time_management.h"
#include "rti/wire/state_stream.h"

namespace rink::rti {

/// Two heaps: waiting entries, and withdrawn ones that are removed when they come to the top. So a
/// retraction costs no more than a message.
class TimeQueue {
 public:
  bool is_empty() const { return waiting_.empty(); }
  /// Entries kept, withdrawn ones included.
  std::size_t size() const { return waiting_.size(); }
  /// Time stamp of the next entry, infinite if there is none.
  double next_time() const { return waiting_.empty() ? time_unbounded : waiting_.front().time; }
  void push(const TimedEntry& entry) {
    assert(is_valid_time(entry.time));
    push(waiting_, entry);
  }
  /// The queue must not be empty.
  TimedEntry pop() {
    assert(!is_empty());
    const TimedEntry entry = pop(waiting_);
    strike_out();
    return entry;
  }
  /// The entry must be waiting.
  void withdraw(const TimedEntry& entry) {
    assert(withdrawn_.size() < waiting_.size());
    push(withdrawn_, entry);
    strike_out();
  }
  /// Asserts the order of both heaps, and that the next entry was not withdrawn.
  void check() const {
    assert(std::is_heap(waiting_.begin(), waiting_.end(), std::greater<>()));
    assert(std::is_heap(withdrawn_.begin(), withdrawn_.end(), std::greater<>()));
    assert(withdrawn_.size() <= waiting_.size());
    assert(withdrawn_.empty() || waiting_.front() < withdrawn_.front());
  }
  template <class Stream>
  bool keep(Stream& stream) {
    return keep_all(stream, waiting_, withdrawn_);
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
    assert(withdrawn_.size() <= waiting_.size());
    while (!withdrawn_.empty() && waiting_.front() == withdrawn_.front()) {
      pop(waiting_);
      pop(withdrawn_);
    }
  }

  Heap waiting_, withdrawn_;
};

}  // namespace rink::rti
