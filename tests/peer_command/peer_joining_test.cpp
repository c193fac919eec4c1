// Processes of rink-peer that come while others play, leave, and are killed: whoever is there at
// the end has the hash of one engine.
#include <set>

#include "game/peer/session/session.h"
#include "rti/transport/tcp/tcp.h"
#include "tests/peer_command/peer_processes.h"

namespace rink::game {
namespace {

class PeerJoining : public PeerCommand {
 protected:
  void pass(std::chrono::milliseconds time) {
    const auto end = std::chrono::steady_clock::now() + time;
    until([&] { return std::chrono::steady_clock::now() >= end; });
  }
  bool is_in(const Process& peer) {
    return until([&] {
             return peer.stderr_tail().find(" is in from ") != std::string::npos || peer.ending();
           }) &&
           !peer.ending();
  }
};

TEST_F(PeerJoining, OneAloneIsJoinedThroughAnybodyAndGoesWithoutMissing) {
  for (const char* transport : {"tcp", "shm"}) {
    const Words real{"--transport", transport, "--pace", "realtime"};
    Process& first = found(1, "4", real);
    ASSERT_TRUE(are_playing({&first}));
    pass(300ms);
    Process& second = join(first, real);
    ASSERT_TRUE(is_in(second)) << second.stderr_tail();
    Process& third = join(second, real);
    ASSERT_TRUE(is_in(third)) << third.stderr_tail();
    ASSERT_EQ(kill(first.id(), SIGINT), 0);
    ASSERT_TRUE(ends(first));
    EXPECT_EQ(first.ending()->exit_status, 130);
    Process& fourth = join(third, real);
    ASSERT_TRUE(is_in(fourth)) << fourth.stderr_tail();
    for (const Process* peer : {&second, &third, &fourth}) {
      ASSERT_TRUE(ends(*peer));
      EXPECT_EQ(peer->ending()->exit_status, 0) << peer->stderr_tail();
      EXPECT_EQ(hash_of(*peer), truth(4.0)) << transport;
      EXPECT_EQ(peer->line_after("  \"recoveries\": "), "0,");
      EXPECT_NE(peer->line_after("  \"own_events\": "), "0,");
    }
  }
}

TEST_F(PeerJoining, BringsItsOwnBotsAndIsRefusedMoreThanAreFree) {
  const std::string file = (folder_ / "live.keys").string();
  Process& first = found(1, "3", {"--pace", "realtime", "--bots", "3", "--record", file});
  ASSERT_TRUE(are_playing({&first}));
  Process& second = join(first, {"--bots", "4", "--players", "chaser,random"});
  ASSERT_TRUE(is_in(second)) << second.stderr_tail();
  const Process& greedy = join(second, {"--bots", "2"});
  ASSERT_TRUE(ends(greedy));
  EXPECT_EQ(greedy.ending()->exit_status, static_cast<int>(ExitStatus::not_admitted));
  EXPECT_THAT(greedy.stderr_tail(), HasSubstr("it wants to play 2 bats, of 8 here 1 are free"));
  const Process& other = join(second, {"--seed", "9"});
  ASSERT_TRUE(ends(other));
  EXPECT_THAT(other.stderr_tail(), HasSubstr("another scene"));
  ASSERT_TRUE(ends(first) && ends(second));
  const KeyLog log = read_key_log(std::filesystem::path(file));
  Game one(load_scene(scene()));
  for (const InputEvent& event : log.events) one.submit(event);
  one.advance(3.0);
  EXPECT_TRUE(std::any_of(log.events.begin(), log.events.end(),
                          [](const InputEvent& event) { return event.player >= 3; }));
  for (const Process* peer : {&first, &second}) EXPECT_EQ(hash_of(*peer), printed(one.hash()));
}

TEST_F(PeerJoining, SeveralWhoComeAtOnceEachPlayTheirOwnBats) {
  const std::string file = (folder_ / "live.keys").string();
  const Words real{"--pace", "realtime", "--bots", "1", "--players", "random"};
  Words recorded = real;
  recorded.insert(recorded.end(), {"--record", file});
  Process& first = found(1, "7", recorded);
  ASSERT_TRUE(are_playing({&first}));
  std::vector<Process*> all{&first};
  for (int k = 0; k < 5; ++k) all.push_back(&join(first, real));
  for (const Process* peer : all) {
    ASSERT_TRUE(ends(*peer));
    EXPECT_EQ(peer->ending()->exit_status, 0) << peer->stderr_tail();
    EXPECT_EQ(hash_of(*peer), hash_of(first));
    EXPECT_NE(peer->line_after("  \"key_presses\": "), "0,");
  }
  std::set<std::uint32_t> players;
  for (const InputEvent& event : read_key_log(std::filesystem::path(file)).events)
    players.insert(event.player);
  EXPECT_EQ(players, (std::set<std::uint32_t>{0, 1, 2, 3, 4, 5}));
}

TEST_F(PeerJoining, MayBeAskedForBeforeTheFirstListens) {
  const auto free_port = [] { return rti::TcpTransport().listen("127.0.0.1", 0); };
  const std::string place = "127.0.0.1:" + std::to_string(free_port());
  Process& early = *peers_.emplace_back(std::make_unique<Process>(
      test::binary_folder() + "/bin/rink-peer", Words{"--scene", scene(), "--join", place}));
  pass(1000ms);
  EXPECT_FALSE(early.ending());
  Process& first = start({"--peers", "2", "--until", "1", "--listen", place});
  for (const Process* peer : {&first, &early}) {
    ASSERT_TRUE(ends(*peer));
    EXPECT_EQ(hash_of(*peer), truth(1.0)) << peer->stderr_tail();
  }
}

TEST_F(PeerJoining, InAStormOfLeavingAndDyingLeavesTheGameOfOneEngine) {
  const Words real{"--pace", "realtime"};
  Process& first = found(3, "12", real);
  std::vector<Process*> there{&first, &join(first, real), &join(first, real)};
  ASSERT_TRUE(are_playing({there[0], there[1], there[2]}));
  int killed = 0;
  for (int turn = 0; turn < 6; ++turn) {
    Process& newcomer = join(*there.back(), real);
    Process& another = join(*there.front(), real);
    ASSERT_TRUE(is_in(newcomer)) << newcomer.stderr_tail();
    ASSERT_TRUE(is_in(another)) << another.stderr_tail();
    there.push_back(&newcomer), there.push_back(&another);
    ASSERT_EQ(kill(there[0]->id(), SIGINT), 0);
    if (turn % 2 == 0) {
      pass(100ms);
      ASSERT_EQ(kill(there[1]->id(), SIGKILL), 0);
      ++killed;
    } else {
      ASSERT_EQ(kill(there[1]->id(), SIGTERM), 0);
    }
    there.erase(there.begin(), there.begin() + 2);
  }
  EXPECT_EQ(killed, 3);
  for (const Process* peer : there) {
    ASSERT_TRUE(ends(*peer));
    EXPECT_EQ(peer->ending()->exit_status, 0) << peer->stderr_tail();
    EXPECT_EQ(hash_of(*peer), truth(12.0));
  }
}

/// Says one thing for ever.
class OneWord final : public peer::Mail {
 public:
  explicit OneWord(std::vector<std::uint8_t> word) : word_(std::move(word)) {}
  void send(peer::PeerNumber, std::vector<std::uint8_t>) override {}
  std::vector<std::uint8_t> receive(peer::PeerNumber) override { return word_; }

 private:
  std::vector<std::uint8_t> word_;
};

TEST(Newcomer, BelievesNoBeginningThatIsNotWhereAWindowEnds) {
  const Game start(parse_scene(small_scene, "small.toml"));
  const auto begin = [&](std::uint64_t window, double time) {
    peer::State state{.step = 9,
                      .window = window,
                      .time = time,
                      .members = {0, 1},
                      .cuts = peer::Cuts::whole(start.world().spec().field)};
    state.fresh = {1};
    state.slots = state.next_number = 2;
    OneWord mail(peer::written(peer::Entry{.state = state}));
    peer::SessionSettings settings{.number = 1, .window_count = 10, .end_of = [](std::uint64_t k) {
                                     return 0.02 * static_cast<double>(k);
                                   }};
    settings.seats_of = [](const peer::Player&) { return std::vector<peer::Seat>(); };
    const peer::Session session(start.world(), std::move(settings), mail, {0});
    return session.peer().now();
  };
  EXPECT_EQ(begin(5, 0.1), 0.1);
  EXPECT_THROW(begin(5, 0.12), peer::ProtocolError) << "a window later";
  EXPECT_THROW(begin(5, 0.11), peer::ProtocolError) << "nothing cuts windows here";
  EXPECT_THROW(begin(9, 0.18), peer::ProtocolError) << "all is over by then";
  EXPECT_THROW(begin(0xffffffffffffffffu, 0.1), peer::ProtocolError);
}

}  // namespace
}  // namespace rink::game
