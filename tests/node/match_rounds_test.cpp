// Rounds of matches: short, checked against lies, and the same game at both nodes.
#include "game/node/match/match_rounds.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <exception>
#include <random>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "game/control/bat_controller.h"
#include "game/model/scene_file.h"
#include "game/model/time_grid.h"
#include "game/net/peer/crowd.h"
#include "game/net/peer/network/frames.h"
#include "game/node/node_terms.h"
#include "tests/peer/thread_mail.h"
#include "tests/places.h"

namespace rink::game {
namespace {

constexpr std::uint64_t state = 0x0123456789abcdef;

TEST(MatchRounds, TakeFiveBytesWithoutKeys) {
  const std::vector<std::uint8_t> bytes = written({.window = 1'000'000}, state);
  EXPECT_EQ(bytes.size(), 5u);
  Round read{.window = 1'000'000};
  EXPECT_EQ(fault_of(bytes, state, read), "");
  EXPECT_TRUE(read.keys.empty());
}

TEST(MatchRounds, CarryEveryKeyAndThrust) {
  constexpr double thrust = 12.3;
  for (unsigned held = 0; held < 16; ++held)
    for (std::uint8_t input = 1; input <= 8; ++input) {
      BatController controller(thrust);
      for (const Key key : all_keys)
        if ((held >> static_cast<unsigned>(key) & 1u) != 0) controller.press(key, true);
      const auto sign = [](double along) { return along > 0.0 ? 2u : along < 0.0 ? 0u : 1u; };
      const RoundKey key{
          .player = 1,
          .code = input - 1u +
                  8u * (3u * sign(controller.thrust().y()) + sign(controller.thrust().x())),
          .steps = 1088};
      Round read{.window = 7};
      ASSERT_EQ(fault_of(written({.window = 7, .keys = {key}}, state), state, read), "");
      ASSERT_EQ(read.keys.size(), 1u);
      EXPECT_EQ(read.keys[0].code, key.code);
      EXPECT_EQ(thrust_of(read.keys[0], thrust), controller.thrust());
    }
}

TEST(MatchRounds, RefuseWhatNoNodeSays) {
  const Round round{.window = 7, .keys = {{.player = 1, .code = 71, .steps = RoundKey::steps_max}}};
  const std::vector<std::uint8_t> sound = written(round, state);
  const auto fault = [](const std::vector<std::uint8_t>& bytes, std::uint64_t own_state = state) {
    Round read{.window = 7};
    return fault_of(bytes, own_state, read);
  };
  EXPECT_EQ(fault(sound), "");
  EXPECT_EQ(fault(sound, state + 1),
            "has another state than this node before window 8 of the match");
  for (std::size_t byte = 0; byte < sound.size(); ++byte)
    for (int bit = 0; bit < 8; ++bit) {
      std::vector<std::uint8_t> other = sound;
      other[byte] = static_cast<std::uint8_t>(other[byte] ^ 1u << bit);
      EXPECT_NE(fault(other), "") << byte << " " << bit;
    }
  for (std::size_t size = 0; size < sound.size(); ++size)
    EXPECT_NE(fault({sound.begin(), sound.begin() + static_cast<std::ptrdiff_t>(size)}), "");
  EXPECT_NE(fault(written({.window = 8}, state)), "");
}

/// A check that fits shows no fault of what it covers.
std::vector<std::uint8_t> sealed(std::vector<std::uint8_t> content) {
  Fnv64 hash;
  for (const std::uint8_t byte : content) hash.add(byte);
  for (int shift = 0; shift < 64; shift += 8) hash.add(static_cast<std::uint8_t>(state >> shift));
  const std::uint64_t sum = hash.value() ^ hash.value() >> 32;
  for (int shift = 0; shift < 32; shift += 8)
    content.push_back(static_cast<std::uint8_t>(sum >> shift));
  return content;
}

TEST(MatchRounds, RefuseSealedLies) {
  const auto fault = [](std::vector<std::uint8_t> content) {
    Round read{.window = 7};
    return fault_of(sealed(std::move(content)), state, read);
  };
  EXPECT_EQ(fault({0x87}), "");
  EXPECT_EQ(fault({0xc7, 1, 1, 71, 5}), "");
  const std::string lie = "said no round of window 8";
  EXPECT_EQ(fault({}), lie);
  EXPECT_EQ(fault({0x07}), lie) << "a loss, perhaps";
  EXPECT_EQ(fault({0x88}), lie) << "another window";
  EXPECT_EQ(fault({0x87, 0}), lie) << "more than a round";
  EXPECT_EQ(fault({0xc7}), lie) << "no keys, though some are due";
  EXPECT_EQ(fault({0xc7, 0}), lie);
  EXPECT_EQ(fault({0xc7, 1, 1, 72, 5}), lie) << "no direction";
  EXPECT_EQ(fault({0xc7, 2, 1, 71, 5}), lie) << "one key of two";
  EXPECT_EQ(fault({0xc7, 1, 1, 71, 0xff, 0xff, 0xff, 0x7f}), lie) << "minutes ahead";
  std::vector<std::uint8_t> flood{0xc7, 0x81, 0x02};
  for (int key = 0; key < 257; ++key) flood.insert(flood.end(), {1, 71, 5});
  EXPECT_EQ(fault(flood), lie);
}

/// Counts what frames would carry.
class CountedMail final : public peer::Mail {
 public:
  CountedMail(peer::test::PostOffice& office, peer::PeerNumber number) : mail_(office, number) {}
  void send(peer::PeerNumber to, std::vector<std::uint8_t> content) override {
    bytes += framed_size(content.size());
    mail_.send(to, std::move(content));
  }
  std::vector<std::uint8_t> receive(peer::PeerNumber from) override { return mail_.receive(from); }
  std::uint64_t bytes = 0;

 private:
  peer::test::ThreadMail mail_;
};

enum class Lie { none, key_of_another, key_of_nobody, untold_key };

/// A node that plays a match of the shipped scene, as `Node` does, with a player of its own who
/// presses keys at random.
class PlayingNode final : public WindowParticipant {
 public:
  PlayingNode(peer::test::PostOffice& office, peer::PeerNumber number, const Scene& scene)
      : game_(scene, {}),
        mail_(office, number),
        seats_(table(), number, 2),
        members_(mail_, game_.start().world(), number, 2, false),
        random_(number + 1) {
    for (std::uint32_t player = 0; player < 2; ++player)
      seats_.hear({.window = 1, .node = player, .player = player, .token = player + 1u});
  }

  void play(std::uint64_t windows) {
    Terms terms = terms_of_matches(1, 1.0 / 60.0, 0);
    terms.is_replicated = false;
    PartOptions options;
    options.participant = this;
    options.takes_latecomers = true;
    options.is_stopped = [windows](std::uint64_t window) { return window >= windows; };
    part = game_.play(terms, std::array{PeerInfo{}}, 0, mail_, options);
    rounds_.confirm(members_, part.hash);
  }
  std::uint64_t replayed() const {
    Game game(game_.scene());
    for (const InputEvent& key : part.keys) game.submit(key);
    game.advance(part.time);
    return game.hash();
  }

  double bytes_per_s() const { return static_cast<double>(mail_.bytes) / part.time; }

  Lie lie = Lie::none;  ///< after a second
  PlayedPart part;

 private:
  static SeatTable table() { return {2, 0.0}; }
  void before_window(peer::Session& session) override {
    for (const SeatDecision& decision : seats_.due(session.window()))
      session.peer().players().move_seat({.bat = game_.start().bat(decision.player)->index,
                                          .peer = 0,
                                          .period = 0.0,
                                          .puck_count = 0});
    if (session.window() > 0 && random_() % 4 == 0) {
      const Key key = all_keys[random_() % 4];
      const bool is_down = !controller_.keys().is_down(key);
      controller_.press(key, is_down);
      const double ahead = static_cast<double>(random_() % 3000) * key_grid;
      last_ = std::max(last_, session.peer().now() + ahead);
      rounds_.press({.bat = game_.start().bat(seats_.number())->index,
                     .thrust = controller_.thrust(),
                     .input = input_of(
                         {.kind = is_down ? InputKind::key_down : InputKind::key_up, .key = key}),
                     .time = last_});
    }
    if (lie != Lie::none && session.window() == 60) tell_a_lie(session);
    rounds_.exchange(members_, game_, seats_, session);
    members_.finish_round();
  }
  void tell_a_lie(peer::Session& session) {
    const std::uint32_t bat = game_.start().bat(seats_.number())->index;
    if (lie == Lie::untold_key) {
      const peer::Press untold{.bat = bat, .thrust = {1.0, 0.0}};
      return session.peer().receive(0, {&untold, 1});
    }
    const std::uint32_t player = lie == Lie::key_of_another ? 0 : 2;
    mail_.send(0,
               written({.window = 60, .keys = {{.player = player, .code = 5}}}, state_of(session)));
    throw peer::Halt("the liar goes");
  }

  SharedGame game_;
  CountedMail mail_;
  NodeSeats seats_;
  MatchMembers members_;
  MatchRounds rounds_;
  std::mt19937 random_;
  double last_ = 0.0;
  BatController controller_{game_.scene().bodies.bats[0].thrust};
};

TEST(MatchRounds, PlayTheGameOfOneEngineInFewBytes) {
  constexpr std::uint64_t windows = 1200;
  const Scene scene = load_scene(rink::test::source_folder() + "/scenes/match.toml");
  peer::test::PostOffice office(2);
  PlayingNode one(office, 0, scene), two(office, 1, scene);
  std::thread other([&] { two.play(windows); });
  one.play(windows);
  other.join();
  EXPECT_EQ(one.part.hash, two.part.hash);
  EXPECT_EQ(one.part.keys, two.part.keys);
  EXPECT_GT(one.part.keys.size(), windows / 4);
  EXPECT_EQ(one.replayed(), one.part.hash);
  // A server sends each player of a match about 500 bytes/s.
  EXPECT_LT(one.bytes_per_s(), 700.0) << "15 keys/s are many";
  EXPECT_LT(two.bytes_per_s(), 700.0);
}

TEST(MatchRounds, NameWhoLies) {
  const Scene scene = load_scene(rink::test::source_folder() + "/scenes/match.toml");
  for (const auto& [lie, what] :
       {std::pair{Lie::key_of_another, "peer 1 presses a key of player 0, who does not play there"},
        std::pair{Lie::key_of_nobody, "peer 1 presses a key of player 2, who does not play there"},
        std::pair{Lie::untold_key,
                  "peer 1 has another state than this node before window 62 of the match"}}) {
    peer::test::PostOffice office(2);
    PlayingNode one(office, 0, scene), two(office, 1, scene);
    two.lie = lie;
    std::thread liar([&] {
      try {
        two.play(120);
      } catch (const std::exception&) {  // it goes, or misses the other
      }
    });
    std::string fault;
    try {
      one.play(120);
    } catch (const peer::ProtocolError& error) {
      fault = error.what();
    }
    EXPECT_EQ(fault, what);
    liar.join();
  }
}

}  // namespace
}  // namespace rink::game
