// Mobility traces of every format: what they say, and what is refused with file and line.
#include "loadgen/mobility/trace_formats.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "tests/loadgen/mobility/agent_places.h"
#include "tests/places.h"
#include "tests/words.h"

namespace rink::loadgen {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

std::string walk(const std::string& ending) {
  return test::source_folder() + "/tests/loadgen/mobility/walks/walk" + ending;
}

std::string refusal_of(const std::string& text, const std::string& format,
                       const TraceRules& rules = {}) {
  try {
    parse_trace(text, "walk", format, rules);
  } catch (const game::SceneError& error) {
    return error.what();
  }
  return "no complaint";
}

TEST(TraceFormats, OneWalkIsTheSameInEveryFormat) {
  for (const std::string ending : {".csv", ".movements", ".ns_movements", ".xml"}) {
    SCOPED_TRACE(ending);
    const auto format = trace_format_of(walk(ending));
    ASSERT_TRUE(format);
    const MobilityTrace trace = read_trace(walk(ending), *format);
    ASSERT_EQ(trace.agents.size(), 2u);
    EXPECT_EQ(trace.begin_s, 0.0);
    EXPECT_EQ(trace.end_s, 20.0);
    EXPECT_EQ(trace.high, Vector2(100.0, 50.0));
    for (double t = 0.0; t <= 20.0; t += 0.625) {
      const double gone = 5.0 * std::min(t, 10.0), later = 5.0 * std::clamp(t - 5.0, 0.0, 10.0);
      EXPECT_LT((place_at(trace.agents[0], t) - Vector2(0.6 * gone, 0.8 * gone)).norm(), 1e-12);
      EXPECT_LT((place_at(trace.agents[1], t) - Vector2(100.0, later)).norm(), 1e-12);
    }
    EXPECT_EQ(there_until(trace.agents[0], 3.0), 20.0);
    EXPECT_FALSE(leg_at(trace.agents[0], 20.1).is_there) << "nothing is said beyond the end";
  }
}

TEST(TraceFormats, ANodeThatIsSentElsewhereOnItsWayTurnsWhereItIs) {
  const MobilityTrace trace = parse_trace(
      "$node_(3) set X_ 0\n$node_(3) set Y_ 10\n"
      "$ns_ at 1 \"$node_(3) setdest 100 10 10\"\n"
      "$ns_ at 4 \"$node_(3) setdest 30 110 10\"\n"
      "$ns_ at 8 \"$node_(3) setdest 0 0 0\"\n"
      "$ns_ at 9 \"$node_(3) setdest 30 60 10\"\n",
      "walk", "ns-2");
  ASSERT_EQ(trace.agents.size(), 1u);
  EXPECT_THAT(trace.agents[0].points,
              ElementsAre(TracePoint{0, 0, 10}, TracePoint{1, 0, 10}, TracePoint{4, 30, 10},
                          TracePoint{8, 30, 50}, TracePoint{9, 30, 50}, TracePoint{10, 30, 60}));
}

TEST(TraceFormats, WhoIsMissingFromATimestepHasLeftAndMayComeBackElsewhere) {
  const std::string car = "<vehicle id='a' x='";
  const MobilityTrace trace = parse_trace("<fcd-export><timestep time='0'>" + car +
                                              "0' y='0'/></timestep>"
                                              "<timestep time='1'>" +
                                              car +
                                              "10' y='0'/></timestep><timestep time='2'/>"
                                              "<timestep time='3'>" +
                                              car +
                                              "5000' y='7'/><person id='a' x='1' y='1'/>"
                                              "</timestep><timestep time='4'>" +
                                              car + "5001' y='7'/></timestep></fcd-export>",
                                          "cars", "fcd");
  ASSERT_EQ(trace.agents.size(), 2u) << "a vehicle and a person of one name are two";
  const Agent& car_a = trace.agents[0];
  EXPECT_EQ(place_at(car_a, 0.5), Vector2(5.0, 0.0));
  EXPECT_TRUE(leg_at(car_a, 1.0).is_there) << "its last point is part of its stay";
  EXPECT_FALSE(leg_at(car_a, std::nextafter(1.0, 2.0)).is_there);
  EXPECT_FALSE(leg_at(car_a, 2.5).is_there);
  EXPECT_EQ(leg_at(car_a, 2.5).until_s, 3.0);
  EXPECT_EQ(place_at(car_a, 3.5), Vector2(5000.5, 7.0)) << "5 km in 2 s are no way but an absence";
  EXPECT_EQ(there_until(car_a, 0.0), 1.0);
  EXPECT_EQ(there_until(car_a, 3.0), 4.0);
  EXPECT_EQ(there_until(car_a, 2.0), -INFINITY);
  EXPECT_FALSE(leg_at(trace.agents[1], 0.0).is_there);
  EXPECT_TRUE(leg_at(trace.agents[1], 3.0).is_there) << "one point is a stay of an instant";
}

TEST(TraceFormats, AGapIsAWayUnlessARuleSaysThatItIsAnAbsence) {
  const std::string text = "t,y,id,x,extra\r\n0,1,a,2,-\r\n30,4,a,2,-\r\n31,5,a,2,-\r\n";
  EXPECT_EQ(place_at(parse_trace(text, "walk", "csv").agents[0], 10.0), Vector2(2.0, 2.0));
  const Agent gone = parse_trace(text, "walk", "csv", {.gap_s = 29.0}).agents[0];
  EXPECT_FALSE(leg_at(gone, 10.0).is_there);
  EXPECT_EQ(place_at(gone, 30.5), Vector2(2.0, 4.5));
  EXPECT_TRUE(leg_at(parse_trace(text, "walk", "csv", {.gap_s = 30.0}).agents[0], 10.0).is_there);
}

TEST(TraceFormats, PointsInAnyOrderOfAgentsAndARepeatedPointAreTheSameTrace) {
  const MobilityTrace trace =
      parse_trace("id,t,x,y\nb,5,1,1\na,0,0,0\nb,5,1,1\nb,6,2,1\na,4,4,0\n", "walk", "csv");
  ASSERT_EQ(trace.agents.size(), 2u);
  EXPECT_EQ(trace.agents[0].id, "b");
  EXPECT_THAT(trace.agents[0].points, ElementsAre(TracePoint{5, 1, 1}, TracePoint{6, 2, 1}));
}

struct TraceFault {
  const char *what, *format, *text;
  std::vector<const char*> words;
};

class FaultyTrace : public testing::TestWithParam<TraceFault> {};

TEST_P(FaultyTrace, IsRefusedWithItsLineAndWhatIsAllowed) {
  const std::string refusal = refusal_of(GetParam().text, GetParam().format);
  for (const char* word : GetParam().words) EXPECT_THAT(refusal, HasSubstr(word));
}

const std::vector<TraceFault> trace_faults{
    {"csv nothing", "csv", "", {"walk:0: expected a heading", "id,t,x,y"}},
    {"csv no heading", "csv", "1,0,3,4\n", {"walk:1: expected a heading"}},
    {"csv two x", "csv", "id,t,x,x,y\n", {"walk:1: expected a heading"}},
    {"csv no agents", "csv", "id,t,x,y\n", {"walk: no agents"}},
    {"csv too few", "csv", "id,t,x,y\na,0,1\n", {"walk:2: 3 values: expected 4"}},
    {"csv word", "csv", "id,t,x,y\na,0,one,2\n", {"walk:2: x = 'one': expected a number"}},
    {"csv half a number", "csv", "id,t,x,y\na,0,1,2m\n", {"walk:2: y = '2m'"}},
    {"csv nan", "csv", "id,t,x,y\na,0,1,2\na,1,nan,2\n", {"walk:3: agent a: x = nan: expected"}},
    {"csv infinite time", "csv", "id,t,x,y\na,inf,1,2\n", {"walk:2: agent a: t = inf"}},
    {"csv unordered",
     "csv",
     "id,t,x,y\na,5,0,0\n\na,3,0,0\n",
     {"walk:4: agent a: t = 3 after t = 5 in line 2: expected times of an agent that rise"}},
    {"csv two places at once", "csv", "id,t,x,y\na,5,0,0\na,5,1,0\n", {"walk:3: agent a: t = 5"}},
    {"csv jump",
     "csv",
     "id,t,x,y\na,0,0,0\na,1,2000,0\n",
     {"walk:3: agent a comes at 2000 m/s", "allowed is 1000 m/s", "gap_s"}},
    {"csv far apart",
     "csv",
     "id,t,x,y\na,0,0,0\nb,0,2e6,0\n",
     {"walk:3: agent b is at (2e+06, 0)", "a square of 1e+06 m"}},
    {"csv no id", "csv", "id,t,x,y\n,0,0,0\n", {"walk:2: an agent without an id"}},
    {"bonnmotion two numbers",
     "bonnmotion",
     "0 1 2\n0 1\n",
     {"walk:2: node 1 has 2 numbers: expected waypoints"}},
    {"bonnmotion empty node", "bonnmotion", "0 1 2\n\n0 1 2\n", {"walk:2: node 1 has 0 numbers"}},
    {"bonnmotion word", "bonnmotion", "0 1 2 3 x 5\n", {"walk:1: 'x', the number 5 of the line"}},
    {"bonnmotion unordered", "bonnmotion", "0 1 2 5 1 2 4 1 2\n", {"walk:1: agent 0: t = 4 after"}},
    {"bonnmotion 3D", "bonnmotion", "0 1 2 0 5 1 2 0 6 1 2 0\n", {"walk:1: agent 0: t = 0"}},
    {"ns-2 unknown line", "ns-2", "set opt(x) 5\n", {"walk:1: no line of setdest: expected"}},
    {"ns-2 no place", "ns-2", "$node_(0) set X_ 5\n", {"walk:1: node 0 has no Y_"}},
    {"ns-2 place twice",
     "ns-2",
     "$node_(0) set X_ 5\n$node_(0) set X_ 6\n",
     {"walk:2: $node_(0) has a X_ already"}},
    {"ns-2 nan", "ns-2", "$node_(0) set X_ nan\n", {"walk:1: 'nan': expected a finite number"}},
    {"ns-2 backwards",
     "ns-2",
     "$node_(0) set X_ 5\n$node_(0) set Y_ 5\n$ns_ at 2 \"$node_(0) setdest 1 1 1\"\n"
     "$ns_ at 1 \"$node_(0) setdest 1 1 1\"\n",
     {"walk:4: $node_(0) is ordered at 1 s after line 3"}},
    {"ns-2 negative speed",
     "ns-2",
     "$ns_ at 2 \"$node_(0) setdest 1 1 -1\"\n",
     {"walk:1: a speed of -1 m/s: expected one from 0"}},
    {"ns-2 a jump", "ns-2", "$ns_ at 2 \"$node_(0) set X_ 1\"\n", {"walk:1: no line of setdest"}},
    {"fcd no XML", "fcd", "<fcd-export>\n<timestep", {"walk:2: not XML"}},
    {"fcd other XML", "fcd", "<routes/>", {"walk:1: no element fcd-export"}},
    {"fcd unordered",
     "fcd",
     "<fcd-export>\n<timestep time='2'/>\n<timestep time='1'/></fcd-export>",
     {"walk:3: timestep at 1 s after a later one"}},
    {"fcd no time",
     "fcd",
     "<fcd-export>\n<timestep/></fcd-export>",
     {"walk:2: timestep: time = '': expected a number"}},
    {"fcd twice",
     "fcd",
     "<fcd-export><timestep time='2'>\n<vehicle id='a' x='1' y='1'/>\n"
     "<vehicle id='a' x='1' y='1'/></timestep></fcd-export>",
     {"walk:3: vehicle a again in one timestep"}},
    {"fcd no y",
     "fcd",
     "<fcd-export><timestep time='2'>\n\n<vehicle id='a' x='1'/></timestep></fcd-export>",
     {"walk:3: vehicle: y = ''"}},
    {"fcd nan",
     "fcd",
     "<fcd-export><timestep time='2'>\n<vehicle id='a' x='nan' y='1'/></timestep></fcd-export>",
     {"walk:2: agent a: x = nan"}},
    {"fcd no id",
     "fcd",
     "<fcd-export><timestep time='2'>\n<vehicle x='1' y='1'/></timestep></fcd-export>",
     {"walk:2: vehicle without an id"}}};

INSTANTIATE_TEST_SUITE_P(Traces, FaultyTrace, testing::ValuesIn(trace_faults),
                         [](const auto& fault) { return test::words(fault.param.what); });

TEST(TraceFormats, APlaceBesideTheFieldIsRefused) {
  EXPECT_THAT(refusal_of("id,t,x,y\na,0,3,4\na,1,5,4.5\n", "csv", {.field = Vector2(5.0, 4.0)}),
              AllOf(HasSubstr("walk:3: agent a: y = 4.5"), HasSubstr("from 0 to 4 m")));
}

TEST(TraceFormats, OfAMillionAgentsTheFirstBeyondTheLimitIsRefusedWithItsLine) {
  std::string text = "id,t,x,y\n";
  std::size_t read = 0;
  for (std::size_t k = 0; k < 1'000'000; ++k) {
    text += std::to_string(k) + ",0,1,2\n";
    if (k + 1 == TraceRules().agents_max) read = parse_trace(text, "walk", "csv").agents.size();
  }
  EXPECT_EQ(read, 250'000u);
  EXPECT_THAT(refusal_of(text, "csv"), AllOf(HasSubstr("walk:250002: agent 250000 is one too many"),
                                             HasSubstr("allowed are 250000 agents")));
  EXPECT_THAT(refusal_of("id,t,x,y\na,0,1,2\na,1,1,2\na,2,1,2\n", "csv", {.points_max = 2}),
              HasSubstr("walk:4: one point too many: allowed are 2 points"));
}

TEST(TraceFormats, AFileThatIsMissingOrEmptyIsRefused) {
  EXPECT_THROW(read_trace("no/such/trace.csv", "csv"), game::SceneError);
  EXPECT_THROW(read_trace(test::source_folder(), "csv"), game::SceneError);
}

}  // namespace
}  // namespace rink::loadgen
