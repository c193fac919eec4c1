// Callbacks that wait for their federate.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <mutex>
#include <thread>
#include <unordered_map>

#include "rti/standard/standard_headers.h"
#include "rti/types.h"

namespace rink::standard {

/// What a callback is about.
struct CallbackSubject {
  std::size_t size = 0;            ///< of its values [bytes]
  rti::RetractionHandle handle{};  ///< of the message, if its sender may take it back
  rti::ObjectHandle object{};
};

/// In the order in which they came. All is called under the mutex of the federate, which is let go
/// while a callback runs, so that it may call any service.
class Deliveries {
 public:
  using Callback = std::function<void(rti1516e::FederateAmbassador&)>;

  /// Null takes none.
  explicit Deliveries(rti1516e::FederateAmbassador* user) : user_(user) {}

  void put(Callback callback, const CallbackSubject& subject = {});
  /// Forgets a message that its sender retracts; false if it has been delivered.
  bool take_back(const rti::RetractionHandle& handle);
  /// What waits now about an object that the federate has deleted is not delivered.
  void drop(rti::ObjectHandle object);
  /// Unless the deletion is retracted before its turn comes.
  void undo_drop(rti::ObjectHandle object) { dropped_.erase(object); }
  void clear();
  /// While they are disabled, none is ready.
  void enable(bool is_enabled) { is_enabled_ = is_enabled; }
  bool is_ready() const { return is_enabled_ && !waiting_.empty() && !is_delivering(); }
  bool is_empty() const { return waiting_.empty(); }
  std::size_t waiting_bytes() const { return waiting_bytes_; }
  bool is_delivering() const { return deliverer_ != std::thread::id(); }
  bool is_delivering_here() const { return deliverer_ == std::this_thread::get_id(); }
  /// Delivers the oldest; one must be ready. What the callback throws goes through.
  void deliver_one(std::unique_lock<std::mutex>& lock);

 private:
  struct Waiting {
    Callback callback;
    CallbackSubject subject;
    std::uint64_t number;  ///< counts all that were put
  };
  static std::size_t cost(const Waiting& waiting) { return sizeof(Waiting) + waiting.subject.size; }
  void skip_dropped();

  rti1516e::FederateAmbassador* user_;
  std::deque<Waiting> waiting_;
  std::uint64_t put_count_ = 0;
  std::unordered_map<rti::ObjectHandle, std::uint64_t> dropped_;  ///< and what had been put then
  std::size_t waiting_bytes_ = 0;
  bool is_enabled_ = true;
  std::thread::id deliverer_;
};

}  // namespace rink::standard
