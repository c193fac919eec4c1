// Threads that wait for work, for whoever is handed workers.
#pragma once

#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "game/physics/workers.h"

namespace rink::game {

/// The calling thread and `count` - 1 more, from construction to destruction; between two tasks
/// these sleep. A team of one takes no lock.
class ThreadTeam final : public physics::Workers {
 public:
  /// More than machines have cores for; each thread costs a stack.
  static constexpr std::uint32_t count_max = 256;

  /// Throws a runtime_error where the system starts no more threads.
  explicit ThreadTeam(std::uint32_t count);
  ~ThreadTeam() override;
  ThreadTeam(const ThreadTeam&) = delete;
  ThreadTeam& operator=(const ThreadTeam&) = delete;

  std::uint32_t count() const override { return static_cast<std::uint32_t>(threads_.size()) + 1; }
  /// By one thread at a time.
  void run(void (*task)(void* context, std::uint32_t worker), void* context) override;

 private:
  void end();
  void work(std::uint32_t worker);

  std::mutex mutex_;
  std::condition_variable begun_, ended_;
  void (*task_)(void*, std::uint32_t) = nullptr;
  void* context_ = nullptr;
  std::uint64_t task_count_ = 0;
  std::uint32_t busy_count_ = 0;  // threads, the caller's apart, that have not ended the task
  bool is_over_ = false;
  std::vector<std::thread> threads_;  // last, for they use the rest
};

/// Why a world of so many bodies cannot be played by so many threads, as the end of an error after
/// the name of the flag; nothing if it can.
std::optional<std::string> objection_to_threads(std::uint32_t count, std::size_t body_count);

}  // namespace rink::game
