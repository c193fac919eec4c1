// What players among peers are told, counted anew by brute force from the states of one engine: as
// much as a server with the same filter would tell, whoever comes, leaves and dies.
#include "tests/peer_command/interest_play.h"

namespace rink::game {
namespace {

class InterestRecount : public testing::Test {
 protected:
  InterestRecount() : folder_("interest") {
    scene_file_ = (folder_ / "small.toml").string();
    std::ofstream(scene_file_) << small_scene;
  }

  /// Everybody saw all that it was to see, and nothing else, and the game is that of one engine.
  static void expect_right(InterestPlay& play, const im::Relevant& relevant,
                           const im::Relevant& stays, const std::string& what) {
    play.find_truth();
    for (const std::string& problem : play.errors) ADD_FAILURE() << what << ": " << problem;
    ASSERT_FALSE(play.hashes.empty()) << what;
    for (const std::uint64_t hash : play.hashes) EXPECT_EQ(hash, play.truth) << what;
    EXPECT_GT(play.key_count(), 0u);
    const InterestPlay::Recount all = play.recount(relevant, stays);
    EXPECT_GT(all.sights, 100u) << what;
    EXPECT_GT(all.far, all.sights) << what << ": hardly anything was told";
    EXPECT_EQ(all.missing, 0u) << what << ", of " << all.seen << " seen; " << all.wrong;
    EXPECT_EQ(all.extra, 0u) << what << ", of " << all.seen << " seen; " << all.wrong;
  }

  test::TemporaryFolder folder_;
  std::string scene_file_;
};

const im::Relevant everything = [](const im::Observer&, const im::Body&) { return true; };

im::Relevant cells_of(double size) {
  return [settings = im::FilterSettings{.world = {0.0, 0.0, 5.0, 3.0}, .cell_size = size}](
             const im::Observer& view, const im::Body& body) {
    return im::grid_touches(settings, view, body);
  };
}

TEST_F(InterestRecount, FindsNothingMissingWhileOthersComeLeaveAndDie) {
  const std::vector<std::pair<InterestTerms, im::Relevant>> cases{
      {{.scheme = "none"}, everything},
      {{.scheme = "region"},
       [](const im::Observer& view, const im::Body& body) {
         return im::overlap_closed(view, body);
       }},
      {{.scheme = "aura"},
       [](const im::Observer& view, const im::Body& body) { return im::disc_touches(view, body); }},
      {{.scheme = "grid", .cell_size = 0.5}, cells_of(0.5)}};
  for (const auto& [interest, relevant] : cases) {
    InterestPlay play(scene_file_, 2, 320, interest);
    play.comings = {20, 70, 150};
    play.leavings = {{1, 130}};
    play.deaths = {{2, 220}};
    play.run();
    EXPECT_EQ(play.came.size(), 3u) << interest.scheme;
    expect_right(play, relevant, relevant, interest.scheme);
  }
}

im::Relevant within(double margin) {
  return [margin](const im::Observer& view, const im::Body& body) {
    return im::overlap_closed(
        {view.low_x - margin, view.low_y - margin, view.high_x + margin, view.high_y + margin},
        body);
  };
}

TEST_F(InterestRecount, FindsWhatASchemeSeesBeyondTheViewInZonesBeyondTheView) {
  struct Case {
    std::string scheme;
    im::Relevant relevant, stays;
  };
  const im::FilterSettings coarse{.world = {0.0, 0.0, 5.0, 3.0}, .cell_size = 1.5};
  const auto same = [](const std::string& scheme, const im::Relevant& relevant) {
    return Case{scheme, relevant, relevant};
  };
  const auto with = [&](bool (*rule)(const im::FilterSettings&, const im::Region&,
                                     const im::Region&)) {
    return [=](const im::Observer& view, const im::Body& body) { return rule(coarse, view, body); };
  };
  const im::Relevant cells = cells_of(1.5);
  // Of hysteresis only that nobody stays beyond its margin, and who is within the view is seen,
  // follows from states alone.
  const std::vector<Case> cases{
      same("strips(cell_size=1.5)", with(im::strip_touches)),
      same("hex(cell_size=1.5)", with(im::hexagon_touches)),
      same("hierarchical(cell_size=1.5)", with(im::level_touches)),
      same("aura or grid(cell_size=1.5)",
           [cells](const im::Observer& view, const im::Body& body) {
             return im::disc_touches(view, body) || cells(view, body);
           }),
      {"region with hysteresis(margin=0.6)", within(0.0), within(0.6)},
      same("region or always", [](const im::Observer& view, const im::Body& body) {
        return im::overlap_closed(view, body) || body.role.is_always_relevant;
      })};
  for (const Case& one : cases) {
    RelevantKinds pucks;
    pucks.add(physics::BodyKind::puck);
    InterestPlay play(scene_file_, 4, 120, {.scheme = one.scheme, .always = pucks.bits()});
    play.run();
    expect_right(play, one.relevant, one.stays, one.scheme);
  }
}

TEST_F(InterestRecount, LeavesGoalsAsTheyAreWhoeverComes) {
  std::string text = small_scene;
  text.replace(text.find("width = 3.0"), 11, "width = 3.0\ngoal_width = 1.5");
  text += "[match]\nface_off_delay = 0.137\n";
  std::ofstream(scene_file_) << text;
  InterestPlay play(scene_file_, 2, 250, {.scheme = "region"});
  play.comings = {20, 40, 60, 80, 100};
  play.leavings = {{1, 150}};
  play.run();
  play.find_truth();
  for (const std::string& problem : play.errors) ADD_FAILURE() << problem;
  EXPECT_EQ(play.came.size(), 5u);
  EXPECT_EQ(play.hashes.size(), 6u);
  EXPECT_GT(play.goals, 5u);
  for (const std::uint64_t hash : play.hashes) EXPECT_EQ(hash, play.truth);
}

TEST(ReachOfASchemeByTrial, IsNeverLessThanWhatIsLetInAndLittleMore) {
  const im::FilterSettings settings{.world = {0.0, 0.0, 20.0, 10.0}, .cell_size = 0.5};
  const double extent = 0.1, never = std::numeric_limits<double>::infinity();
  const auto expect_reach = [&](const std::string& scheme, double x, double y) {
    const SchemeReach reach = reach_of(scheme, settings, extent);
    const auto is_right = [&](double found, double truth) {
      return truth == never ? found == never : found >= truth && found <= 2.5 * truth + extent;
    };
    EXPECT_TRUE(is_right(reach.x, x) && is_right(reach.y, y))
        << scheme << ": " << reach.x << ", " << reach.y;
  };
  expect_reach("region", extent, extent);
  expect_reach("region and aura", extent, extent);
  for (const char* const within : {"region with psense(vision=0.5)", "region with von(area=0.5)",
                                   "nimbus", "nimbus(radius=1)"})
    expect_reach(within, extent, extent);
  for (const double size : {0.3, 0.5, 1.1, 2.0, 3.7}) {
    const std::string cells = "(cell_size=" + std::to_string(size) + ")";
    expect_reach("region or grid" + cells, size, size);
    expect_reach("hierarchical" + cells, size, size);
    expect_reach("hex" + cells, size, size * 2.0 / std::sqrt(3.0));
    expect_reach("strips" + cells, size, never);
    expect_reach("strips" + cells + " and aura", extent, extent);
    expect_reach("aura with hysteresis(margin=" + std::to_string(size) + ")", size + extent,
                 size + extent);
    expect_reach("grid" + cells + " with psense(vision=0.5)", size, size);
  }
  for (const char* const scheme :
       {"none", "not region", "aura or always", "region or team", "owner",
        "region with dwell(matches=5)", "none with psense", "none with von"})
    expect_reach(scheme, never, never);
}

}  // namespace
}  // namespace rink::game
