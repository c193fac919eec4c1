// The choice among engines, and that the interface adds nothing to the exact one.
#include "game/physics/simulator_choice.h"

#include <gmock/gmock.h>

#include <limits>
#include <utility>
#include <vector>

#include "tests/physics/scenes.h"

namespace rink::physics {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

TEST(SimulatorChoices, AreRefusedByNameWithWhatIsAllowed) {
  EXPECT_THAT(objection({.engine = "box"}).value(), AllOf(HasSubstr("box"), HasSubstr("exact")));
  EXPECT_THAT(objection({.integrator = "rk5"}).value(),
              AllOf(HasSubstr("rk5"), HasSubstr("euler, semi_implicit, verlet, rk4")));
  for (const double dt : {0.0, -1.0, std::numeric_limits<double>::infinity(),
                          std::numeric_limits<double>::quiet_NaN()})
    EXPECT_THAT(objection({.dt = dt}).value(), HasSubstr("above 0 s"));
  EXPECT_FALSE(objection({}));
}

TEST(ExactSimulators, DoWhatTheirWorldDoes) {
  const WorldSpec spec = test::rink_of(2.0, 1.0, 0.9);
  World world(spec);
  const auto simulator = make_simulator(spec);
  for (const PuckSpec& puck : {PuckSpec{.position = {0.5, 0.5}, .velocity = {1.0, 0.25}},
                               PuckSpec{.position = {1.5, 0.55}, .velocity = {-2.0, 0.125}}}) {
    world.add(puck);
    simulator->add(puck);
  }
  const BatSpec bat{.position = {1.0, 0.2}};
  world.set_thrust(world.add(bat), {3.0, 4.0});
  simulator->set_thrust(simulator->add(bat), {3.0, 4.0});
  EXPECT_FALSE(world.advance(5.0));
  EXPECT_FALSE(simulator->advance(5.0));
  EXPECT_GT(world.counters().impacts(), 10u);
  EXPECT_EQ(simulator->hash(), world.hash());
  EXPECT_EQ(simulator->position({0}), world.position({0}));
  EXPECT_EQ(escape_count(*simulator), 0u);
}

/// An engine that has lost its pucks, at these places.
class Lost final : public Simulator {
 public:
  explicit Lost(std::vector<Vector2> places) : places_(std::move(places)) {}
  BodyId add(const PuckSpec&) override { return {}; }
  BodyId add(const BatSpec&) override { return {}; }
  BodyId add(const PostSpec&) override { return {}; }
  void remove(BodyId) override {}
  void set_thrust(BodyId, const Vector2&) override {}
  void place(BodyId, const Vector2&, const Vector2&) override {}
  std::optional<Goal> advance(double) override { return std::nullopt; }
  void record_events(bool) override {}
  std::span<const Event> events() const override { return {}; }
  void forget_events() override {}
  const WorldSpec& spec() const override { return spec_; }
  double now() const override { return 0.0; }
  std::uint32_t body_count() const override { return static_cast<std::uint32_t>(places_.size()); }
  BodyKind kind(BodyId) const override { return BodyKind::puck; }
  double radius(BodyId) const override { return 0.1; }
  Vector2 half_extent(BodyId) const override { return {0.1, 0.1}; }
  double mass(BodyId) const override { return 1.0; }
  bool is_in_play(BodyId body) const override { return body.index != out_of_play; }
  Vector2 position(BodyId body) const override { return places_[body.index]; }
  Vector2 velocity(BodyId) const override { return {0.0, 0.0}; }
  bool is_free(const Vector2&, double) const override { return true; }
  bool is_free(const Vector2&, const Vector2&) const override { return true; }
  const Counters& counters() const override { return counters_; }
  double kinetic_energy() const override { return 0.0; }
  Vector2 momentum() const override { return {0.0, 0.0}; }
  double max_overlap() const override { return 0.0; }
  std::uint64_t hash() const override { return 0; }

  std::uint32_t out_of_play = 1000;

 private:
  std::vector<Vector2> places_;
  Counters counters_;
  WorldSpec spec_ = test::rink_of(4.0, 1.0);
};

TEST(Escaped, AreBodiesInPlayBeyondAnyOfTheFourWallsOrNowhere) {
  const double beyond = 1e-9, nan = std::numeric_limits<double>::quiet_NaN();
  for (const Vector2& inside : {Vector2(0.0, 0.0), Vector2(4.0, 1.0), Vector2(2.0, 0.5)})
    EXPECT_EQ(escape_count(Lost({inside})), 0u) << inside.transpose();
  const std::vector<Vector2> outside{{-beyond, 0.5},      {4.0 + beyond, 0.5}, {2.0, -beyond},
                                     {2.0, 1.0 + beyond}, {nan, 0.5},          {2.0, nan}};
  for (const Vector2& place : outside)
    EXPECT_EQ(escape_count(Lost({place})), 1u) << place.transpose();
  Lost all(outside);
  all.out_of_play = 3;
  EXPECT_EQ(escape_count(all), 5u);
}

}  // namespace
}  // namespace rink::physics
