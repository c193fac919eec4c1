// The queue of callbacks.
#include "rti/standard/federate/deliveries.h"

#include <algorithm>
#include <cassert>
#include <utility>

namespace rink::standard {

void Deliveries::put(Callback callback, const CallbackSubject& subject) {
  waiting_.push_back({std::move(callback), subject, put_count_++});
  waiting_bytes_ += cost(waiting_.back());
}

bool Deliveries::take_back(const rti::RetractionHandle& handle) {
  const auto found = std::find_if(waiting_.begin(), waiting_.end(), [&](const Waiting& each) {
    return each.subject.handle == handle;
  });
  if (!handle || found == waiting_.end()) return false;
  waiting_bytes_ -= cost(*found);
  waiting_.erase(found);
  skip_dropped();
  return true;
}

void Deliveries::drop(rti::ObjectHandle object) {
  if (waiting_.empty()) return;
  dropped_[object] = put_count_;
  skip_dropped();
}

/// The oldest that waits is always one to deliver.
void Deliveries::skip_dropped() {
  const auto is_dropped = [this](const Waiting& each) {
    const auto found = dropped_.find(each.subject.object);
    return found != dropped_.end() && each.number < found->second;
  };
  while (!dropped_.empty() && !waiting_.empty() && is_dropped(waiting_.front())) {
    waiting_bytes_ -= cost(waiting_.front());
    waiting_.pop_front();
  }
  if (waiting_.empty()) dropped_.clear();
}

void Deliveries::clear() {
  waiting_.clear();
  dropped_.clear();
  waiting_bytes_ = 0;
}

void Deliveries::deliver_one(std::unique_lock<std::mutex>& lock) {
  assert(lock.owns_lock() && is_ready() && user_ != nullptr);
  const Waiting next = std::move(waiting_.front());
  waiting_bytes_ -= cost(next);
  waiting_.pop_front();
  skip_dropped();
  deliverer_ = std::this_thread::get_id();
  lock.unlock();
  try {
    next.callback(*user_);
  } catch (...) {
    lock.lock();
    deliverer_ = {};
    throw;
  }
  lock.lock();
  deliverer_ = {};
}

}  // namespace rink::standard
