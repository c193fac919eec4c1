// Callbacks that wait for their federate.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <thread>
#include <unordered_map>
#include <vector>

#include "rti/fom/fom.h"
#include "rti/standard/standard_headers.h"
#include "rti/standard/times.h"
#include "rti/types.h"

namespace rink::standard {

/// What a callback is about.
struct CallbackSubject {
  std::size_t size = 0;            ///< of its values [bytes]
  rti::RetractionHandle handle{};  ///< of the message, if its sender may take it back
  rti::ObjectHandle object{};
};

/// An update as it came; the standard's values are made of it when it is delivered, by the thread
/// that takes it.
struct WaitingUpdate {
  enum class Kind : std::uint8_t { plain, with_time, in_order };

  rti::ObjectHandle object{};
  rti::ObjectClassHandle registered{};
  rti::AttributeSet attributes{}, wanted{};
  rti::TimedStamp timed{};
  Times times{};
  Kind kind = Kind::plain;
  bool is_reliable = false;
};
void deliver_update(rti1516e::FederateAmbassador& user, const rti::Fom& fom,
                    const WaitingUpdate& update, rti::Bytes values);

/// In the order in which they came. All is called under the mutex of the federate, which is let go
/// while callbacks run, so that they may call any service.
class Deliveries {
 public:
  using Callback = std::function<void(rti1516e::FederateAmbassador&)>;

  /// Nothing waits, and what comes is for `user`. Nobody may be delivering.
  void begin(rti1516e::FederateAmbassador& user);
  void put(Callback callback, const CallbackSubject& subject = {});
  void put(const WaitingUpdate& update, rti::Bytes values,
           const std::shared_ptr<const rti::Fom>& fom);
  /// Forgets a message that its sender retracts; false if it has been delivered, or is about to.
  bool take_back(const rti::RetractionHandle& handle);
  /// What waits now about an object that the federate has deleted is not delivered.
  void drop(rti::ObjectHandle object);
  /// Unless the deletion is retracted before its turn comes.
  void undo_drop(rti::ObjectHandle object) { dropped_.erase(object); }
  void clear();
  /// While they are disabled, none is ready.
  void enable(bool is_enabled);
  /// Who delivers stops before the next callback.
  void interrupt() { ++epoch_; }
  bool is_ready() { return is_enabled_ && !is_delivering() && find_front(); }
  std::size_t waiting_bytes() const { return coming_.cost + current_.cost; }
  bool is_delivering() const { return deliverer_ != std::thread::id(); }
  bool is_delivering_here() const { return deliverer_ == std::this_thread::get_id(); }
  /// Delivers the oldest, and further ones, without taking the mutex between them, until
  /// `is_enough()`; one must be ready. What a callback throws goes through.
  template <class Enough>
  void deliver(std::unique_lock<std::mutex>& lock, const Enough& is_enough);

 private:
  struct Waiting {
    Callback callback;  ///< empty: an update
    CallbackSubject subject;
    WaitingUpdate update;
    std::uint64_t number;  ///< counts all that were put
    bool is_taken_back = false;
  };
  /// Filled by one thread while another delivers the one before.
  struct Batch {
    std::vector<Waiting> all{};
    std::vector<std::byte> values{};  ///< of the updates, one after the other
    std::size_t next = 0, next_value = 0, cost = 0;
    std::shared_ptr<const rti::Fom> fom{};  ///< of the updates

    void clear();
  };
  class Delivering;
  bool find_front();
  bool is_dropped(const Waiting& each) const;
  void skip(Batch& batch) const;
  void deliver_next();

  rti1516e::FederateAmbassador* user_ = nullptr;
  Batch coming_, current_;
  std::uint64_t put_count_ = 0;
  std::unordered_map<rti::ObjectHandle, std::uint64_t> dropped_;  ///< and what had been put then
  std::atomic<std::uint64_t> epoch_ = 0;  ///< of what decides whether the next is delivered
  bool is_enabled_ = true, is_to_clear_ = false;
  std::thread::id deliverer_;
};

/// Lets the mutex go, and has it again at the end.
class Deliveries::Delivering {
 public:
  Delivering(Deliveries& deliveries, std::unique_lock<std::mutex>& lock);
  ~Delivering();
  Delivering(const Delivering&) = delete;
  Delivering& operator=(const Delivering&) = delete;

 private:
  Deliveries& deliveries_;
  std::unique_lock<std::mutex>& lock_;
};

template <class Enough>
void Deliveries::deliver(std::unique_lock<std::mutex>& lock, const Enough& is_enough) {
  const std::uint64_t epoch = epoch_;
  // Where some wait in vain, each is looked at under the mutex.
  const bool is_one = !dropped_.empty();
  const Delivering delivering(*this, lock);
  do deliver_next();
  while (!is_one && epoch_ == epoch && current_.next < current_.all.size() &&
         !current_.all[current_.next].is_taken_back && !is_enough());
}

}  // namespace rink::standard
