// Plots as files of their own: each can be put into a paper without the page.
#include "loadgen/report/plots/picture.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <pugixml.hpp>
#include <regex>
#include <set>
#include <sstream>

#include "loadgen/measure/judge_run.h"
#include "loadgen/report/report.h"
#include "loadgen/report/write_report.h"
#include "tests/loadgen/report/canned_reports.h"
#include "tests/loadgen/report/markup.h"
#include "tests/temporary_folder.h"

namespace rink::loadgen {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::IsSupersetOf;
using testing::Not;

/// Two values of each axis that plots run along, every figure measured, and names that need
/// escaping.
Experiment many_plots() {
  Experiment experiment = small_experiment();
  experiment.view_margins = {0.0, 0.5};
  experiment.modes = {"client-server", "peer-to-peer"};
  return experiment;
}

RunRecord measured(const Experiment& experiment, const Cell& cell) {
  RunRecord run = record_for(experiment, cell);
  judge(run, canned_server_report(cell), canned_bots_report(cell));
  run.valid = true;
  const double size =
      100.0 * cell.clients + 10.0 * static_cast<double>(cell.seed) + cell.parameters.view_margin;
  run.truth.displayed_error_mm = {size, 3.0 * size, 9.0 * size};
  run.truth.filter_precision = run.truth.delivered_precision = 0.5;
  run.truth.filter_recall = run.truth.delivered_recall = 0.9;
  run.truth.relevance = "a disc of < 3 m";
  run.traffic = {size, size, size, size, size, size, {}};
  run.nodes = {size, {}, size, {}, size, size};
  return run;
}

std::vector<RunRecord> many_runs(const Experiment& experiment) {
  std::vector<RunRecord> runs;
  for (const char* mode : {"client-server", "peer-to-peer"})
    for (const std::uint64_t seed : {1, 2, 3, 4, 5})
      for (const std::uint32_t clients : {10u, 30u, 100u})
        for (const char* scheme :
             {"none", "aura with priority(budget=400)", "aura with priority(budget=100)"})
          for (const double margin : {0.0, 0.5}) {
            Cell cell{mode, scheme, "periodic", clients, seed};
            cell.parameters.view_margin = margin;
            runs.push_back(measured(experiment, cell));
          }
  return runs;
}

/// The words of every class attribute of `node` and of all within.
void add_classes(const pugi::xml_node& node, std::set<std::string>& classes) {
  std::istringstream words(node.attribute("class").value());
  for (std::string word; words >> word;) classes.insert(word);
  for (const pugi::xml_node& child : node) add_classes(child, classes);
}

class PictureTest : public testing::Test {
 protected:
  void write(const Experiment& experiment, const std::vector<RunRecord>& runs) const {
    const ResultsDirectory results(folder_ / "out", true);
    results.subdirectory("cells");
    for (const RunRecord& run : runs)
      results.write("cells/" + name_of(run.cell) + ".bots.json",
                    canned_bots_report(run.cell).dump());
    write_report(results, experiment, runs, {});
  }
  std::set<std::string> files(const std::string& ending) const {
    std::set<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(folder_ / "out/plots"))
      if (entry.path().extension() == ending) names.insert(entry.path().stem());
    return names;
  }
  std::string svg(const std::string& name) const {
    return test::text_of(folder_ / ("out/plots/" + name + ".svg"));
  }

  test::TemporaryFolder folder_{"pictures"};
};

TEST_F(PictureTest, EveryPlotIsAFileNamedAfterItsTable) {
  const Experiment experiment = many_plots();
  const auto runs = many_runs(experiment);
  write(experiment, runs);
  const std::string html = test::text_of(folder_ / "out/report.html");
  std::size_t figures = 0;
  for (std::size_t at = html.find("<svg"); at != std::string::npos; at = html.find("<svg", at + 1))
    ++figures;
  const auto pictures = files(".svg"), tables = files(".csv");
  EXPECT_EQ(pictures.size(), figures);
  EXPECT_EQ(tables.size(), report_of(experiment, runs, {},
                                     {.latencies = latencies_in(folder_ / "out/cells", runs)})
                               .tables.size())
      << "two tables have one name";
  EXPECT_GT(figures, 25u);
  const std::set<std::string> of_numbers_alone{"gains", "quality"};
  for (const std::string& table : tables)
    EXPECT_EQ(pictures.contains(table), !of_numbers_alone.contains(table)) << table;
  for (const std::string& picture : pictures) {
    const std::string table = std::regex_replace(picture, std::regex("-[0-9]+$"), "");
    EXPECT_TRUE(tables.contains(picture) || tables.contains(table)) << picture;
  }
  EXPECT_THAT(pictures,
              IsSupersetOf({"bytes-against-error", "cost-per-tick", "cost-per-tick-2",
                            "update-age-3", "stages-2", "sweep-view_margin-3", "traffic-by-subject",
                            "replications-payload", "growth-over-clients"}));
}

TEST_F(PictureTest, EachIsWellFormedAndHasAStyleForEveryClassThatItNames) {
  const Experiment experiment = many_plots();
  write(experiment, many_runs(experiment));
  std::set<std::string> all;
  for (const std::string& name : files(".svg")) {
    const std::string text = svg(name);
    pugi::xml_document document;
    const auto result = document.load_string(text.c_str(), pugi::parse_full);
    ASSERT_TRUE(result) << name << ": " << result.description();
    EXPECT_EQ(unbalanced(text), "") << name;
    EXPECT_FALSE(std::regex_search(text, std::regex("&(?!(amp|lt|gt|quot|#39);)")))
        << name << " names an entity that XML does not have";
    EXPECT_THAT(text, testing::StartsWith("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<svg "));
    EXPECT_STREQ(document.child("svg").attribute("xmlns").value(), "http://www.w3.org/2000/svg");
    std::set<std::string> classes;
    add_classes(document.child("svg"), classes);
    EXPECT_THAT(classes, Contains("title")) << name;
    const std::string style = document.child("svg").child("style").child_value();
    for (const std::string& word : classes)
      EXPECT_TRUE(std::regex_search(style, std::regex("\\." + word + "[.,{]")))
          << name << ": " << word;
    all.merge(classes);
  }
  EXPECT_THAT(all, IsSupersetOf({"line", "s0", "d0", "box", "dot", "median", "bar", "p2",
                                 "reference", "whisker", "note"}));
}

TEST_F(PictureTest, EachHasASizeAndWhitePaperAndNeedsNothingFromOutside) {
  const Experiment experiment = many_plots();
  write(experiment, many_runs(experiment));
  for (const std::string& name : files(".svg")) {
    const std::string text = svg(name);
    pugi::xml_document document;
    ASSERT_TRUE(document.load_string(text.c_str()));
    const pugi::xml_node root = document.child("svg"), paper = root.child("rect");
    double left = 0.0, top = 0.0, width = 0.0, height = 0.0;
    std::istringstream(root.attribute("viewBox").value()) >> left >> top >> width >> height;
    EXPECT_EQ(root.attribute("width").as_double(), width) << name;
    EXPECT_EQ(root.attribute("height").as_double(), height) << name;
    EXPECT_GT(std::min(width, height), 100.0) << name;
    EXPECT_STREQ(paper.attribute("fill").value(), "#fff") << name;
    EXPECT_EQ(paper.attribute("x").as_double(), left) << name;
    EXPECT_EQ(paper.attribute("width").as_double(), width) << name;
    for (const char* outside : {"var(", "url(", "@import", "href", "<script"})
      EXPECT_THAT(text, Not(HasSubstr(outside))) << name;
  }
}

TEST_F(PictureTest, PlotsOfAnEarlierReportGo) {
  const Experiment experiment = many_plots();
  auto runs = many_runs(experiment);
  write(experiment, runs);
  ASSERT_THAT(files(".svg"), Contains("stages"));
  std::ofstream(folder_ / "out/plots/notes.txt") << "mine";
  std::erase_if(runs, [](const RunRecord& run) { return run.cell.scheme != "none"; });
  write(small_experiment(), runs);
  EXPECT_THAT(files(".svg"), Not(Contains("stages")));
  EXPECT_THAT(files(".csv"), Not(Contains("stages")));
  EXPECT_THAT(files(".txt"), Contains("notes"));
}

TEST(Picture, PanelsOfOneTableAreNumberedFromTheSecondOn) {
  std::vector<std::string> names;
  for (const Picture& picture : numbered({{"a", ""}, {"b", ""}, {"a", ""}, {"a", ""}}))
    names.push_back(picture.name);
  EXPECT_THAT(names, testing::ElementsAre("a", "b", "a-2", "a-3"));
}

}  // namespace
}  // namespace rink::loadgen
