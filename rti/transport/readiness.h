// Which files can be read or written: the kernel's epoll, asked for many at once.
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

/// Transports number their files so: from here on are listening sockets, those below are
/// connections.
inline constexpr std::uint64_t listener_mark = 1ull << 32;

/// Watches files by a number of the caller's choice. Level-triggered: what was not read or written
/// to the end is told again, so a file is watched once and not touched again between two reads,
/// which halves the system calls of a reactor that arms each read anew.
class Readiness {
 public:
  struct Event {
    std::uint64_t number;
    bool is_writable, is_readable;  ///< both after an error or the peer's end, which reading or
                                    ///< writing then tells
  };

  Readiness();

  /// `wants_room`: also tell when it can be written. The file is forgotten when it is closed. False
  /// if the kernel refuses.
  bool watch(int file, std::uint64_t number, bool wants_room);
  void change(int file, std::uint64_t number, bool wants_bytes, bool wants_room);

  /// Asks the kernel what is ready, unless something that it told is left to take. If nothing is
  /// ready it asks again and again for `spin`, then sleeps until something is; both together take
  /// at most `longest_wait`. May end early.
  void ask(std::chrono::nanoseconds longest_wait, std::chrono::nanoseconds spin);

  /// The next event, in the order in which the kernel told them, or nothing if all are taken. The
  /// kernel is asked again here only where its answer was as long as one may be. So a file that
  /// always has something comes back when all others had their turn. An event may be about a file
  /// that was closed since.
  std::optional<Event> next();

  /// True if something that the kernel told is left to take.
  bool has_left() const { return taken_ != count_; }

  /// Can be read when there is an event.
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
