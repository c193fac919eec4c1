// A seam for another core that takes half of a job. Callers implement it, since `im` has no threads
// of its own.
#pragma once

#include <cstddef>

namespace rink::im {

/// Smaller jobs are not shared: regions of a match that looks at all, and movers of a match in
/// which few move.
struct WorthSharing {
  std::size_t regions = 32768, movers = 8192;
};

class Worker {
 public:
  virtual ~Worker() = default;
  /// Begins `task(context)` on another thread and returns. There is one task at a time, and it
  /// throws nothing.
  virtual void start(void (*task)(void* context), void* context) = 0;
  /// Returns when the task has ended and all that it wrote can be read.
  virtual void wait() = 0;

  /// The defaults suit a worker that sleeps in between; one that wakes faster may set less.
  WorthSharing worth_sharing;
};

/// `worker`, if there is one and the count is worth sharing.
inline Worker* for_regions(Worker* worker, std::size_t count) {
  return worker != nullptr && count >= worker->worth_sharing.regions ? worker : nullptr;
}
inline Worker* for_movers(Worker* worker, std::size_t count) {
  return worker != nullptr && count >= worker->worth_sharing.movers ? worker : nullptr;
}

/// Runs `own` here and `other` by `worker`, or one after the other without one. Neither may write
/// what the other reads.
template <class Own, class Other>
void run_both(Worker* worker, Own own, Other other) {
  if (worker == nullptr) return own(), other();
  worker->start([](void* context) { (*static_cast<Other*>(context))(); }, &other);
  own();
  worker->wait();
}

}  // namespace rink::im
