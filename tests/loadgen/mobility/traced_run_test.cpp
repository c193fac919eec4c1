// Filters compared over a mobility trace: decisions, figures, updates and bytes against brute force
// over the trace's own points.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "game/net/bots_trace.h"
#include "game/net/server_trace.h"
#include "tests/loadgen/mobility/traced_run.h"

namespace rink::loadgen {
namespace {

using testing::AllOf;
using testing::HasSubstr;

/// Ten thousand people between hot spots on 500 m by 500 m, in a file.
class TenThousandAgents : public TracedRunTest {
 protected:
  static constexpr double reach = 10.0, half = 0.25;

  TenThousandAgents() {
    write_scene("walk.csv", csv_of(drawn_));
    experiment_.schemes = {"region", "none"};
    experiment_.view_area = 4.0 * reach * reach;
    settings_.wants_truth = true;
    std::map<std::string, const Agent*> by_id;
    Vector2 low(1e9, 1e9);
    for (const Agent& agent : drawn_.agents) {
      by_id[agent.id] = &agent;
      for (const TracePoint& point : agent.points) low = low.cwiseMin(Vector2(point.x, point.y));
    }
    corner_ = low - Vector2(half, half);
    const PlayedScene scene = played(first_cell());
    for (const Agent& agent : scene.trace->agents) by_body_.push_back(&by_id.at(agent.id)->points);
  }

  Vector2 place(std::uint32_t body, double instant_s) const {
    return *interpolated(*by_body_[body], instant_s) - corner_;
  }
  std::vector<Vector2> places(double instant_s) const {
    std::vector<Vector2> result;
    for (std::uint32_t body = 0; body < by_body_.size(); ++body)
      result.push_back(place(body, instant_s));
    return result;
  }
  /// How far the box of an agent at `place` reaches into the square around `eye`; below 0 if it is
  /// outside.
  static double depth(const Vector2& eye, const Vector2& place) {
    return reach + half - (eye - place).cwiseAbs().maxCoeff();
  }

  MobilityTrace drawn_ = drawn_trace(
      {.name = "hotspots", .count = 10'000, .side = 500.0, .duration_s = 30.0, .seed = 11});
  std::vector<const std::vector<TracePoint>*> by_body_;
  Vector2 corner_{0.0, 0.0};
};

TEST_F(TenThousandAgents, EveryDecisionAndItsFiguresAreThoseOfBruteForce) {
  const Cell cell = first_cell();
  const RunRecord record = run(cell);
  EXPECT_EQ(record.entities, 10'000u);
  const game::ServerTrace server =
      game::read_server_trace(folder_ / (name_of(cell) + ".server.jsonl"));
  std::map<std::uint32_t, std::uint32_t> bodies;
  for (const auto& naming : server.objects) bodies[naming.object] = naming.body;
  ASSERT_EQ(bodies.size(), 10'000u);
  std::uint64_t chosen = 0, relevant = 0, both = 0;
  ASSERT_GE(server.decisions.size(), 100u);
  const double tick_s = 1.0 / cell.parameters.tick_rate_hz;
  for (const auto& decision : server.decisions) {
    const double now_s = tick_s * std::floor(decision.instant_s / tick_s + 1e-9);
    // The view was declared when the agent's place of the tick before had come.
    const Vector2 eye = place(decision.player, now_s - tick_s);
    const std::vector<Vector2> now = places(now_s), then = places(decision.instant_s);
    std::set<std::uint32_t> scope;
    for (const std::uint32_t object : server.scope_of(decision))
      if (const auto body = bodies.find(object); body != bodies.end()) scope.insert(body->second);
    for (std::uint32_t body = 0; body < now.size(); ++body) {
      const double inside = depth(eye, now[body]);
      const bool is_at_the_rim = std::abs(inside) < 1e-3;  // places travel in single precision
      ASSERT_TRUE(is_at_the_rim || scope.contains(body) == (inside > 0.0))
          << body << " at " << decision.instant_s << ", depth " << inside;
      if (body == decision.player) continue;
      const bool is_relevant = depth(then[decision.player], then[body]) >= 0.0;
      chosen += scope.contains(body), relevant += is_relevant;
      both += scope.contains(body) && is_relevant;
    }
  }
  EXPECT_GT(relevant, 1000u);
  EXPECT_DOUBLE_EQ(record.truth.filter_recall.value_or(0.0),
                   static_cast<double>(both) / static_cast<double>(relevant));
  EXPECT_DOUBLE_EQ(record.truth.filter_precision.value_or(0.0),
                   static_cast<double>(both) / static_cast<double>(chosen));
}

/// A message per update that reaches a client: of every agent each tick without a filter, else of
/// those in its scope.
TEST_F(TenThousandAgents, AsManyUpdatesAreSentAsBruteForceCounts) {
  Cell cell = first_cell();
  cell.scheme = "none";
  const RunRecord none = run(cell);
  const auto ticks = static_cast<std::uint64_t>(20);
  ASSERT_EQ(none.ticks, ticks);
  const auto messages = [](const RunRecord& record) {
    return record.messages_per_s.value_or(0.0) * record.measured_s.value_or(0.0);
  };
  EXPECT_NEAR(messages(none), 8.0 * 10'000 * static_cast<double>(ticks), 1e-3);
  cell.scheme = "region";
  const RunRecord region = run(cell);
  EXPECT_EQ(none.state_hash, region.state_hash) << "filters never change the trace";
  const double tick_s = 1.0 / cell.parameters.tick_rate_hz;
  std::uint64_t least = 0, most = 0;
  for (std::uint64_t tick = 0; tick < ticks; ++tick) {
    const double now_s = experiment_.warm_up_s + static_cast<double>(tick) * tick_s;
    const std::vector<Vector2> now = places(now_s), before = places(now_s - tick_s);
    for (std::uint32_t client = 0; client < 8; ++client)
      for (const Vector2& there : now) {
        const double inside = depth(before[client], there);
        least += inside > 1e-3 ? 1u : 0u;
        most += inside > -1e-3 ? 1u : 0u;
      }
  }
  EXPECT_GE(messages(region), static_cast<double>(least) - 0.5);
  EXPECT_LE(messages(region), static_cast<double>(most) + 0.5);
  // An update is a place in single precision and a byte or two that say whose.
  const auto bytes_each = [&](const RunRecord& record) {
    return 8.0 * record.down_bytes_per_client_per_s.value_or(0.0) *
           record.measured_s.value_or(0.0) / messages(record);
  };
  EXPECT_NEAR(bytes_each(none), 9.0, 0.01);
  EXPECT_GT(bytes_each(region), 9.0);
  EXPECT_LT(bytes_each(region), 10.0);
}

/// Of cars: who is away is in nobody's scope, under any scheme, and comes back.
class ComingAndGoing : public TracedRunTest {
 protected:
  ComingAndGoing() {
    std::string text = "<fcd-export>\n";
    for (int t = 0; t <= 10; ++t) {
      text += "<timestep time=\"" + std::to_string(t) + "\">";
      const auto car = [&text](const char* id, double x) {
        text += "<vehicle id=\"" + std::string(id) + "\" x=\"" + std::to_string(x) + "\" y=\"0\"/>";
      };
      if (t >= 5) car("late", 3.0);
      car("stays", t);
      if ((t >= 2 && t <= 4) || (t >= 6 && t <= 8)) car("returns", t + 1.0);
      text += "</timestep>\n";
    }
    write_scene("walk.xml", text + "</fcd-export>\n");
    experiment_.clients = {1};
    experiment_.warm_up_s = 0.5;
    experiment_.duration_s = 9.0;
    experiment_.schemes = {"none", "region", "aura or always"};
    settings_.wants_truth = true;
  }
};

TEST_F(ComingAndGoing, WhoIsAwayIsInNobodysScope) {
  for (const Cell& cell : cells_of(experiment_)) {
    SCOPED_TRACE(cell.scheme);
    const RunRecord record = run(cell);
    EXPECT_EQ(record.truth.error, "");
    const PlayedScene scene = played(cell);
    ASSERT_EQ(scene.trace->agents[0].id, "stays") << "who is there from the beginning comes first";
    EXPECT_EQ(scene.staying_until(10.0), 1u);
    const auto bots = game::read_bots_trace(folder_ / (name_of(cell) + ".bots.jsonl"));
    const auto server = game::read_server_trace(folder_ / (name_of(cell) + ".server.jsonl"));
    std::map<std::uint32_t, std::string> ids;
    for (const auto& naming : server.objects)
      ids[naming.object] = scene.trace->agents[naming.body].id;
    ASSERT_EQ(bots.bots.size(), 1u);
    std::map<std::string, std::vector<double>> changes;
    for (const auto& change : bots.bots[0].changes)
      if (change.instant_s > 0.0) {
        std::vector<double>& list = changes[ids.at(change.object)];
        EXPECT_EQ(change.is_in, list.size() % 2 == 0);
        list.push_back(change.instant_s);
      }
    constexpr double tick_s = 0.05;
    const auto expect = [&](const char* id, const std::vector<double>& instants) {
      ASSERT_EQ(changes[id].size(), instants.size()) << id;
      for (std::size_t k = 0; k < instants.size(); ++k)
        EXPECT_NEAR(changes[id][k], instants[k], tick_s + 1e-9) << id;
    };
    EXPECT_EQ(record.truth.filter_recall, 1.0) << "within 10 m all are relevant, if they are there";
    if (cell.scheme == "none") {
      EXPECT_TRUE(changes.empty()) << "without places, who is away is silent, but in scope";
      continue;
    }
    expect("returns", {2.0, 4.0, 6.0, 8.0});
    EXPECT_EQ(changes["late"].size(), 1u);
  }
}

TEST_F(ComingAndGoing, ThoseWhoComeLaterAreNoClients) {
  experiment_.clients = {2};
  EXPECT_THAT(refusal(), AllOf(HasSubstr("clients = 2"), HasSubstr("of its 3 agents 1 are there")));
}

/// What an experiment may not ask of a trace is refused before anything runs.
class RefusedTrace : public TracedRunTest {
 protected:
  RefusedTrace() { write_scene("walk.csv", "id,t,x,y\na,0,0,0\na,5,9,9\nb,0,0,0\nb,5,9,9\n"); }
};

TEST_F(RefusedTrace, BeforeAnythingRuns) {
  experiment_.clients = {2};
  ASSERT_EQ(refusal(), "no complaint");
  const auto refused = [this](const auto& change) {
    const Experiment before = experiment_;
    change(experiment_);
    const std::string words = refusal();
    experiment_ = before;
    EXPECT_THAT(words, HasSubstr("walk.toml is a trace"));
    return words;
  };
  EXPECT_THAT(refused([](Experiment& e) { e.duration_s = 4.8; }),
              AllOf(HasSubstr("goes on for 5 s"), HasSubstr("not 5.05")));
  EXPECT_THAT(refused([](Experiment& e) {
                e.clients = {1, 3};
              }),
              HasSubstr("clients = 3, but of its 2 agents 2 are there"));
  EXPECT_THAT(refused([](Experiment& e) { e.transport = TransportKind::tcp; }),
              HasSubstr("expected transport = \"virtual\", not tcp"));
  EXPECT_THAT(refused([](Experiment& e) {
                e.modes = {"client-server", peer_mode};
              }),
              HasSubstr("expected modes = \"client-server\""));
  EXPECT_THAT(refused([](Experiment& e) { e.policies = {"exact"}; }),
              HasSubstr("a policy other than exact"));
  EXPECT_THAT(refused([](Experiment& e) { e.keys = KeySource::live; }),
              HasSubstr("neither players nor keys"));
  EXPECT_THAT(refused([](Experiment& e) { e.start_s = 1.0; }), HasSubstr("from_s"));
  EXPECT_THAT(refused([](Experiment& e) { e.relevance = Relevance::contact; }),
              HasSubstr("another relevance than contact"));
  EXPECT_THAT(refused([](Experiment& e) { e.population = Population::per_client; }),
              HasSubstr("expected population = \"fixed\""));
  EXPECT_THAT(refused([](Experiment& e) { e.bats = {1}; }), HasSubstr("bats = 0"));
  EXPECT_THAT(refused([](Experiment& e) { e.pucks = {1}; }), HasSubstr("pucks = 0"));
}

TEST_F(RefusedTrace, OfAModelGoesByTheNumbersOfEachGame) {
  write("walk.toml",
        "[[population]]\nkind = \"trace\"\nmodel = \"hotspots\"\ncount = 10\nside = 1e6\n");
  experiment_.population = Population::per_client;
  experiment_.clients = {100};
  experiment_.duration_s = 2.0;
  EXPECT_THAT(refusal(), HasSubstr("a side of 31622"));
  experiment_.clients = {4, 10};
  EXPECT_EQ(refusal(), "no complaint");
  experiment_.population = Population::fixed;
  experiment_.clients = {4};
  experiment_.bats = {300'000};
  EXPECT_THAT(refusal(), HasSubstr("300000 agents: allowed are 250000"));
}

TEST_F(RefusedTrace, OfAModelWithMorePointsThanATraceMayHave) {
  TraceModel model{.name = "hotspots", .count = 10, .side = 1.0, .duration_s = 1e4};
  model.points_max = 100;
  EXPECT_THROW(drawn_trace(model), game::SceneError);
}

TEST_F(RefusedTrace, FaultyScenesNameFileLineAndKey) {
  const auto refusal_of_scene = [this](const std::string& text) {
    write("walk.toml", text);
    return refusal();
  };
  const std::string begin = "[[population]]\nkind = \"trace\"\n", file = "file = \"walk.csv\"\n";
  EXPECT_THAT(refusal_of_scene(begin), HasSubstr("expected either file or model"));
  EXPECT_THAT(refusal_of_scene(begin + file + "model = \"hotspots\"\n"),
              HasSubstr("expected either file or model"));
  EXPECT_THAT(refusal_of_scene(begin + "file = \"walk.dat\"\n"),
              HasSubstr("expected the key format, one of csv, fcd, ns-2, bonnmotion"));
  EXPECT_THAT(refusal_of_scene(begin + file + "format = \"gpx\"\n"), HasSubstr("walk.toml:4"));
  EXPECT_THAT(refusal_of_scene(begin + "file = \"none.csv\"\n"),
              HasSubstr("none.csv: cannot be read"));
  EXPECT_THAT(refusal_of_scene(begin + file + "format = \"fcd\"\ngap_s = 3\n"),
              HasSubstr("no gap_s but in CSV"));
  EXPECT_THAT(refusal_of_scene(begin + file + "from_s = 5\n"),
              HasSubstr("expected an instant from 0 to less than 5 s"));
  EXPECT_THAT(refusal_of_scene(begin + file + "count = 5\n"), HasSubstr("walk.toml:4"));
  EXPECT_THAT(refusal_of_scene(begin + "model = \"crowd\"\n"),
              HasSubstr("one of commuters, flash-crowd, hotspots"));
  EXPECT_THAT(refusal_of_scene(begin + file + begin + file), HasSubstr("the only population"));
  EXPECT_THAT(refusal_of_scene("[drag]\nbats = 1\n" + begin + file), HasSubstr("drag"));
  EXPECT_THAT(refusal_of_scene("[field]\nlength = 9\nwidth = 8\n" + begin + file),
              HasSubstr("walk.csv:3: agent a: y = 9: expected a place on the field"));
}

TEST_F(TracedRunTest, AModelHeedsSeedsAndNumbersAsACrowdDoes) {
  write("walk.toml",
        "[[population]]\nkind = \"trace\"\nmodel = \"hotspots\"\ncount = 100\nside = 40\n");
  Cell cell = first_cell();
  const PlayedScene whole = played(cell);
  EXPECT_EQ(whole.trace->agents.size(), 100u);
  cell.bats = 25;
  EXPECT_EQ(played(cell).trace->agents.size(), 25u);
  EXPECT_EQ(played(cell).scene.world.field.length, whole.scene.world.field.length);
  experiment_.population = Population::per_client;
  cell.bats = 0, cell.clients = 25;
  EXPECT_EQ(played(cell).trace->agents.size(), 25u);
  EXPECT_NEAR(played(cell).scene.world.field.length, 0.5 * 40.0 + 0.5, 1e-9) << "the same density";
  const Vector2 before = played(cell).scene.bodies.bats[0].body.position;
  cell.seed = 4;
  EXPECT_NE(played(cell).scene.bodies.bats[0].body.position, before);
}

TEST_F(TracedRunTest, RunsBeginWhereTheSceneSays) {
  const std::string walk = "id,t,x,y\na,100,10,20\na,110,30,20\nb,100,0,0\nb,110,0,50\n";
  write_scene("walk.csv", walk, "from_s = 105\n");
  const PlayedScene scene = played(first_cell());
  EXPECT_EQ(scene.trace->begin_s, -5.0);
  EXPECT_EQ(scene.trace->end_s, 5.0);
  ASSERT_EQ(scene.scene.bodies.bats.size(), 2u);
  EXPECT_EQ(scene.scene.bodies.bats[0].body.position, Vector2(20.25, 20.25));
  EXPECT_EQ(scene.scene.bodies.bats[0].body.velocity, Vector2(2.0, 0.0));
  EXPECT_EQ(scene.scene.world.field.width, 50.5);
  experiment_.clients = {2};
  experiment_.view_area = 2500.0;
  experiment_.schemes = {"region"};
  experiment_.policies = {"periodic", "snapshot", "dead-reckoning", "dead-reckoning-drag",
                          "on-event"};
  settings_.wants_truth = true;
  std::set<std::string> hashes;
  for (const Cell& cell : cells_of(experiment_)) {
    const RunRecord record = run(cell);
    EXPECT_EQ(record.truth.error, "") << cell.policy;
    EXPECT_LT(record.truth.displayed_error_mm.rms.value_or(1e9), 20.0)
        << cell.policy << ": straight ways are extrapolated well";
    hashes.insert(record.state_hash);
  }
  EXPECT_EQ(hashes.size(), 1u) << "policies never change the trace";
}

}  // namespace
}  // namespace rink::loadgen
