// Callbacks that wait for their federate.
#pragma once

#include <cstddef>
#include <deque>
#include <functional>
#include <mutex>
#include <thread>

#include "rti/standard/standard_headers.h"
#include "rti/types.h"

namespace rink::standard {

/// In the order in which they came. All is called under the mutex of the federate, which is let go
/// while a callback runs, so that it may call any service.
class Deliveries {
 public:
  using Callback = std::function<void(rti1516e::FederateAmbassador&)>;

  explicit Deliveries(rti1516e::FederateAmbassador& user) : user_(user) {}

  /// `size` is what its values take [bytes]; `handle` names the message if it came in time-stamp
  /// order.
  void put(Callback callback, std::size_t size = 0, const rti::RetractionHandle& handle = {});
  /// Forgets a message that its sender retracts; false if it has been delivered.
  bool take_back(const rti::RetractionHandle& handle);
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
    std::size_t size;
    rti::RetractionHandle handle;
  };
  static std::size_t cost(const Waiting& waiting) { return sizeof(Waiting) + waiting.size; }

  rti1516e::FederateAmbassador& user_;
  std::deque<Waiting> waiting_;
  std::size_t waiting_bytes_ = 0;
  bool is_enabled_ = true;
  std::thread::id deliverer_;
};

}  // namespace rink::standard
