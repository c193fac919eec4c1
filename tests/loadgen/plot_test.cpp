// Axes, boxes, curves and tables: values stand where they belong, and what cannot be drawn is left out.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "loadgen/report/axis.h"
#include "loadgen/report/bar_plot.h"
#include "loadgen/report/box_plot.h"
#include "loadgen/report/line_plot.h"
#include "loadgen/report/plot_table.h"
#include "loadgen/report/text.h"

namespace rink::loadgen {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

/// Where the marks of `svg` stand.
std::vector<std::pair<double, double>> marks_of(const std::string& svg) {
  std::vector<std::pair<double, double>> places;
  for (std::size_t at = svg.find("<path d=\"M"); at != std::string::npos; at = svg.find("<path d=\"M", at + 1)) {
    const std::string path = svg.substr(at + 10, svg.find('>', at) - at - 10);
    if (path.find("class=\"mark ") != std::string::npos) places.emplace_back(std::stod(path), std::stod(path.substr(path.find(' '))));
  }
  return places;
}

std::vector<double> places_of(const Ticks& ticks) {
  std::vector<double> places;
  for (const auto& [value, text] : ticks.major) places.push_back(value);
  return places;
}

TEST(Plot, NumbersAreShort) {
  EXPECT_EQ(short_number(0.0), "0");
  EXPECT_EQ(short_number(0.25), "0.25");
  EXPECT_EQ(short_number(999.0), "999");
  EXPECT_EQ(short_number(1000.0), "1 k");
  EXPECT_EQ(short_number(1'234'567.0), "1.23 M");
  EXPECT_EQ(plain_number(0.012345), "0.0123");
  EXPECT_EQ(plain_number(12345.6), "12346");
  EXPECT_EQ(plain_number(std::nullopt), "\xE2\x80\x93");
}

TEST(Plot, TicksStandAtOneTwoAndFive) {
  const Axis axis{1.0, 100.0, 0.0, 400.0, true};
  EXPECT_THAT(places_of(ticks_of(axis, 30.0)), ElementsAre(1, 2, 5, 10, 20, 50, 100));
  EXPECT_THAT(ticks_of(axis, 30.0).minor, ElementsAre(3, 4, 6, 7, 8, 9, 30, 40, 60, 70, 80, 90));
  EXPECT_THAT(places_of(ticks_of({1.0, 1e6, 0.0, 200.0, true}, 30.0)), ElementsAre(1, 10, 100, 1e3, 1e4, 1e5, 1e6));
  EXPECT_THAT(places_of(ticks_of({0.0, 10.0, 0.0, 100.0, false}, 25.0)), ElementsAre(0, 5, 10));
  EXPECT_THAT(places_of(ticks_of({0.0, 10.0, 0.0, 300.0, false}, 25.0)), ElementsAre(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10));
}

LinePlot three_decades() {
  LinePlot plot;
  plot.title = "t";
  PlotLine line{"a", {}, {}};
  for (const double x : {10.0, 100.0, 1000.0}) line.points.push_back({x, x / 2.0, {}, {}, "here"});
  plot.lines = {line};
  plot.has_legend = false;
  return plot;
}

TEST(Plot, TicksOfANarrowRangeHaveTheDigitsThatTellThemApart) {
  std::vector<std::string> texts;
  for (const auto& [value, text] : ticks_of({0.9989, 1.0, 0.0, 300.0, false}, 40.0).major) texts.push_back(text);
  EXPECT_THAT(texts, ElementsAre("0.999", "0.9992", "0.9994", "0.9996", "0.9998", "1"));
}

TEST(Plot, ReferenceCurveOfWhichNoMoreThanAPointIsSeenIsNotNamed) {
  LinePlot plot = three_decades();
  plot.references = {{"seen", {{20.0, 20.0}, {200.0, 30.0}}}, {"unseen", {{0.1, 20.0}, {20.0, 20.0}}}};
  EXPECT_THAT(to_svg(plot), AllOf(HasSubstr(">seen<"), Not(HasSubstr("unseen"))));
}

TEST(Plot, ALogarithmicAxisPutsEqualRatiosAtEqualDistances) {
  LinePlot plot = three_decades();
  const auto marks = marks_of(to_svg(plot));
  ASSERT_EQ(marks.size(), 3u);
  EXPECT_NEAR(marks[1].first - marks[0].first, marks[2].first - marks[1].first, 0.2);
  EXPECT_NEAR(marks[1].second - marks[0].second, marks[2].second - marks[1].second, 0.2);
}

TEST(Plot, WhatALogarithmicAxisCannotShowIsLeftOut) {
  LinePlot plot = three_decades();
  plot.lines[0].points[1].y = 0.0;
  plot.lines[0].points[2].y_interval = {-3.0, 900.0};
  const std::string svg = to_svg(plot);
  EXPECT_EQ(marks_of(svg).size(), 2u);
  EXPECT_THAT(svg, AllOf(Not(HasSubstr("nan")), Not(HasSubstr("inf"))));
  for (PlotPoint& point : plot.lines[0].points) point.y = std::nan("");
  EXPECT_FALSE(has_points(plot));
  EXPECT_THAT(to_svg(plot), Not(HasSubstr("nan")));
}

TEST(Plot, LinesDifferInMoreThanColour) {
  LinePlot plot = three_decades();
  plot.lines.push_back(plot.lines[0]);
  plot.lines[1].style = {0, 1, 1};
  const std::string svg = to_svg(plot);
  EXPECT_THAT(svg, AllOf(HasSubstr("line s0 d0"), HasSubstr("line s0 d1")));
}

// Tukey's own rule on samples whose quartiles are plain to see.
TEST(BoxPlot, HingesAreMediansOfTheHalvesAndFarValuesLieOutside) {
  const BoxFigures odd = box_of({9, 1, 5, 3, 7});
  EXPECT_EQ(odd.median, 5);
  EXPECT_EQ(odd.low_hinge, 3);
  EXPECT_EQ(odd.high_hinge, 7);
  EXPECT_EQ(odd.low_whisker, 1);
  EXPECT_EQ(odd.high_whisker, 9);
  EXPECT_TRUE(odd.outside.empty());
  const BoxFigures even = box_of({1, 2, 3, 4, 5, 6, 7, 100});
  EXPECT_EQ(even.median, 4.5);
  EXPECT_EQ(even.low_hinge, 2.5);
  EXPECT_EQ(even.high_hinge, 6.5);
  EXPECT_EQ(even.high_whisker, 7);
  EXPECT_THAT(even.outside, ElementsAre(100));
  const BoxFigures one = box_of({4});
  EXPECT_EQ(one.low_whisker, 4);
  EXPECT_EQ(one.high_hinge, 4);
}

TEST(BoxPlot, FewReplicationsAreDotsWithoutABox) {
  BoxPlot plot{"t", "x", "", true, {{"10 clients", {{"a", {}, {1, 2, 3, 4}}}}}};
  EXPECT_THAT(to_svg(plot), AllOf(HasSubstr("class=\"dot s0\""), Not(HasSubstr("class=\"box s0\""))));
  plot.groups[0].rows[0].values.push_back(5);
  EXPECT_THAT(to_svg(plot), HasSubstr("class=\"box s0\""));
}

TEST(BarPlot, PartsStackToTheirSumAndTheBudgetIsDrawnOnlyWithinReach) {
  BarPlot plot{"t", "x", "y", "", {"physics", "filter", "send"}, {{"10", {1.0, 2.0, 3.0}, ""}}, {}, 6.0, "budget"};
  EXPECT_THAT(to_svg(plot), HasSubstr("mark-line"));
  plot.mark = 60.0;
  EXPECT_THAT(to_svg(plot), Not(HasSubstr("mark-line")));
}

TEST(PlotTable, CommentsComeFirstAndCellsThatNeedItAreQuoted) {
  const PlotTable table{"t", "About\nit", {"line", "x"}, {{"none, periodic", "1"}, {"say \"a\"", "2"}}};
  EXPECT_EQ(to_csv(table, {{{"kernel", "Linux"}}}), "# About it\n# kernel: Linux\nline,x\n\"none, periodic\",1\n\"say \"\"a\"\"\",2\n");
}

}  // namespace
}  // namespace rink::loadgen
