// Somebody on another core who can take half of a job. Handed in, for `im` has no threads of its own.
#pragma once

#include <cstddef>

namespace rink::im {

class Worker {
 public:
  virtual ~Worker() = default;
  /// Begins `task(context)` elsewhere and returns. One at a time, and the task throws nothing.
  virtual void start(void (*task)(void* context), void* context) = 0;
  /// Returns when the task has ended; all that it wrote can be read then.
  virtual void wait() = 0;
};

/// Waking somebody takes 10 to 60 us, so jobs below a fifth of a millisecond are done alone: everyone at 25 ns a region, a mover at 100.
inline constexpr std::size_t shared_regions_min = 8192, shared_movers_min = 2048;

/// Runs `own` here and `other` by `worker`, or one after the other without one. Neither may write what the other reads.
template <class Own, class Other>
void run_both(Worker* worker, Own own, Other other) {
  if (worker == nullptr) return own(), other();
  worker->start([](void* context) { (*static_cast<Other*>(context))(); }, &other);
  own();
  worker->wait();
}

}  // namespace rink::im
