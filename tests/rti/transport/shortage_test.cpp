// Where files run short, who has not joined makes room for who waits; nobody who plays does.
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <deque>

#include "rti/federation_directory.h"
#include "rti/transport/staged/guard.h"
#include "tests/rti/rig.h"

namespace rink::rti::testing {
namespace {

/// Lets this process open so many files more than are open now, for good.
void leave_files(int more) {
  const int next = ::dup(STDOUT_FILENO);
  ::close(next);
  const rlim_t most = static_cast<rlim_t>(next + more);
  const rlimit few{.rlim_cur = most, .rlim_max = most};
  ASSERT_EQ(setrlimit(RLIMIT_NOFILE, &few), 0);
}

/// Plays the scene in a process of its own, whose limit it may lower.
template <class Scene>
void play_apart(Scene scene) {
  EXPECT_EXIT(
      {
        scene();
        std::_Exit(::testing::Test::HasFailure() ? 1 : 0);
      },
      ::testing::ExitedWithCode(0), "");
}

/// An RTI to which one federate has joined.
class Siege {
 public:
  explicit Siege(bool has_key) {
    host_.add(at_rti_);
    if (has_key) at_rti_.add<Guard>(key(), GuardSettings{}, [this] { return now_; });
    port_ = sockets_.listen("127.0.0.1", 0);
    come("first", has_key);
    run(20);
  }
  static const SharedKey& key() {
    static const SharedKey key(std::as_bytes(std::span("the harbour's own secret")));
    return key;
  }
  /// Somebody who joins.
  void come(const std::string& name, bool has_key) {
    Guest& guest = guests_.emplace_back();
    if (has_key)
      guest.gate.add<Guard>(key(), GuardSettings{.role = Role::federate}, [this] { return now_; });
    guest.link.emplace(guest.ambassador, guest.gate, guest.sockets.connect("127.0.0.1", port_));
    guest.links.add(*guest.link);
    guest.ambassador.join("rink", name, "tester");
  }
  /// Strangers who say nothing, and keep their ends open.
  void besiege(int count) {
    sockaddr_in place{};
    place.sin_family = AF_INET, place.sin_port = htons(port_);
    place.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    for (int i = 0; i < count; ++i) {
      strangers_.push_back(::socket(AF_INET, SOCK_STREAM, 0));
      ASSERT_EQ(
          ::connect(strangers_.back(), reinterpret_cast<const sockaddr*>(&place), sizeof place), 0);
    }
  }
  void run(int rounds) {
    for (int i = 0; i < rounds; ++i) {
      now_ += 0.02;
      for (Guest& guest : guests_) {
        guest.links.flush(now_);
        guest.gate.poll({}, guest.links);
      }
      host_.advance_clock(now_);
      host_.poll(std::chrono::milliseconds(5));
      host_.match();
      host_.flush();
    }
  }
  bool is_in(std::size_t guest) const { return guests_[guest].ambassador.is_joined(); }
  std::ptrdiff_t turned_away() const {
    return std::ranges::count_if(strangers_, [](int socket) {
      char byte = 0;
      return ::recv(socket, &byte, 1, MSG_DONTWAIT | MSG_PEEK) == 0;
    });
  }
  std::size_t federate_count() const { return execution_.federate_count(); }

 private:
  struct Guest {
    Recorder heard;
    Ambassador ambassador{harbour(), heard};
    TcpTransport sockets;
    StagedTransport gate{sockets};
    std::optional<FederateLink> link;
    FederateLinks links;
  };
  double now_ = 0.0;
  FederationExecution execution_{harbour(), {}};
  FederationHost host_{execution_};
  TcpTransport sockets_;
  StagedTransport at_rti_{sockets_};
  std::deque<Guest> guests_;
  std::vector<int> strangers_;
  std::uint16_t port_ = 0;
};

class Shortage : public ::testing::TestWithParam<bool> {};
INSTANTIATE_TEST_SUITE_P(Keys, Shortage, ::testing::Values(false, true), [](const auto& each) {
  return std::string(each.param ? "with_a_key" : "without");
});

TEST_P(Shortage, TurnsAwayTheOldestWhoHaveNotJoinedSoThatOthersMay) {
  play_apart([this] {
    Siege scene(GetParam());
    ASSERT_TRUE(scene.is_in(0));
    scene.besiege(16);
    for (const char* name : {"second", "third", "fourth"}) scene.come(name, GetParam());
    leave_files(8);
    scene.run(40);
    EXPECT_FALSE(scene.is_in(1)) << "the files are taken";
    EXPECT_EQ(scene.turned_away(), 0) << "a stranger has a second";
    scene.run(160);
    for (std::size_t guest = 0; guest < 4; ++guest) EXPECT_TRUE(scene.is_in(guest)) << guest;
    EXPECT_EQ(scene.federate_count(), 4u);
    EXPECT_GE(scene.turned_away(), 11);
  });
}

TEST(ShortageOfFiles, IsNoReasonToTurnAwayWhoHasJoined) {
  play_apart([] {
    Siege scene(false);
    for (const char* name : {"second", "third", "fourth", "fifth"}) scene.come(name, false);
    leave_files(3);
    scene.run(100);
    EXPECT_EQ(scene.federate_count(), 4u) << "of five who came";
  });
}

TEST(FederationDirectory, NamesTheOldestOfThoseWhoHaveAskedForNoExecution) {
  FederationDirectory directory;
  const auto oldest = [&] { return directory.oldest_stranger([](ConnectionId) { return true; }); };
  EXPECT_FALSE(oldest());
  directory.connect(3);
  directory.advance_clock(0.5);
  directory.connect(1);
  EXPECT_FALSE(oldest()) << "all are young";
  directory.advance_clock(1.0);
  EXPECT_EQ(oldest(), std::optional<ConnectionId>(3));
  directory.advance_clock(1.5);
  EXPECT_EQ(oldest(), std::optional<ConnectionId>(3));
  EXPECT_EQ(directory.oldest_stranger([](ConnectionId id) { return id != 3; }),
            std::optional<ConnectionId>(1))
      << "among those that would make room";
  directory.disconnect(3, "");
  EXPECT_EQ(oldest(), std::optional<ConnectionId>(1));
}

}  // namespace
}  // namespace rink::rti::testing
