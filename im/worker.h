// Somebody on another core who can take half of a job. Handed in, for `im` has no threads of its
// own.
#pragma once

#include <cstddef>

namespace rink::im {

/// Below so many a job is done alone: regions of a match in which all are looked at, and movers of
/// one in which few move.
struct WorthSharing {
  std::size_t regions = 32768, movers = 8192;
};

class Worker {
 public:
  virtual ~Worker() = default;
  /// Begins `task(context)` elsewhere and returns. One at a time, and the task throws nothing.
  virtual void start(void (*task)(void* context), void* context) = 0;
  /// Returns when the task has ended; all that it wrote can be read then.
  virtual void wait() = 0;

  /// For one that sleeps in between; whoever wakes faster may say less.
  WorthSharing worth_sharing;
};

/// `worker`, if there is one and so many are worth it.
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
