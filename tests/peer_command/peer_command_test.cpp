// The command rink-peer: processes that find each other, play to the hash of one engine, and refuse
// who is different.
#include "tests/peer_command/peer_processes.h"

#include "game/net/address.h"
#include "game/net/peer/network/frames.h"
#include "game/net/peer/shared_game.h"
#include "rti/transport/tcp/tcp.h"

namespace rink::game {
namespace {

TEST_F(PeerCommand, EndsInTheHashOfOneEngineForTwoAndFourPeersOverTcpAndSharedMemory) {
  Game one(load_scene(scene()));
  one.advance(2.0);
  for (const char* transport : {"tcp", "shm"})
    for (const int count : {2, 4}) {
      const Process& first = found(count, "2", {"--transport", transport});
      std::vector<const Process*> all{&first};
      // Each asks another one that is there.
      while (static_cast<int>(all.size()) < count)
        all.push_back(&join(*all.back(), {"--transport", transport}));
      for (const Process* peer : all) {
        ASSERT_TRUE(ends(*peer));
        EXPECT_EQ(peer->ending()->exit_status, 0) << peer->stderr_tail();
        EXPECT_EQ(hash_of(*peer), printed(one.hash())) << count << " peers over " << transport;
      }
    }
}

TEST_F(PeerCommand, PlaysRecordedKeysToTheHashOfTheirLog) {
  const Scene shared = load_scene(scene());
  Playing playing(shared, {"chaser", "random"}, 7, 3.0);
  playing.advance(3.0);
  KeyLog log = key_log_for(shared);
  log.events = playing.keys();
  const std::string file = (folder_ / "game.keys").string();
  write_key_log(std::filesystem::path(file), log);
  Process& first = found(3, "3", {"--keys", file, "--window", "0.07"});
  const Process& keyless = join(first);
  ASSERT_TRUE(ends(keyless));
  EXPECT_EQ(keyless.ending()->exit_status, static_cast<int>(ExitStatus::not_admitted));
  EXPECT_THAT(keyless.stderr_tail(), HasSubstr("it has other keys"));
  const std::vector<const Process*> all{&first, &join(first, {"--keys", file}),
                                        &join(first, {"--keys", file})};
  for (const Process* peer : all) {
    ASSERT_TRUE(ends(*peer));
    EXPECT_EQ(hash_of(*peer), printed(playing.game().hash()));
  }
}

TEST_F(PeerCommand, RecordsWhatBotsOfAllPeersPlayedLiveAsAKeyLogOfTheSameGame) {
  const std::string file = (folder_ / "live.keys").string();
  for (const char* pace : {"free", "realtime"}) {
    Process& first = found(3, "2",
                           {"--bots", "3", "--players", "chaser,random", "--record", file, "--pace",
                            pace, "--balance", "5"});
    const std::vector<const Process*> all{
        &first, &join(first, {"--bots", "4", "--players", "waypoint"}), &join(first)};
    for (const Process* peer : all) ASSERT_TRUE(ends(*peer));
    const KeyLog log = read_key_log(std::filesystem::path(file));
    const Scene shared = load_scene(scene());
    require_fit(log, shared, file);
    Game one(shared);
    for (const InputEvent& event : log.events) one.submit(event);
    one.advance(2.0);
    std::vector<int> counts(8, 0);
    for (const InputEvent& event : log.events) ++counts[event.player];
    EXPECT_THAT(std::span(counts).first(7), testing::Each(testing::Gt(0)));
    EXPECT_EQ(counts[7], 0);
    for (const Process* peer : all) EXPECT_EQ(hash_of(*peer), printed(one.hash())) << pace;
    EXPECT_EQ(log.hash, one.hash());
  }
}

TEST_F(PeerCommand, LetsNobodyPlayMoreBatsThanThereAre) {
  const Process& greedy = start({"--listen", "127.0.0.1:0", "--bots", "9"});
  ASSERT_TRUE(ends(greedy));
  EXPECT_THAT(greedy.stderr_tail(), HasSubstr("--bots: 9 wanted, the scene has 8 bats"));
  Process& first = found(2, "1", {"--bots", "5"});
  const Process& late = join(first, {"--bots", "4"});
  ASSERT_TRUE(ends(late));
  EXPECT_EQ(late.ending()->exit_status, static_cast<int>(ExitStatus::not_admitted));
  EXPECT_THAT(late.stderr_tail(), HasSubstr("it wants to play 4 bats, of 8 here 3 are free"));
}

TEST_F(PeerCommand, RefusesOtherScenesAndWhoComesTooLateByNameAndGoesOn) {
  Process& first = found(2, "1");
  std::ofstream(folder_ / "other.toml") << small_scene << "[match]\nface_off_delay = 2.0\n";
  const Process& seeded = join(first, {"--seed", "9"});
  ASSERT_TRUE(ends(seeded));
  EXPECT_EQ(seeded.ending()->exit_status, static_cast<int>(ExitStatus::not_admitted));
  EXPECT_THAT(seeded.stderr_tail(), testing::AllOf(HasSubstr("does not let this one in"),
                                                   HasSubstr("another scene: its fingerprint is"),
                                                   HasSubstr("here it is")));
  const Process& other = start({"--join", place_of(first)}, (folder_ / "other.toml").string());
  ASSERT_TRUE(ends(other));
  EXPECT_THAT(other.stderr_tail(), HasSubstr("another scene"));
  const Process& second = join(first);
  ASSERT_TRUE(ends(second) && ends(first));
  EXPECT_EQ(first.ending()->exit_status, 0) << first.stderr_tail();

  Process& crowded = found(2, "1000", {"--unmirrored"});
  const Process& last = join(crowded);
  ASSERT_TRUE(are_playing({&crowded, &last}));
  const Process& third = join(last);
  ASSERT_TRUE(ends(third));
  EXPECT_EQ(third.ending()->exit_status, static_cast<int>(ExitStatus::not_admitted));
  EXPECT_THAT(
      third.stderr_tail(),
      HasSubstr("they play already, and without replicas (--unmirrored) none can join them"));
  EXPECT_FALSE(crowded.ending());
}

TEST_F(PeerCommand, SaysWhatItCannotPlay) {
  const Process& goals = start({"--listen", "127.0.0.1:0", "--window", "0.2"}, "crowd");
  ASSERT_TRUE(ends(goals));
  EXPECT_EQ(goals.ending()->exit_status, 2);
  EXPECT_THAT(goals.stderr_tail(), HasSubstr("windows are 0.200000 s long: expected shorter ones"));
  const Process& grid = start({"--listen", "127.0.0.1:0"}, "crowd-grid");
  ASSERT_TRUE(ends(grid));
  EXPECT_EQ(grid.ending()->exit_status, 2);
  EXPECT_THAT(grid.stderr_tail(), HasSubstr("has a network_grid, and peers and nodes cannot yet"));
  const Process& alone = start({"--join", "127.0.0.1:1"});
  ASSERT_TRUE(ends(alone));
  EXPECT_EQ(alone.ending()->exit_status, static_cast<int>(ExitStatus::no_server));
  EXPECT_THAT(alone.stderr_tail(), HasSubstr("no peer answers at 127.0.0.1:1"));
}

TEST_F(PeerCommand, SaysByItsStatusThatAReportOrARecordCouldNotBeWritten) {
  const std::string peer = test::binary_folder() + "/bin/rink-peer --scene " + scene() +
                           " --peers 1 --until 0.1 --listen 127.0.0.1:0";
  EXPECT_EQ(WEXITSTATUS(std::system((peer + " > /dev/full 2> /dev/null").c_str())),
            static_cast<int>(ExitStatus::failed));
  EXPECT_NE(
      WEXITSTATUS(std::system((peer + " --record /dev/full > /dev/null 2> /dev/null").c_str())), 0);
  EXPECT_EQ(WEXITSTATUS(std::system((peer + " > /dev/null 2> /dev/null").c_str())), 0);
}

/// Says `bytes` to a peer, and hears all until that closes the connection.
class Stranger final : public rti::TransportListener {
 public:
  Stranger(const std::string& place, rti::Bytes bytes) {
    const auto [address, port] = address_and_port("place", place);
    connection_ = transport_.connect(address, port);
    const auto end = std::chrono::steady_clock::now() + 10s;
    while (!is_closed_ && std::chrono::steady_clock::now() < end) {
      transport_.poll(10ms, *this);
      if (is_open_ && !bytes.empty()) {
        transport_.send(connection_, std::span(&bytes, 1));
        bytes = {};
      }
    }
  }
  bool is_closed() const { return is_closed_; }
  std::optional<Frame> frame() { return reader_.next(stranger_frame_max); }

 private:
  void on_open(rti::ConnectionId) override { is_open_ = true; }
  void on_bytes(rti::ConnectionId, rti::Bytes bytes) override {
    reader_.add(bytes);
    reader_.keep();
  }
  void on_close(rti::ConnectionId, rti::CloseReason, const std::string&) override {
    is_closed_ = true;
  }

  rti::TcpTransport transport_;
  rti::ConnectionId connection_ = 0;
  bool is_open_ = false, is_closed_ = false;
  FrameQueue reader_;
};

constexpr const char* recorded_hello =
    "540000000052696e6b506565720d0000005ce91684a4c39164b0cb50f53ac66fcca9b59d32bce6eeaf09000000"
    "3132372e302e302e314bab00000000000000000000000000000000c11ef711b799f64803c3a4cefc7f83d0";

TEST_F(PeerCommand, RefusesAnotherVersionAndAnotherBuildByName) {
  Process& first = found(2, "1");
  const Fingerprint session_fingerprint = SharedGame(load_scene(scene()), {}).session_fingerprint();
  const auto answer_to = [&](const Hello& hello) {
    Stranger stranger(place_of(first), framed(FrameKind::hello, bytes_of(hello)));
    const auto frame = stranger.frame();
    return frame && frame->kind == FrameKind::refusal ? message_from<Refused>(frame->content)
                                                      : std::nullopt;
  };
  Hello hello;
  hello.session_fingerprint = session_fingerprint, hello.info.place = {"127.0.0.1", 1};
  for (const std::uint32_t theirs : {peer_protocol_version + 1, peer_protocol_version - 1}) {
    hello.version = theirs;
    const auto version = answer_to(hello);
    ASSERT_TRUE(version);
    EXPECT_EQ(version->kind, RefusalKind::wrong_version);
    EXPECT_THAT(version->reason, HasSubstr("speaks version " + std::to_string(theirs) +
                                           " of the peers' protocol, here it is version " +
                                           std::to_string(peer_protocol_version)));
  }
  // The hello of version 13 as a peer of it sent it: four bytes say how long the frame is.
  std::vector<std::byte> recorded;
  for (const char* each = recorded_hello; *each != '\0'; each += 2)
    recorded.push_back(static_cast<std::byte>(std::stoi(std::string(each, 2), nullptr, 16)));
  Stranger older(place_of(first), recorded);
  const auto answer = older.frame();
  ASSERT_TRUE(answer);
  const auto refused = message_from<Refused>(answer->content);
  ASSERT_TRUE(refused);
  EXPECT_EQ(refused->kind, RefusalKind::wrong_version);
  EXPECT_THAT(refused->reason,
              HasSubstr("speaks version 13 of the peers' protocol, here it is version 14"));
  hello.version = peer_protocol_version;
  ++hello.session_fingerprint.self_test;
  const auto build = answer_to(hello);
  ASSERT_TRUE(build);
  EXPECT_THAT(build->reason, HasSubstr("a build that computes other bits"));
  const Process& second = join(first);
  ASSERT_TRUE(ends(second) && ends(first));
  EXPECT_EQ(hash_of(first), hash_of(second));
}

TEST_F(PeerCommand, LosesNoMoreThanTheConnectionToStrangersWhoSayAnything) {
  Process& first = found(2, "1");
  std::vector<std::vector<std::byte>> words;
  const std::array<std::vector<std::uint8_t>, 4> no_frames{
      {{'G', 'E', 'T', ' ', '/', ' ', 'H', 'T', 'T', 'P', '\r', '\n'},
       {0, 0, 0, 0, 0},
       {255, 255, 255, 255, 0},
       {1, 0, 0, 0, 9}}};
  for (const auto& bytes : no_frames) {
    const rti::Bytes view = std::as_bytes(std::span(bytes));
    words.emplace_back(view.begin(), view.end());
  }
  for (const FrameKind kind :
       {FrameKind::hello, FrameKind::welcome, FrameKind::elsewhere, FrameKind::refusal,
        FrameKind::greeting, FrameKind::mail, FrameKind::farewell})
    words.push_back(framed(kind, std::vector<std::uint8_t>(40, 0x55)));
  words.push_back(
      framed(FrameKind::greeting,
             bytes_of(Greeting{.session = 1, .number = 1, .info = {{"127.0.0.1", 1}}})));
  Hello damaged;
  damaged.info.place = {"127.0.0.1", 1};
  std::vector<std::uint8_t> content = bytes_of(damaged);
  for (std::size_t k = 0; k < content.size(); ++k) {
    std::vector<std::uint8_t> other = content;
    other[k] ^= 0x10;
    words.push_back(framed(FrameKind::hello, other));
  }
  for (const auto& bytes : words) EXPECT_TRUE(Stranger(place_of(first), bytes).is_closed());
  const Process& second = join(first);
  ASSERT_TRUE(ends(second) && ends(first));
  EXPECT_EQ(first.ending()->exit_status, 0) << first.stderr_tail();
  EXPECT_EQ(hash_of(first), hash_of(second));
}

}  // namespace
}  // namespace rink::game
