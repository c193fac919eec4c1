// Sets up rings between processes, and closes them.
#include "rti/transport/shared_memory/shared_memory.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <bit>
#include <cassert>
#include <cerrno>
#include <cstring>
#include <ctime>
#include <new>
#include <thread>

namespace rink::rti {

namespace {

constexpr std::uint32_t memory_magic = 0x4d534b52;  ///< "RKSM"
constexpr std::uint32_t memory_version = 1;
constexpr std::size_t ring_min = 4096, ring_max = 1u << 30, head_size = 4096;

/// The server's message with which it passes the memory.
struct Greeting {
  std::uint32_t magic = memory_magic, version = memory_version;
  std::uint64_t ring_size = 0;
};

std::size_t segment_size(std::size_t ring_size) { return head_size + 2 * ring_size; }

/// An abstract name, which vanishes with its socket.
std::pair<sockaddr_un, socklen_t> address_of(const std::string& name) {
  sockaddr_un address{.sun_family = AF_UNIX, .sun_path = {}};
  const std::string whole = "rink/" + name.substr(0, 90);
  std::memcpy(address.sun_path + 1, whole.data(), whole.size());
  return {address, static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + 1 + whole.size())};
}

union FileControl {
  cmsghdr alignment;
  char bytes[CMSG_SPACE(sizeof(int))];
};

bool is_same_user(int socket) {
  ucred peer{};
  socklen_t size = sizeof peer;
  return ::getsockopt(socket, SOL_SOCKET, SO_PEERCRED, &peer, &size) == 0 &&
         peer.uid == ::geteuid();
}

/// False for a file that cannot have seals.
bool is_sealed(int file) {
  const int seals = ::fcntl(file, F_GET_SEALS);
  return seals >= 0 && (seals & F_SEAL_SHRINK) != 0;
}

}  // namespace

Mapping::Mapping(int file, std::size_t size) : size_(size) {
  void* at = ::mmap(nullptr, size, PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
  if (at != MAP_FAILED) data_ = static_cast<std::byte*>(at);
}

Mapping::~Mapping() {
  if (data_ != nullptr) ::munmap(data_, size_);
}

SharedMemoryTransport::SharedMemoryTransport(const SharedMemorySettings& settings)
    : settings_(settings) {
  assert(std::has_single_bit(settings.ring_size) && settings.ring_size >= ring_min &&
         settings.ring_size <= ring_max);
  if (std::thread::hardware_concurrency() < 2)
    settings_.spin = {};  // no other process could write
                          // meanwhile
}

void SharedMemoryTransport::listen(const std::string& name) {
  File file(::socket(AF_UNIX, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0));
  const auto [address, size] = address_of(name);
  if (::bind(file.number(), reinterpret_cast<const sockaddr*>(&address), size) != 0 ||
      ::listen(file.number(), 4096) != 0) {
    using Kind = TransportError::Kind;
    const Kind kind = errno == EADDRINUSE ? Kind::in_use
                      : errno == EMFILE   ? Kind::too_many_files
                                          : Kind::failed;
    throw TransportError(
        kind, "can't listen at shared-memory address '" + name + "': " + std::strerror(errno));
  }
  listening_.push_back(std::move(file));
  readiness_.watch(listening_.back().number(), listener_mark + listening_.size() - 1, false);
  if (!spare_) spare_ = File(::open("/dev/null", O_RDONLY | O_CLOEXEC));
}

ConnectionId SharedMemoryTransport::connect(const std::string& name) {
  const auto [address, size] = address_of(name);
  const ConnectionId connection = add(File(::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0)));
  Peer& peer = *peers_[connection];
  peer.place = name;
  if (::connect(peer.socket.number(), reinterpret_cast<const sockaddr*>(&address), size) != 0) {
    const int error = errno;
    end(connection,
        error == ECONNREFUSED || error == ENOENT ? CloseReason::refused : CloseReason::failed,
        "can't connect to shared-memory address '" + name + "': " + std::strerror(error));
  } else if (!is_same_user(peer.socket.number())) {
    end(connection, CloseReason::refused,
        "shared-memory address '" + name +
            "' is another user's");  // any user may take an abstract name
  } else {
    readiness_.watch(peer.socket.number(), connection, false);
  }
  return connection;
}

ConnectionId SharedMemoryTransport::add(File socket) {
  peers_.push_back(std::make_unique<Peer>());
  peers_.back()->socket = std::move(socket);
  counters_.emplace_back();
  acknowledgements_.emplace_back();
  return static_cast<ConnectionId>(peers_.size() - 1);
}

void SharedMemoryTransport::accept(std::size_t listening) {
  for (;;) {
    File file(
        ::accept4(listening_[listening].number(), nullptr, nullptr, SOCK_NONBLOCK | SOCK_CLOEXEC));
    if (!file && (errno == EMFILE || errno == ENFILE) && turn_away(listening)) continue;
    if (!file) return;
    if (!is_same_user(file.number())) continue;
    const ConnectionId connection = add(std::move(file));
    if (offer_memory(connection))
      readiness_.watch(peers_[connection]->socket.number(), connection, false);
    else peers_[connection].reset();  // never open, so not reported
  }
}

/// Out of files: the spare one is used to accept the waiting connection and close it, which would
/// otherwise wake every poll at once.
bool SharedMemoryTransport::turn_away(std::size_t listening) {
  if (!spare_) return false;
  spare_.close();
  const bool is_away =
      File(::accept4(listening_[listening].number(), nullptr, nullptr, SOCK_CLOEXEC)).number() >= 0;
  spare_ = File(::open("/dev/null", O_RDONLY | O_CLOEXEC));
  return is_away;
}

/// The server makes the memory and seals its size, so that neither end can be made to touch what is
/// not there.
bool SharedMemoryTransport::offer_memory(ConnectionId connection) {
  File file(::memfd_create("rink", MFD_CLOEXEC | MFD_ALLOW_SEALING));
  const std::size_t size = segment_size(settings_.ring_size);
  if (!file || ::ftruncate(file.number(), static_cast<off_t>(size)) != 0) return false;
  if (::fcntl(file.number(), F_ADD_SEALS, F_SEAL_SHRINK | F_SEAL_GROW | F_SEAL_SEAL) != 0)
    return false;
  Mapping memory(file.number(), size);
  if (memory.data() == nullptr) return false;
  new (memory.data()) SharedRingState[2];
  Greeting greeting{.ring_size = settings_.ring_size};
  iovec vector{&greeting, sizeof greeting};
  FileControl control{};
  msghdr header{};
  header.msg_iov = &vector;
  header.msg_iovlen = 1;
  header.msg_control = control.bytes;
  header.msg_controllen = sizeof control.bytes;
  cmsghdr* files = CMSG_FIRSTHDR(&header);
  files->cmsg_level = SOL_SOCKET;
  files->cmsg_type = SCM_RIGHTS;
  files->cmsg_len = CMSG_LEN(sizeof(int));
  const int number = file.number();
  std::memcpy(CMSG_DATA(files), &number, sizeof number);
  if (::sendmsg(peers_[connection]->socket.number(), &header, MSG_DONTWAIT | MSG_NOSIGNAL) !=
      sizeof greeting)
    return false;
  opened(connection, std::move(memory), settings_.ring_size, true);
  return true;
}

void SharedMemoryTransport::adopt_memory(ConnectionId connection) {
  Greeting greeting;
  iovec vector{&greeting, sizeof greeting};
  FileControl control{};
  msghdr header{};
  header.msg_iov = &vector;
  header.msg_iovlen = 1;
  header.msg_control = control.bytes;
  header.msg_controllen = sizeof control.bytes;
  const ssize_t size =
      ::recvmsg(peers_[connection]->socket.number(), &header, MSG_DONTWAIT | MSG_CMSG_CLOEXEC);
  if (size < 0 && (errno == EAGAIN || errno == EINTR)) return;
  if (size <= 0) return end(connection, CloseReason::closed_by_peer, "closed by peer");
  File file;
  const cmsghdr* files = CMSG_FIRSTHDR(&header);
  if (files != nullptr && files->cmsg_type == SCM_RIGHTS) {
    int number = -1;
    std::memcpy(&number, CMSG_DATA(files), sizeof number);
    file = File(number);
  }
  struct stat is {};
  if (size == sizeof greeting && greeting.magic == memory_magic &&
      greeting.version != memory_version)
    return end(connection, CloseReason::failed,
               "'" + peers_[connection]->place + "' lays out shared memory by version " +
                   std::to_string(greeting.version) + ", here it is version " +
                   std::to_string(memory_version));
  const bool fits = size == sizeof greeting && greeting.magic == memory_magic &&
                    std::has_single_bit(greeting.ring_size) && greeting.ring_size >= ring_min &&
                    greeting.ring_size <= ring_max && file && ::fstat(file.number(), &is) == 0 &&
                    static_cast<std::size_t>(is.st_size) == segment_size(greeting.ring_size) &&
                    is_sealed(file.number());
  Mapping memory = fits ? Mapping(file.number(), segment_size(greeting.ring_size)) : Mapping();
  if (memory.data() == nullptr)
    return end(connection, CloseReason::failed,
               "no shared memory from '" + peers_[connection]->place + "'");
  opened(connection, std::move(memory), greeting.ring_size, false);
}

void SharedMemoryTransport::opened(ConnectionId connection, Mapping memory, std::size_t ring_size,
                                   bool is_server) {
  Peer& peer = *peers_[connection];
  assert(!peer.is_open && memory.data() != nullptr);
  auto* states = reinterpret_cast<SharedRingState*>(memory.data());
  std::byte* bytes = memory.data() + head_size;
  // The first ring leads to the server.
  const SharedRing up(&states[0], bytes, ring_size), down(&states[1], bytes + ring_size, ring_size);
  peer.in = is_server ? up : down;
  peer.out = is_server ? down : up;
  peer.memory = std::move(memory);
  peer.is_open = true;
  open_.push_back(connection);
  news_.push_back({connection, {}, {}});
  drain(connection);  // sent before it was open
}

void SharedMemoryTransport::end(ConnectionId connection, CloseReason reason,
                                const std::string& detail) {
  assert(find(connection) != nullptr);  // its end is reported once
  peers_[connection].reset();
  std::erase(open_, connection);
  news_.push_back({connection, reason, detail});
}

void SharedMemoryTransport::close(ConnectionId connection) {
  if (find(connection) == nullptr) return;
  drain(connection);
  if (find(connection) != nullptr) end(connection, CloseReason::closed_by_us, "closed by us");
}

/// Exact to a few milliseconds, at a fifth of the cost of the exact time in each round trip.
std::int64_t SharedMemoryTransport::now_ns() {
  timespec now{};
  ::clock_gettime(CLOCK_MONOTONIC_COARSE, &now);
  return 1'000'000'000 * static_cast<std::int64_t>(now.tv_sec) + now.tv_nsec;
}

TransportCounters SharedMemoryTransport::counters(ConnectionId connection) const {
  if (connection >= counters_.size()) return {};
  TransportCounters counters = counters_[connection];
  counters.acknowledgements_sent = acknowledgements_[connection].count(now_ns());
  if (const Peer* peer = find(connection))
    counters.queued_bytes = peer->queue.size() - peer->queue_from;
  return counters;
}

TransportCounters SharedMemoryTransport::totals() const {
  TransportCounters sum;
  for (ConnectionId connection = 0; connection < counters_.size(); ++connection) {
    const TransportCounters one = counters(connection);
    sum.bytes_sent += one.bytes_sent;
    sum.bytes_received += one.bytes_received;
    sum.writes += one.writes;
    sum.segments_sent += one.segments_sent;
    sum.acknowledgements_sent += one.acknowledgements_sent;
    sum.queued_bytes += one.queued_bytes;
  }
  return sum;
}

}  // namespace rink::rti
