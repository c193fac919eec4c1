// The queue of callbacks.
#include "rti/standard/federate/deliveries.h"

#include <algorithm>
#include <cassert>
#include <utility>

namespace rink::standard {

namespace {

/// Room that a batch keeps when it is empty [bytes]: a burst's memory is given back.
constexpr std::size_t kept_max = 4u << 20;

}  // namespace

void Deliveries::Batch::clear() {
  if (cost > kept_max) {
    *this = {};
    return;
  }
  all.clear();
  values.clear();
  next = next_value = cost = 0;
  fom.reset();
}

void Deliveries::begin(rti1516e::FederateAmbassador& user) {
  assert(!is_delivering());
  clear();
  user_ = &user;
  is_enabled_ = true;
}

void Deliveries::put(Callback callback, const CallbackSubject& subject) {
  coming_.all.push_back({std::move(callback), subject, {}, put_count_++});
  coming_.cost += sizeof(Waiting) + subject.size;
}

void Deliveries::put(const WaitingUpdate& update, rti::Bytes values,
                     const std::shared_ptr<const rti::Fom>& fom) {
  const rti::RetractionHandle handle = update.timed.handle;
  coming_.all.push_back({{}, {values.size(), handle, update.object}, update, put_count_++});
  coming_.values.insert(coming_.values.end(), values.begin(), values.end());
  coming_.cost += sizeof(Waiting) + values.size();
  if (coming_.fom != fom) coming_.fom = fom;
}

bool Deliveries::take_back(const rti::RetractionHandle& handle) {
  if (!handle) return false;
  for (Batch* const batch : {&current_, &coming_}) {
    if (batch == &current_ && is_delivering()) continue;
    const auto found = std::find_if(
        batch->all.begin() + static_cast<std::ptrdiff_t>(batch->next), batch->all.end(),
        [&](const Waiting& each) { return each.subject.handle == handle && !each.is_taken_back; });
    if (found == batch->all.end()) continue;
    found->is_taken_back = true;
    return true;
  }
  return false;
}

void Deliveries::drop(rti::ObjectHandle object) {
  if (current_.all.empty() && coming_.all.empty()) return;
  dropped_[object] = put_count_;
  interrupt();
}

bool Deliveries::is_dropped(const Waiting& each) const {
  if (each.is_taken_back) return true;
  const auto found = dropped_.find(each.subject.object);
  return found != dropped_.end() && each.number < found->second;
}

/// Makes the oldest that is to be delivered the next one of the current batch; false if there is
/// none.
bool Deliveries::find_front() {
  while (true) {
    if (current_.next == current_.all.size()) {
      current_.clear();
      if (coming_.all.empty()) {
        dropped_.clear();
        return false;
      }
      std::swap(current_, coming_);
      const std::uint64_t first = current_.all.front().number;
      std::erase_if(dropped_, [first](const auto& each) { return each.second <= first; });
    }
    if (!is_dropped(current_.all[current_.next])) return true;
    skip(current_);
  }
}

/// Beyond the next one, and its values.
void Deliveries::skip(Batch& batch) const {
  const Waiting& next = batch.all[batch.next++];
  if (!next.callback) batch.next_value += next.subject.size;
}

void Deliveries::clear() {
  dropped_.clear();
  coming_.clear();
  if (is_delivering()) is_to_clear_ = true;
  else current_.clear();
  interrupt();
}

void Deliveries::enable(bool is_enabled) {
  is_enabled_ = is_enabled;
  interrupt();
}

void Deliveries::deliver_next() {
  Waiting& next = current_.all[current_.next];
  const std::size_t begin = current_.next_value;
  skip(current_);
  if (next.callback) {
    const Callback callback = std::exchange(next.callback, nullptr);
    callback(*user_);
  } else {
    deliver_update(*user_, *current_.fom, next.update,
                   rti::Bytes(current_.values).subspan(begin, next.subject.size));
  }
}

Deliveries::Delivering::Delivering(Deliveries& deliveries, std::unique_lock<std::mutex>& lock)
    : deliveries_(deliveries), lock_(lock) {
  assert(lock.owns_lock() && deliveries.is_enabled_ && deliveries.user_ != nullptr);
  assert(deliveries.current_.next < deliveries.current_.all.size());
  deliveries.deliverer_ = std::this_thread::get_id();
  lock.unlock();
}

Deliveries::Delivering::~Delivering() {
  lock_.lock();
  deliveries_.deliverer_ = {};
  if (std::exchange(deliveries_.is_to_clear_, false)) deliveries_.current_.clear();
}

}  // namespace rink::standard
