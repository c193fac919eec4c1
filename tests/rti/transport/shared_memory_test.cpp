// Shared memory between processes: what a busy connection costs, killed and hostile peers, and that
// nothing is left behind.
#include "rti/transport/shared_memory/shared_memory.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstring>
#include <fstream>
#include <random>
#include <set>
#include <thread>

#include "rti/transport/readiness.h"
#include "rti/transport/shared_memory/shared_ring.h"
#include "tests/rti/rig.h"
#include "tests/temporary_folder.h"

namespace rink::rti::testing {
namespace {

using namespace std::chrono_literals;

std::string own_name(const char* what) { return test::unique_name(std::string("test-") + what); }

struct Tale : TransportListener {
  std::vector<ConnectionId> open;
  std::vector<std::byte> bytes;
  int closed = 0;
  CloseReason reason = CloseReason::closed_by_us;
  void on_open(ConnectionId connection) override { open.push_back(connection); }
  void on_bytes(ConnectionId, Bytes received) override {
    bytes.insert(bytes.end(), received.begin(), received.end());
  }
  void on_close(ConnectionId, CloseReason why, const std::string&) override {
    ++closed, reason = why;
  }
};

/// A connected pair in one process.
struct ConnectedPair {
  explicit ConnectedPair(const std::string& name, const SharedMemorySettings& settings = {})
      : server(settings), client(settings) {
    server.listen(name);
    connection = client.connect(name);
    for (int i = 0; i < 1000 && (here.open.empty() || there.open.empty()); ++i)
      server.poll({}, here), client.poll({}, there);
  }
  SharedMemoryTransport server, client;
  Tale here, there;
  ConnectionId connection = 0;
};

TEST(SharedMemory, ABusyConnectionWakesNobody) {
  ConnectedPair pair(own_name("busy"));
  const auto words = bytes_of("24 bytes of an interaction");
  const Bytes part = words;
  for (int i = 0; i < 10'000; ++i) {
    pair.client.send(pair.connection, std::span(&part, 1));
    pair.server.poll({}, pair.here);
  }
  EXPECT_EQ(pair.here.bytes.size(), 10'000 * words.size());
  EXPECT_EQ(pair.client.wakes() + pair.server.wakes() + pair.server.sleeps(), 0u);
}

TEST(SharedMemory, AStreamManyTimesAsLongAsTheRingArrivesInOrder) {
  ConnectedPair pair(own_name("long"), {.ring_size = 4096, .queue_max = 1u << 20, .spin = {}});
  std::mt19937 random(5);
  std::vector<std::byte> sent;
  for (int i = 0; i < 2000; ++i) {
    std::vector<std::byte> piece(random() % 6000);
    for (std::byte& byte : piece) byte = static_cast<std::byte>(random());
    const Bytes part = piece;
    pair.client.send(pair.connection, std::span(&part, 1));
    sent.insert(sent.end(), piece.begin(), piece.end());
    while (pair.client.counters(pair.connection).queued_bytes > 100'000)
      pair.server.poll({}, pair.here), pair.client.poll({}, pair.there);
  }
  for (int i = 0; i < 100'000 && pair.here.bytes.size() < sent.size(); ++i)
    pair.server.poll({}, pair.here), pair.client.poll({}, pair.there);
  EXPECT_TRUE(pair.here.bytes == sent);
}

/// Runs `serve` in a process of its own, for it to be killed.
template <class Serve>
pid_t fork_off(Serve serve) {
  const pid_t child = fork();
  if (child != 0) return child;
  serve();
  _exit(0);
}

TEST(SharedMemory, AKilledProcessIsNoticedWithinASecondAndLeavesNothingBehind) {
  const std::string name = own_name("killed");
  for (const bool is_server_killed : {false, true}) {
    SharedMemoryTransport ours;
    Tale tale;
    if (!is_server_killed) ours.listen(name);
    const pid_t child = fork_off([&] {
      SharedMemoryTransport theirs;
      Tale told;
      if (is_server_killed) theirs.listen(name);
      else theirs.connect(name);
      for (;;) theirs.poll(10ms, told);
    });
    for (int i = 0; i < 500 && tale.open.empty(); ++i) {
      if (is_server_killed && tale.closed == static_cast<int>(i))
        ours.connect(name);  // until it listens
      ours.poll(10ms, tale);
      if (tale.open.empty()) std::this_thread::sleep_for(2ms);
    }
    ASSERT_EQ(tale.open.size(), 1u);
    const int closed_before = tale.closed;
    kill(child, SIGKILL);
    const auto start = std::chrono::steady_clock::now();
    while (tale.closed == closed_before && std::chrono::steady_clock::now() - start < 5s)
      ours.poll(100ms, tale);
    EXPECT_LT(std::chrono::steady_clock::now() - start, 1s);
    EXPECT_EQ(tale.reason, CloseReason::closed_by_peer);
    waitpid(child, nullptr, 0);
    EXPECT_NO_THROW(SharedMemoryTransport().listen(name + (is_server_killed ? "" : "-other")))
        << "the address is free at once";
  }
  std::ifstream maps("/proc/self/maps");
  for (std::string line; std::getline(maps, line);)
    EXPECT_EQ(line.find("memfd:rink"), std::string::npos)
        << "the memory has no name, and ends with its last mapping: " << line;
}

std::pair<sockaddr_un, socklen_t> abstract_address(const std::string& name) {
  sockaddr_un address{.sun_family = AF_UNIX, .sun_path = {}};
  const std::string whole = "rink/" + name;
  std::memcpy(address.sun_path + 1, whole.data(), whole.size());
  return {address, static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + 1 + whole.size())};
}

/// A client by hand, with the server's memory in its hands.
struct HostileClient {
  explicit HostileClient(const std::string& name) : socket(::socket(AF_UNIX, SOCK_STREAM, 0)) {
    const auto [address, size] = abstract_address(name);
    EXPECT_EQ(::connect(socket.number(), reinterpret_cast<const sockaddr*>(&address), size), 0);
  }
  void take_memory() {
    std::array<std::byte, 64> greeting;
    iovec vector{greeting.data(), greeting.size()};
    alignas(cmsghdr) char control[CMSG_SPACE(sizeof(int))];
    msghdr header{};
    header.msg_iov = &vector;
    header.msg_iovlen = 1;
    header.msg_control = control;
    header.msg_controllen = sizeof control;
    ASSERT_GT(::recvmsg(socket.number(), &header, 0), 0);
    int number = -1;
    std::memcpy(&number, CMSG_DATA(CMSG_FIRSTHDR(&header)), sizeof number);
    memory_file = File(number);
    states = static_cast<SharedRingState*>(
        ::mmap(nullptr, 4096, PROT_READ | PROT_WRITE, MAP_SHARED, number, 0));
    ASSERT_NE(states, MAP_FAILED);
  }
  ~HostileClient() {
    if (states != nullptr) ::munmap(states, 4096);
  }
  File socket, memory_file;
  SharedRingState* states = nullptr;
};

TEST(SharedMemory, ImpossiblePositionsEndTheConnectionAndNothingElse) {
  const std::string name = own_name("hostile");
  SharedMemoryTransport server;
  Tale tale;
  server.listen(name);
  SharedMemoryTransport honest;
  Tale told;
  const ConnectionId friendly = honest.connect(name);
  std::mt19937_64 random(7);
  for (int trick = 0; trick < 60; ++trick) {
    const int closed_before = tale.closed;
    HostileClient client(name);
    for (int i = 0; i < 8; ++i) server.poll({}, tale);
    client.take_memory();
    EXPECT_NE(::ftruncate(client.memory_file.number(), 0), 0) << "its size is sealed";
    const std::uint64_t position = trick % 6 == 0
                                       ? ~std::uint64_t{0}
                                       : (256u * 1024u + 1u) + random() % (std::uint64_t{1} << 62);
    if (trick % 2 == 0) client.states[0].written = position;
    else client.states[1].read = position;
    const auto words = bytes_of("for the hostile one");
    const Bytes part = words;
    server.send(tale.open.back(), std::span(&part, 1));
    for (int i = 0; i < 8; ++i) server.poll({}, tale);
    EXPECT_EQ(tale.closed, closed_before + 1);
    EXPECT_EQ(tale.reason, CloseReason::failed);
  }
  tale.bytes.clear();
  const auto words = bytes_of("still here");
  const Bytes part = words;
  honest.send(friendly, std::span(&part, 1));
  for (int i = 0; i < 100 && tale.bytes.size() < words.size(); ++i)
    honest.poll({}, told), server.poll({}, tale);
  EXPECT_EQ(text_of(tale.bytes), "still here");
}

TEST(SharedMemory, RandomNonsenseInTheSharedPageNeverCrashesTheServer) {
  const std::string name = own_name("nonsense");
  SharedMemoryTransport server;
  Tale tale;
  server.listen(name);
  for (unsigned seed = 0; seed < 100; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937_64 random(seed);
    HostileClient client(name);
    for (int i = 0; i < 8; ++i) server.poll({}, tale);
    client.take_memory();
    for (int i = 0; i < 50; ++i) {
      SharedRingState& state = client.states[random() % 2];
      const std::uint64_t choice = random() % 4, value = random() >> (random() % 64);
      if (choice == 0) state.written = value;
      if (choice == 1) state.read = value;
      if (choice == 2) state.reader_sleeps = static_cast<std::uint32_t>(value);
      if (choice == 3) state.writer_waits = static_cast<std::uint32_t>(value);
      const Bytes part = Bytes(tale.bytes).first(std::min<std::size_t>(tale.bytes.size(), 100));
      server.send(tale.open.back(), std::span(&part, 1));
      server.poll({}, tale);
    }
    tale.bytes.clear();
  }
  SUCCEED();
}

/// Listens at `name` by hand.
File hostile_listener(const std::string& name) {
  File socket(::socket(AF_UNIX, SOCK_STREAM, 0));
  const auto [address, size] = abstract_address(name);
  EXPECT_EQ(::bind(socket.number(), reinterpret_cast<const sockaddr*>(&address), size), 0);
  EXPECT_EQ(::listen(socket.number(), 4), 0);
  return socket;
}

/// The greeting of a server whose file knows no seals at all.
void send_memory(const File& socket, std::uint32_t version) {
  std::FILE* file = std::tmpfile();
  ASSERT_NE(file, nullptr);
  ASSERT_EQ(::ftruncate(::fileno(file), 4096 + 2 * 4096), 0);
  struct {
    std::uint32_t magic = 0x4d534b52, version = 0;
    std::uint64_t ring_size = 4096;
  } greeting;
  greeting.version = version;
  iovec vector{&greeting, sizeof greeting};
  alignas(cmsghdr) char control[CMSG_SPACE(sizeof(int))] = {};
  msghdr header{};
  header.msg_iov = &vector;
  header.msg_iovlen = 1;
  header.msg_control = control;
  header.msg_controllen = sizeof control;
  *CMSG_FIRSTHDR(&header) = {
      .cmsg_len = CMSG_LEN(sizeof(int)), .cmsg_level = SOL_SOCKET, .cmsg_type = SCM_RIGHTS};
  const int number = ::fileno(file);
  std::memcpy(CMSG_DATA(CMSG_FIRSTHDR(&header)), &number, sizeof number);
  ASSERT_GT(::sendmsg(socket.number(), &header, 0), 0);
  std::fclose(file);
}

TEST(SharedMemory, AServerWhoseMemoryCouldShrinkIsNotBelieved) {
  const std::string name = own_name("unsealed");
  const File listener = hostile_listener(name);
  SharedMemoryTransport client;
  Tale tale;
  client.connect(name);
  const File socket(::accept(listener.number(), nullptr, nullptr));
  send_memory(socket, 1);
  for (int i = 0; i < 100 && tale.closed == 0; ++i) client.poll(1ms, tale);
  EXPECT_TRUE(tale.open.empty());
  EXPECT_EQ(tale.closed, 1);
  EXPECT_EQ(tale.reason, CloseReason::failed);
}

TEST(SharedMemory, AServerWithAnotherLayoutIsNamedWithBothVersions) {
  const std::string name = own_name("layout");
  const File listener = hostile_listener(name);
  SharedMemoryTransport client;
  struct : Tale {
    std::string why;
    void on_close(ConnectionId connection, CloseReason close_reason,
                  const std::string& detail) override {
      why = detail;
      Tale::on_close(connection, close_reason, detail);
    }
  } tale;
  client.connect(name);
  const File socket(::accept(listener.number(), nullptr, nullptr));
  send_memory(socket, 2);
  for (int i = 0; i < 100 && tale.closed == 0; ++i) client.poll(1ms, tale);
  EXPECT_TRUE(tale.open.empty());
  EXPECT_EQ(tale.why, "'" + name + "' lays out shared memory by version 2, here it is version 1");
}

TEST(SharedMemory, AnotherUsersServerIsRefused) {
  if (::geteuid() != 0) GTEST_SKIP() << "only root can be somebody else";
  const std::string name = own_name("stranger");
  int ready[2];
  ASSERT_EQ(::pipe(ready), 0);
  const pid_t child = fork();
  if (child == 0) {
    const File listener = ::setuid(65534) == 0 ? hostile_listener(name) : File();
    if (::write(ready[1], "x", 1) == 1) ::pause();
    _exit(0);
  }
  char ignored = 0;
  ASSERT_EQ(::read(ready[0], &ignored, 1), 1);
  SharedMemoryTransport client;
  Tale tale;
  client.connect(name);
  for (int i = 0; i < 100 && tale.closed == 0; ++i) client.poll(1ms, tale);
  EXPECT_EQ(tale.closed, 1);
  EXPECT_EQ(tale.reason, CloseReason::refused);
  kill(child, SIGKILL);
  waitpid(child, nullptr, 0);
  ::close(ready[0]), ::close(ready[1]);
}

TEST(SharedMemory, ACallbackMayCloseAConnectionWhosePeerHasJustGone) {
  const std::string name = own_name("crossing");
  SharedMemoryTransport server;
  struct Jealous final : TransportListener {
    SharedMemoryTransport* server = nullptr;
    std::vector<ConnectionId> open;
    int closed = 0;
    void on_open(ConnectionId connection) override {
      for (const ConnectionId other : open) server->close(other);
      open = {connection};
    }
    void on_bytes(ConnectionId, Bytes) override {}
    void on_close(ConnectionId, CloseReason, const std::string&) override { ++closed; }
  } jealous;
  jealous.server = &server;
  server.listen(name);
  for (int round = 0; round < 20; ++round) {
    auto first = std::make_unique<HostileClient>(name);
    for (int i = 0; i < 8; ++i) server.poll({}, jealous);
    const HostileClient second(name);
    first.reset();  // its end is told in the same breath as the second's beginning
    for (int i = 0; i < 8; ++i) server.poll({}, jealous);
  }
  EXPECT_GE(jealous.closed, 39);
}

TEST(SharedMemory, WhoComesWhenThereAreNoMoreFilesIsTurnedAwayAtOnce) {
  const std::string name = own_name("full");
  SharedMemoryTransport server;
  Tale tale;
  server.listen(name);
  HostileClient client(name);
  rlimit limit{};
  ASSERT_EQ(::getrlimit(RLIMIT_NOFILE, &limit), 0);
  const int next = ::dup(client.socket.number());
  ::close(next);
  const rlimit none_left{.rlim_cur = static_cast<rlim_t>(next), .rlim_max = limit.rlim_max};
  ASSERT_EQ(::setrlimit(RLIMIT_NOFILE, &none_left), 0);
  for (int i = 0; i < 8; ++i) server.poll({}, tale);
  ASSERT_EQ(::setrlimit(RLIMIT_NOFILE, &limit), 0);
  std::byte anything{};
  EXPECT_EQ(::recv(client.socket.number(), &anything, 1, MSG_DONTWAIT), 0) << "closed";
  const HostileClient later(name);
  for (int i = 0; i < 8; ++i) server.poll({}, tale);
  EXPECT_EQ(tale.open.size(), 1u);
}

TEST(SharedMemory, ASecondListenerOfANameIsToldSo) {
  SharedMemoryTransport first, second;
  const std::string name = own_name("twice");
  first.listen(name);
  try {
    second.listen(name);
    FAIL();
  } catch (const TransportError& error) {
    EXPECT_EQ(error.kind(), TransportError::Kind::in_use);
  }
}

}  // namespace
}  // namespace rink::rti::testing
