// Which files can be read or written, by the kernel's epoll.
#pragma once

#include <sys/epoll.h>

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>

namespace rink::rti {

/// Closes a file of the operating system when it goes out of scope.
class File {
 public:
  File() = default;
  explicit File(int number) : number_(number) {}
  ~File() { close(); }
  File(File&& other) noexcept : number_(other.number_) { other.number_ = -1; }
  File& operator=(File&& other) noexcept;

  int number() const { return number_; }
  explicit operator bool() const { return number_ >= 0; }
  void close();

 private:
  int number_ = -1;
};

/// Transports number listening sockets from here on; numbers below are connections.
inline constexpr std::uint64_t listener_mark = 1ull << 32;

/// Watches files by a number of the caller's choice. Level-triggered: a file that was not read or
/// written to the end is reported again, so it is watched once and not touched between two reads,
/// which halves the system calls of a reactor that arms each read anew.
class Readiness {
 public:
  struct Event {
    std::uint64_t number;
    bool is_writable, is_readable;  ///< both after an error or the peer's end, which reading or
                                    ///< writing then shows
  };

  Readiness();

  /// `wants_room`: also report when it can be written. The file is forgotten when it is closed.
  /// False if the kernel refuses.
  bool watch(int file, std::uint64_t number, bool wants_room);
  void change(int file, std::uint64_t number, bool wants_bytes, bool wants_room);

  /// Asks the kernel which files are ready, unless reported events are left to take. If none is
  /// ready it asks again and again for `spin`, then sleeps until one is; both together take at most
  /// `longest_wait`. May end early.
  void ask(std::chrono::nanoseconds longest_wait, std::chrono::nanoseconds spin);

  /// The next event, in the kernel's order, or nothing if all are taken. The kernel is asked again
  /// here only if its answer was of the greatest length, so a file that is always ready comes back
  /// after all others had their turn. An event may be about a file that was closed since.
  std::optional<Event> next();

  /// True if reported events are left to take.
  bool has_left() const { return taken_ != count_; }

  /// A file that can be read when there is an event.
  int file() const { return epoll_.number(); }

 private:
  static constexpr std::size_t batch_max = 512;  ///< events of one system call
  void ask_now();
  void sleep(std::chrono::nanoseconds longest_wait);
  File epoll_;
  std::array<epoll_event, batch_max> events_;
  std::size_t taken_ = 0, count_ = 0;
  bool has_exact_sleep_ = true;  ///< the kernel knows epoll_pwait2
};

}  // namespace rink::rti
