// Epoll and a precise wait for it.
#include "rti/transport/readiness.h"

#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <ctime>

namespace rink::rti {

namespace {

std::uint32_t interest(bool wants_bytes, bool wants_room) {
  return (wants_bytes ? static_cast<std::uint32_t>(EPOLLIN) : 0u) | (wants_room ? static_cast<std::uint32_t>(EPOLLOUT) : 0u);
}

}  // namespace

File& File::operator=(File&& other) noexcept {
  if (this == &other) return *this;
  close();
  number_ = other.number_;
  other.number_ = -1;
  return *this;
}

void File::close() {
  if (number_ >= 0) ::close(number_);
  number_ = -1;
}

Readiness::Readiness() : epoll_(::epoll_create1(EPOLL_CLOEXEC)) {}

bool Readiness::watch(int file, std::uint64_t number, bool wants_room) {
  epoll_event event{};
  event.events = interest(true, wants_room);
  event.data.u64 = number;
  return ::epoll_ctl(epoll_.number(), EPOLL_CTL_ADD, file, &event) == 0;
}

void Readiness::change(int file, std::uint64_t number, bool wants_bytes, bool wants_room) {
  epoll_event event{};
  event.events = interest(wants_bytes, wants_room);
  event.data.u64 = number;
  ::epoll_ctl(epoll_.number(), EPOLL_CTL_MOD, file, &event);
}

std::optional<Readiness::Event> Readiness::next() {
  if (taken_ == count_) {
    taken_ = 0;
    count_ = static_cast<std::size_t>(std::max(0, ::epoll_wait(epoll_.number(), told_.data(), static_cast<int>(told_.size()), 0)));
    if (count_ == 0) return std::nullopt;
  }
  const epoll_event& event = told_[taken_++];
  const bool is_over = (event.events & (EPOLLERR | EPOLLHUP)) != 0;
  return Event{.number = event.data.u64, .is_writable = is_over || (event.events & EPOLLOUT) != 0, .is_readable = is_over || (event.events & EPOLLIN) != 0};
}

void Readiness::wait(std::chrono::nanoseconds longest_wait) {
  if (taken_ != count_) return;
  // epoll_wait counts whole milliseconds and its exact sibling is too young for some sandboxes; ppoll on the epoll itself is exact everywhere.
  const auto seconds = std::chrono::floor<std::chrono::seconds>(longest_wait);
  const timespec timeout{.tv_sec = static_cast<std::time_t>(seconds.count()), .tv_nsec = static_cast<long>((longest_wait - seconds).count())};
  pollfd all{.fd = epoll_.number(), .events = POLLIN, .revents = 0};
  ::ppoll(&all, 1, &timeout, nullptr);
}

}  // namespace rink::rti
