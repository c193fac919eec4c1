// The queue of callbacks.
#include "rti/standard/federate/deliveries.h"

#include <algorithm>
#include <cassert>
#include <utility>

namespace rink::standard {

void Deliveries::put(Callback callback, std::size_t size, const rti::RetractionHandle& handle) {
  waiting_.push_back({std::move(callback), size, handle});
  waiting_bytes_ += cost(waiting_.back());
}

bool Deliveries::take_back(const rti::RetractionHandle& handle) {
  const auto found = std::find_if(waiting_.begin(), waiting_.end(),
                                  [&](const Waiting& each) { return each.handle == handle; });
  if (!handle || found == waiting_.end()) return false;
  waiting_bytes_ -= cost(*found);
  waiting_.erase(found);
  return true;
}

void Deliveries::clear() {
  waiting_.clear();
  waiting_bytes_ = 0;
}

void Deliveries::deliver_one(std::unique_lock<std::mutex>& lock) {
  assert(lock.owns_lock() && is_ready());
  const Waiting next = std::move(waiting_.front());
  waiting_bytes_ -= cost(next);
  waiting_.pop_front();
  deliverer_ = std::this_thread::get_id();
  lock.unlock();
  try {
    next.callback(user_);
  } catch (...) {
    lock.lock();
    deliverer_ = {};
    throw;
  }
  lock.lock();
  deliverer_ = {};
}

}  // namespace rink::standard
