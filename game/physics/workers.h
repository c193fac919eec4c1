// Threads that play parts of a world at once. Handed in, for the physics has none of its own.
#pragma once

#include <cstdint>

namespace rink::physics {

/// A fixed set of workers, whoever asks being one of them.
class Workers {
 public:
  virtual ~Workers() = default;
  /// 1 or more.
  virtual std::uint32_t count() const = 0;
  /// Calls `task(context, worker)` once for each worker below count(), all at once, and returns
  /// when they have ended; all that they wrote can be read then. The task throws nothing.
  virtual void run(void (*task)(void* context, std::uint32_t worker), void* context) = 0;
};

/// `task(worker)` for each of the workers.
template <class Task>
void run_on(Workers& workers, Task& task) {
  workers.run([](void* context, std::uint32_t worker) { (*static_cast<Task*>(context))(worker); },
              &task);
}

}  // namespace rink::physics
