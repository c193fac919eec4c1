// Delivers the callbacks that a queue keeps.
#include "rti/callbacks/callback_queue.h"

#include <cassert>

#include "im/basics/checked.h"

namespace rink::rti {

void CallbackQueue::deliver_one() {
  assert(!is_empty() && !is_delivering_);
  Header header;
  std::memcpy(&header, records_.data() + taken_, sizeof header);
  assert(header_size <= header.size && header.size <= waiting_bytes());
  const auto first = records_.begin() + static_cast<std::ptrdiff_t>(taken_);
  delivering_.assign(first, first + static_cast<std::ptrdiff_t>(header.size));
  taken_ += header.size;
  if (taken_ == records_.size() || taken_ > records_.size() / 2) {
    // Every byte moves at most once for each that was delivered.
    records_.erase(records_.begin(), records_.begin() + static_cast<std::ptrdiff_t>(taken_));
    taken_ = 0;
    if constexpr (checks_whole_structures) check();
  }
  is_delivering_ = true;
  header.deliver(federate_, delivering_.data() + header_size);
  is_delivering_ = false;
}

void CallbackQueue::check() const {
  assert(taken_ <= records_.size());
  for (std::size_t at = taken_; at != records_.size();) {
    Header header;
    std::memcpy(&header, records_.data() + at, sizeof header);
    assert(header.deliver != nullptr && header.size % ArgumentWriter::alignment == 0);
    assert(header_size <= header.size && header.size <= records_.size() - at);
    at += header.size;
  }
}

}  // namespace rink::rti
