// A person at one of two peers: what the window shows of the own bat is what one engine plays from
// everybody's keys, frame by frame.
#include <gtest/gtest.h>

#include <random>
#include <thread>

#include "game/model/scene_file.h"
#include "game/net/peer/local_player.h"
#include "game/net/peer/peer_match.h"
#include "tests/peer/thread_mail.h"

namespace rink::game {
namespace {

using physics::Vector2;

/// The match without goals: two bats, in one half each, one puck and two posts.
Scene duel() {
  std::string text = scene_text("paper");
  const auto cut = [&](const std::string& from, const std::string& to) {
    const std::size_t begin = text.find(from);
    text.erase(begin, text.find(to, begin) - begin);
  };
  cut("goal_width", "bats_keep");
  cut("[match]", "[[post]]");
  return parse_scene(text, "duel.toml");
}

constexpr double frame_s = 1.0 / 60.0;

/// Looks at 60 frames a second of a real time by which each window is played when it begins, and
/// presses keys at random.
class Person final : public WindowParticipant {
 public:
  struct Frame {
    double instant;
    Vector2 own, other;
  };

  Person(const SharedGame& game, std::uint32_t player, std::uint32_t seed)
      : hand_player_(game, player, hand_), match_(game, hand_), player_(player), random_(seed) {
    hand_.set_player(player);
    hand_.set_stage(PeerStage::Step::playing, "");
  }

  void before_window(peer::Session& session) override {
    for (; next_s_ < session.peer().now(); next_s_ += frame_s) look(next_s_);
    hand_player_.before_window(session);
  }
  void after_window(const peer::Session& session) override { hand_player_.after_window(session); }

  std::vector<Frame> frames;
  std::vector<double> pressed;  ///< at these instants the window has shown it already
  const PeerMatch& match() const { return match_; }

 private:
  void look(double now_s) {
    for (const Key key : all_keys)
      if (now_s > 0.5 && random_() % 16 == 0)
        match_.press(0, key, is_down_[static_cast<std::size_t>(key)] ^= true), ++waiting_;
    match_.advance(now_s);
    const PredictedRink* rink = match_.prediction();
    if (rink == nullptr || now_s < 0.5) return;
    pressed.insert(pressed.end(), std::exchange(waiting_, 0),
                   std::ceil(rink->now() * 0x1p16) * 0x1p-16);
    frames.push_back(
        {rink->now(), rink->bats()[player_].position, rink->bats()[1 - player_].position});
  }

  InputQueue hand_;
  LocalPlayer hand_player_;
  PeerMatch match_;
  std::uint32_t player_;
  std::minstd_rand random_;
  std::array<bool, 4> is_down_{};
  int waiting_ = 0;
  double next_s_ = 0.0;
};

struct Played {
  std::vector<Person::Frame> frames;
  std::vector<double> pressed;
  PlayedPart part;
  std::uint64_t corrections = 0;
};

/// For `until` seconds; the person is at peer 0 and plays bat `player`, of which peer `player` owns
/// the half where it is.
Played played_by_a_person(const SharedGame& game, std::uint32_t player, double until) {
  const Terms terms{.peer_count = 2, .until = until, .window = 0.02, .balance_windows = 0};
  std::vector<PeerInfo> peer_infos(2);
  peer_infos[0] = {.place = {}, .first_bat = player, .bat_count = 1, .hand_count = 1};
  peer_infos[1] = {.place = {}, .first_bat = 1 - player, .bat_count = 1};
  peer::test::PostOffice office(2);
  std::thread other([&] {
    peer::test::ThreadMail mail(office, 1);
    PartOptions part_options;
    part_options.players = {"random"};
    game.play(terms, peer_infos, 1, mail, part_options);
  });
  Played played;
  Person person(game, player, 7 + player);
  peer::test::ThreadMail mail(office, 0);
  PartOptions part_options;
  part_options.participant = &person;
  played.part = game.play(terms, peer_infos, 0, mail, part_options);
  other.join();
  played.frames = std::move(person.frames), played.pressed = std::move(person.pressed);
  played.corrections = person.match().prediction()->own_corrections().visible_count;
  return played;
}

class APersonAtAPeer : public testing::TestWithParam<std::uint32_t> {};

TEST_P(APersonAtAPeer, SeesTheOwnBatAnswerInTheSameFrameWhereOneEngineHasIt) {
  const SharedGame game(duel(), {});
  const std::uint32_t player = GetParam();
  const Played played = played_by_a_person(game, player, 20.0);

  Game one(duel());
  for (const InputEvent& event : played.part.keys) one.submit(event);
  std::vector<double> own_errors;
  for (const Person::Frame& frame : played.frames) {
    if (frame.instant > 20.0 || frame.instant < one.now()) continue;
    one.advance(frame.instant);
    own_errors.push_back((frame.own - one.position(*one.bat(player))).norm());
  }
  one.advance(20.0);
  EXPECT_EQ(one.hash(), played.part.hash);
  // Of a hit of the puck that the other's key has brought about nothing is known before its
  // window's end; for a tenth of a second after that the difference is led away.
  std::sort(own_errors.begin(), own_errors.end());
  ASSERT_GT(own_errors.size(), 1000u);
  EXPECT_LT(own_errors[own_errors.size() * 9 / 10], 1e-9);
  EXPECT_LT(own_errors.back(), 0.02);

  std::vector<double> felt;
  for (const InputEvent& event : played.part.keys)
    if (event.player == player) felt.push_back(event.time);
  ASSERT_GT(felt.size(), 200u);
  ASSERT_LE(felt.size(), played.pressed.size());
  EXPECT_EQ(felt,
            std::vector<double>(played.pressed.begin(),
                                played.pressed.begin() + static_cast<std::ptrdiff_t>(felt.size())))
      << "a key was late";
}

INSTANTIATE_TEST_SUITE_P(WhoOwnsTheBat, APersonAtAPeer, testing::Values(0u, 1u),
                         [](const auto& info) {
                           return info.param == 0 ? "Itself" : "AsTheOtherPeerDoes";
                         });

}  // namespace
}  // namespace rink::game
