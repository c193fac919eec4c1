// Axes, boxes, curves and tables: values stand where they belong, and what cannot be drawn is left
// out.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "loadgen/report/plot_table.h"
#include "loadgen/report/plots/axis.h"
#include "loadgen/report/plots/boxes.h"
#include "loadgen/report/plots/chart_svg.h"
#include "loadgen/report/plots/lines.h"
#include "loadgen/report/plots/style.h"
#include "loadgen/report/plots/svg.h"
#include "loadgen/report/plots/text.h"

namespace rink::loadgen {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

/// Where the marks of `svg` stand.
std::vector<std::pair<double, double>> marks_of(const std::string& svg) {
  std::vector<std::pair<double, double>> places;
  for (std::size_t at = svg.find("<path d=\"M"); at != std::string::npos;
       at = svg.find("<path d=\"M", at + 1)) {
    const std::string path = svg.substr(at + 10, svg.find('>', at) - at - 10);
    if (path.find("class=\"mark ") != std::string::npos)
      places.emplace_back(std::stod(path), std::stod(path.substr(path.find(' '))));
  }
  return places;
}

const std::string long_name = "region or strips with priority(budget=60), dead-reckoning";

/// The texts of `svg` that reach beyond its `width`, by the width that a letter takes at most.
std::vector<std::string> texts_beyond(const std::string& svg, double width) {
  std::vector<std::string> result;
  for (std::size_t at = svg.find("<text x=\""); at != std::string::npos;
       at = svg.find("<text x=\"", at + 1)) {
    const std::size_t begin = svg.find('>', at) + 1;
    const std::string classes = svg.substr(at, begin - at),
                      text = svg.substr(begin, svg.find("</text>", at) - begin);
    const double anchor = std::stod(svg.substr(at + 9)), taken = text_width(text);
    const double left = anchor - taken * (classes.find(" end\"") != std::string::npos      ? 1.0
                                          : classes.find(" middle\"") != std::string::npos ? 0.5
                                                                                           : 0.0);
    if (left < 0.0 || left + taken > width) result.push_back(text);
  }
  return result;
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
  EXPECT_EQ(short_bytes_per_s(606.0), "606 B/s");
  EXPECT_EQ(short_bytes_per_s(1500.0), "1.5 kB/s");
  EXPECT_EQ(plain_number(0.012345), "0.0123");
  EXPECT_EQ(plain_number(12345.6), "12346");
  EXPECT_EQ(plain_number(std::nullopt), "\xE2\x80\x93");
}

TEST(Plot, TicksStandAtOneTwoAndFive) {
  const Axis axis{1.0, 100.0, 0.0, 400.0, true};
  EXPECT_THAT(places_of(ticks_of(axis, 30.0)), ElementsAre(1, 2, 5, 10, 20, 50, 100));
  EXPECT_THAT(ticks_of(axis, 30.0).minor, ElementsAre(3, 4, 6, 7, 8, 9, 30, 40, 60, 70, 80, 90));
  EXPECT_THAT(places_of(ticks_of({1.0, 1e6, 0.0, 200.0, true}, 30.0)),
              ElementsAre(1, 10, 100, 1e3, 1e4, 1e5, 1e6));
  EXPECT_THAT(places_of(ticks_of({0.0, 10.0, 0.0, 100.0, false}, 25.0)), ElementsAre(0, 5, 10));
  EXPECT_THAT(places_of(ticks_of({0.0, 10.0, 0.0, 300.0, false}, 25.0)),
              ElementsAre(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10));
}

TEST(Plot, WordsThatDoNotFitLoseTheirMiddle) {
  EXPECT_EQ(fitted("region", text_width("region")), "region");
  EXPECT_EQ(fitted("region, on-event", text_width("12345678")), "reg\xE2\x80\xA6vent");
  EXPECT_EQ(fitted("m\xC2\xB2m\xC2\xB2m\xC2\xB2", text_width("12345")),
            "m\xC2\xB2\xE2\x80\xA6m\xC2\xB2")
      << "letters stay whole";
}

Chart three_decades() {
  Chart plot{.title = "t", .x = {"", true}, .y = {"", true}};
  PlotLine line{"a", {}, {}};
  for (const double x : {10.0, 100.0, 1000.0}) line.points.push_back({x, x / 2.0, {}, {}, "here"});
  plot.lines = {line};
  plot.has_legend = false;
  return plot;
}

TEST(Plot, TicksOfANarrowRangeHaveTheDigitsThatTellThemApart) {
  std::vector<std::string> texts;
  for (const auto& [value, text] : ticks_of({0.9989, 1.0, 0.0, 300.0, false}, 40.0).major)
    texts.push_back(text);
  EXPECT_THAT(texts, ElementsAre("0.999", "0.9992", "0.9994", "0.9996", "0.9998", "1"));
}

TEST(Plot, ReferenceCurveOfWhichNoMoreThanAPointIsSeenIsNotNamed) {
  Chart plot = three_decades();
  plot.references = {{"seen", {{20.0, 20.0}, {200.0, 30.0}}},
                     {"unseen", {{0.1, 20.0}, {20.0, 20.0}}}};
  EXPECT_THAT(to_svg(plot), AllOf(HasSubstr(">seen<"), Not(HasSubstr("unseen"))));
}

TEST(Plot, ALogarithmicAxisPutsEqualRatiosAtEqualDistances) {
  Chart plot = three_decades();
  const auto marks = marks_of(to_svg(plot));
  ASSERT_EQ(marks.size(), 3u);
  EXPECT_NEAR(marks[1].first - marks[0].first, marks[2].first - marks[1].first, 0.2);
  EXPECT_NEAR(marks[1].second - marks[0].second, marks[2].second - marks[1].second, 0.2);
}

TEST(Plot, WhatALogarithmicAxisCannotShowIsLeftOut) {
  Chart plot = three_decades();
  plot.lines[0].points[1].y = 0.0;
  plot.lines[0].points[2].y_interval = {-3.0, 900.0};
  const std::string svg = to_svg(plot);
  EXPECT_EQ(marks_of(svg).size(), 2u);
  EXPECT_THAT(svg, AllOf(Not(HasSubstr("nan")), Not(HasSubstr("inf"))));
  for (PlotPoint& point : plot.lines[0].points) point.y = std::nan("");
  EXPECT_FALSE(has_points(plot));
  EXPECT_THAT(to_svg(plot), Not(HasSubstr("nan")));
}

TEST(Plot, AnIntervalThatGoesOnBeyondTheAxisHasNoCapThere) {
  const auto strokes_of = [](std::pair<double, double> interval) {
    Chart plot = three_decades();
    plot.lines[0].points[1].y_interval = interval;
    const std::string svg = to_svg(plot);
    const std::size_t end = svg.find("class=\"whisker");
    const std::size_t begin = svg.rfind("<path d=\"", end);
    return std::count(svg.begin() + static_cast<std::ptrdiff_t>(begin),
                      svg.begin() + static_cast<std::ptrdiff_t>(end), 'M');
  };
  EXPECT_EQ(strokes_of({20.0, 80.0}), 3) << "the bar and a cap at each end";
  EXPECT_EQ(strokes_of({0.001, 80.0}), 2) << "an axis that begins near 5 shows no end at 0.001";
  EXPECT_EQ(strokes_of({0.001, 1e6}), 1);
}

TEST(Plot, LinesDifferInMoreThanColour) {
  Chart plot = three_decades();
  plot.lines.push_back(plot.lines[0]);
  plot.lines[1].style = {0, 1, 1};
  const std::string svg = to_svg(plot);
  EXPECT_THAT(svg, AllOf(HasSubstr("line s0 d0"), HasSubstr("line s0 d1")));
}

// Tukey's own rule on samples whose quartiles are plain to see.
/// How much [user units] of a legend's sample is seen as a gap: the mark in its middle hides ten.
double gaps_seen(const std::string& dash) {
  constexpr double sample = 26.0, step = 0.1;
  const std::string style = picture_style, rule = "." + dash + "{stroke-dasharray:";
  std::istringstream lengths(style.substr(style.find(rule) + rule.size()));
  std::vector<double> pattern;
  for (double length = 0.0; lengths >> length;) pattern.push_back(length);
  double seen = 0.0, at = 0.0;
  for (std::size_t i = 0; !pattern.empty() && at < sample; at += pattern[i++ % pattern.size()])
    for (double x = at; i % 2 == 1 && x < std::min(sample, at + pattern[i % pattern.size()]);
         x += step)
      if (std::abs(x - sample / 2.0) > 5.0) seen += step;
  return seen;
}

TEST(Plot, ALegendShowsWhichLinesAreDashed) {
  EXPECT_EQ(gaps_seen("d0"), 0.0);
  for (const char* dash : {"d1", "d2", "d3"}) EXPECT_GT(gaps_seen(dash), 4.0) << dash;
}

TEST(Plot, NamesOfCurvesThatBeginAtOnePlaceStandApart) {
  Chart plot = three_decades();
  std::vector<std::pair<double, double>> diagonal;
  for (int i = 0; i <= 40; ++i)
    diagonal.emplace_back(10.0 * std::pow(100.0, i / 40.0), 5.0 * std::pow(100.0, i / 40.0));
  plot.references = {{"8 + 2 n", diagonal}, {"9 + 2 n", diagonal}, {"8 n^2", diagonal}};
  const std::string svg = to_svg(plot);
  std::vector<std::pair<double, double>> places;
  for (const ReferenceCurve& curve : plot.references) {
    const std::size_t end = svg.find(">" + curve.name + "<");
    ASSERT_NE(end, std::string::npos) << curve.name;
    const std::string text = svg.substr(svg.rfind("<text x=\"", end) + 9, 40);
    places.emplace_back(std::stod(text), std::stod(text.substr(text.find("y=\"") + 3)));
  }
  for (std::size_t i = 0; i < places.size(); ++i)
    for (std::size_t k = 0; k < i; ++k)
      EXPECT_TRUE(std::abs(places[i].first - places[k].first) > 40.0 ||
                  std::abs(places[i].second - places[k].second) > 10.5)
          << plot.references[i].name << ", " << plot.references[k].name;
}

TEST(Plot, ATitleAndALegendThatAreTooLongStayWithinThePlot) {
  Chart plot = three_decades();
  plot.title = plot.lines[0].name = long_name + ", " + long_name;
  plot.has_legend = true;
  const std::string svg = to_svg(plot);
  EXPECT_THAT(texts_beyond(svg, plot.width), ElementsAre());
  EXPECT_THAT(svg, HasSubstr("aria-label=\"" + plot.title)) << "is whole for screen readers";
}

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
  Chart plot{.title = "t", .x = {"x", true}, .groups = {{"10 clients", {{"a", {}, {1, 2, 3, 4}}}}}};
  EXPECT_THAT(to_svg(plot),
              AllOf(HasSubstr("class=\"dot s0\""), Not(HasSubstr("class=\"box s0\""))));
  plot.groups[0].rows[0].values.push_back(5);
  EXPECT_THAT(to_svg(plot), HasSubstr("class=\"box s0\""));
}

TEST(BoxPlot, LongNamesStandInFullAboveTheirRows) {
  Chart plot{.title = "t",
             .x = {"x", true},
             .groups = {{"10 clients", {{"none", {}, {1, 2}}, {long_name, {}, {3, 4}}}}}};
  EXPECT_THAT(to_svg(plot), AllOf(HasSubstr(">none<"), HasSubstr(">" + long_name + "<")));
  EXPECT_THAT(texts_beyond(to_svg(plot), plot.width), ElementsAre());
  plot.groups[0].rows[1].name += ", " + long_name;
  EXPECT_THAT(texts_beyond(to_svg(plot), plot.width), ElementsAre());
}

TEST(BarPlot, NamesThatAreWiderThanTheirPlacesAreNumberedAndListedBelow) {
  Chart plot{.title = "t",
             .x = {"x"},
             .y = {"y"},
             .width = 380.0,
             .frame_height = 190.0,
             .part_names = {"states"},
             .bars = {{"none", {1.0}, ""}, {"region", {2.0}, ""}}};
  EXPECT_THAT(to_svg(plot), AllOf(HasSubstr("class=\"tick middle\">none<"),
                                  HasSubstr("class=\"tick middle\">region<")));
  plot.bars.push_back({long_name, {3.0}, ""});
  const std::string svg = to_svg(plot);
  EXPECT_THAT(svg, AllOf(HasSubstr("class=\"tick middle\">3<"), HasSubstr(">1: none<"),
                         HasSubstr(">2: region<"), Not(HasSubstr("class=\"tick middle\">none<"))));
  EXPECT_THAT(texts_beyond(svg, plot.width), ElementsAre());
}

TEST(BarPlot, PartsStackToTheirSumAndTheBudgetIsDrawnOnlyWithinReach) {
  Chart plot{.title = "t",
             .x = {"x"},
             .y = {"y"},
             .width = 380.0,
             .frame_height = 190.0,
             .part_names = {"physics", "filter", "send"},
             .bars = {{"10", {1.0, 2.0, 3.0}, ""}},
             .mark = {{6.0, "budget"}}};
  EXPECT_THAT(to_svg(plot), HasSubstr("mark-line"));
  plot.mark->value = 60.0;
  EXPECT_THAT(to_svg(plot), Not(HasSubstr("mark-line")));
}

TEST(PlotTable, CommentsComeFirstAndCellsThatNeedItAreQuoted) {
  const PlotTable table{
      "t", "About\nit", {"line", "x"}, {{"none, periodic", "1"}, {"say \"a\"", "2"}}};
  EXPECT_EQ(to_csv(table, {{{"kernel", "Linux"}}}),
            "# About it\n# kernel: Linux\nline,x\n\"none, periodic\",1\n\"say \"\"a\"\"\",2\n");
}

}  // namespace
}  // namespace rink::loadgen
