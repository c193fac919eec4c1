// The pure way from a sight to a picture: cameras by their geometry, keys by what they look like.
#include "game/view/picture_of.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace rink::view {
namespace {

constexpr double wide = 16.0 / 9.0;
const physics::Field table{.length = 2.4, .width = 1.2, .goal_width = 0.4};

MatchSight bat_and_puck() {
  MatchSight sight;
  sight.field = table;
  sight.goals_to_win = 5;
  sight.phase = Phase::playing;
  sight.things.push_back({.id = 0,
                          .kind = physics::BodyKind::bat,
                          .team = game::Team::left,
                          .position = {0.25, 0.6},
                          .half_extent = {0.03, 0.1}});
  sight.things.push_back({.id = 1,
                          .kind = physics::BodyKind::puck,
                          .position = {1.2, 0.6},
                          .half_extent = {0.04, 0.04}});
  return sight;
}

Sight seen(Viewpoint viewpoint, double aspect = wide) {
  return Sight(camera_of(table, {.viewpoint = viewpoint}, aspect), static_cast<float>(aspect));
}

TEST(Cameras, ShowTheWholeTableWhateverTheWindowsShape) {
  for (const double aspect : {4.0 / 3.0, wide, 21.0 / 9.0})
    for (const Viewpoint viewpoint :
         {Viewpoint::left_end, Viewpoint::right_end, Viewpoint::side, Viewpoint::above})
      for (const float x : {0.0f, 2.4f})
        for (const float y : {0.0f, 1.2f}) {
          const Eigen::Vector2f at = seen(viewpoint, aspect).project({x, y, 0.0f});
          EXPECT_LT(std::max(std::abs(at.x()), std::abs(at.y())), 1.0f)
              << "viewpoint " << static_cast<int>(viewpoint) << ", aspect " << aspect << ", corner "
              << x << ' ' << y;
        }
}

TEST(Cameras, PutTheOwnEndNearAndTheOtherFar) {
  EXPECT_LT(seen(Viewpoint::left_end).project({0.2f, 0.6f, 0.0f}).y(),
            seen(Viewpoint::left_end).project({2.2f, 0.6f, 0.0f}).y());
  EXPECT_GT(seen(Viewpoint::right_end).project({0.2f, 0.6f, 0.0f}).y(),
            seen(Viewpoint::right_end).project({2.2f, 0.6f, 0.0f}).y());
}

TEST(Cameras, FindThePlaceOnTheTableThatAPointOfTheWindowShows) {
  for (const Viewpoint viewpoint :
       {Viewpoint::left_end, Viewpoint::right_end, Viewpoint::side, Viewpoint::above}) {
    const Sight sight = seen(viewpoint);
    const Eigen::Vector2f place(0.7f, 0.9f),
        back = sight.on_table(sight.project({place.x(), place.y(), 0.0f}));
    EXPECT_LT((back - place).norm(), 1e-5f) << static_cast<int>(viewpoint);
  }
}

/// The claim of seen_from: whatever the viewpoint, the field's key moves the bat in the window
/// where the player's key points.
TEST(Keys, MoveTheBatWhereTheyPointFromEveryEnd) {
  for (const Viewpoint viewpoint :
       {Viewpoint::left_end, Viewpoint::right_end, Viewpoint::side, Viewpoint::above})
    for (const game::Key key : game::all_keys) {
      const game::Key on_field = seen_from(viewpoint, key);
      const auto way = [](game::Key k) {
        return Vector3(k == game::Key::right  ? 0.1f
                       : k == game::Key::left ? -0.1f
                                              : 0.0f,
                       k == game::Key::up     ? 0.1f
                       : k == game::Key::down ? -0.1f
                                              : 0.0f,
                       0.0f);
      };
      const Vector3 middle(1.2f, 0.6f, 0.0f);
      const Sight sight = seen(viewpoint);
      const Eigen::Vector2f moved = sight.project(middle + way(on_field)) - sight.project(middle),
                            wanted = way(key).head<2>();
      EXPECT_GT(moved.normalized().dot(wanted.normalized()), 0.9f)
          << static_cast<int>(viewpoint) << ' ' << game::key_name(key);
    }
}

TEST(Pictures, AreAPureFunctionOfTheSight) {
  const MatchSight sight = bat_and_puck();
  const Picture a = picture_of(sight, {}, {}, wide), b = picture_of(sight, {}, {}, wide);
  ASSERT_EQ(a.pieces.size(), 2u);
  EXPECT_EQ(a.camera, b.camera);
  EXPECT_FLOAT_EQ(a.pieces[0].half_y, 0.1f);
  EXPECT_EQ(a.pieces[0].shape, Piece::Shape::bat);
  EXPECT_EQ(a.pieces[1].shape, Piece::Shape::puck);
}

TEST(Pictures, ShowFiguresOfAnOwnBatOnlyToWhoHasOne) {
  MatchSight sight = bat_and_puck();
  sight.link = LinkFigures{.ping_ms = 10.0};
  const auto has = [&](const char* words) {
    const Picture picture = picture_of(sight, {}, {.shows_link = true}, wide);
    return std::ranges::any_of(picture.texts, [&](const Text& text) {
      return text.words.find(words) != std::string::npos;
    });
  };
  EXPECT_TRUE(has("ping 10 ms"));
  EXPECT_FALSE(has("corrections")) << "who watches has no bat";
  sight.own_team = game::Team::left;
  EXPECT_TRUE(has("corrections"));
}

TEST(Pictures, TurnTheScoreWithTheEndItIsReadFrom) {
  MatchSight sight = bat_and_puck();
  sight.score = {3, 1};
  const Scoreboard left = picture_of(sight, {}, {.viewpoint = Viewpoint::left_end}, wide).board,
                   right = picture_of(sight, {}, {.viewpoint = Viewpoint::right_end}, wide).board;
  EXPECT_EQ(left.first, 3u);
  EXPECT_EQ(right.first, 1u);
  EXPECT_TRUE(left.is_left_first);
  EXPECT_FALSE(right.is_left_first);
}

TEST(Pictures, GlowAtTheEndWhereTheGoalFellAndFade) {
  MatchSight sight = bat_and_puck();
  sight.scorer = game::Team::left;
  const Picture fresh = picture_of(sight, {}, {}, wide);
  EXPECT_FLOAT_EQ(fresh.right_glow, 1.0f);
  EXPECT_FLOAT_EQ(fresh.left_glow, 0.0f);
  sight.since_goal_s = 0.8;
  EXPECT_LT(picture_of(sight, {}, {}, wide).right_glow, 0.5f);
}

TEST(Pictures, SayInEveryPhaseWhatIsGoingOn) {
  MatchSight sight = bat_and_puck();
  const auto says = [&](const std::string& words) {
    const Picture picture = picture_of(sight, {}, {}, wide);
    return std::ranges::any_of(picture.texts, [&](const Text& text) {
      return text.words.find(words) != std::string::npos;
    });
  };
  sight.phase = Phase::countdown, sight.remaining_s = 1.4;
  EXPECT_TRUE(says("2"));
  sight.phase = Phase::paused;
  EXPECT_TRUE(says("PAUSED"));
  sight.phase = Phase::waiting;
  EXPECT_TRUE(says("WAITING"));
  sight.phase = Phase::away, sight.remaining_s = 12.4;
  EXPECT_TRUE(says("13 s to come back"));
  sight.phase = Phase::over, sight.winner = game::Team::right, sight.right_name = "Blue";
  EXPECT_TRUE(says("BLUE WINS"));
  sight.notice = "the host is gone";
  EXPECT_TRUE(says("the host is gone"));
}

}  // namespace
}  // namespace rink::view
