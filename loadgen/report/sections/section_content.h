// The parts of the report: what each section needs, and what it gives.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "loadgen/experiment/experiment.h"
#include "loadgen/measure/equal_error.h"
#include "loadgen/measure/statistics/histogram.h"
#include "loadgen/measure/tables/discovery_table.h"
#include "loadgen/report/plot_table.h"
#include "loadgen/report/plots/chart.h"
#include "loadgen/report/plots/picture.h"
#include "loadgen/report/sections/cell_lines.h"

namespace rink::loadgen {

/// The latencies of all valid replications of one cell together.
struct CellLatencies {
  Cell cell;  ///< its seed is unused
  Histogram update_latency, input_latency, discovery_latency;
};

/// The data that sections are made from.
struct Findings {
  const Experiment& experiment;
  std::span<const RunRecord> runs;
  std::span<const CellLatencies> latencies;
  std::vector<CellLine> lines;
  std::string relevance;  ///< the definition of true relevance, in words; empty if no run was
                          ///< compared with truth
  std::span<const CellDiscoveries> discoveries{};
};

/// A section's markup, its plots and the tables behind them.
struct SectionContent {
  std::string html;
  std::vector<PlotTable> tables{};
  std::vector<Picture> pictures{};  ///< panels of one table have the table's name, in the order of
                                    ///< the page

  /// Adds a figure, its caption and its data.
  void add(const std::string& svg, const std::string& caption, PlotTable table);
  /// Adds a figure of several that show the table called `table_name`.
  void add_panel(const std::string& table_name, const std::string& svg, const std::string& caption);
  /// Adds a sentence about why something is absent.
  void add_absence(const std::string& sentence);
  /// Adds a sentence about figures that no cell has, `titles` in words; nothing if there are none.
  void add_absences(const std::string& titles);
  void add(SectionContent other);
};

/// The columns that every table by cell begins with, and their values.
std::vector<std::string> cell_columns();
std::vector<std::string> cell_values(const CellLine& line, const CellGroup& group);
/// The lines that plots over clients draw: all, of several parts those of the first, or where a
/// sweep makes too many to tell apart, those with the first value of every parameter.
std::vector<CellLine> plotted_lines(const Findings& findings);
/// The plotted lines of the part called `part`.
std::vector<CellLine> plotted_lines(const Findings& findings, const std::string& part);
/// A cell of a table in a page with the mean of a figure, times `scale`.
std::string mean_cell(const CellGroup& group, FigureOf figure, double scale = 1.0, int digits = 3);
/// Appends mean, low and high of `mean` to `row`, empty where absent.
void append_interval(std::vector<std::string>& row, const std::optional<MeanInterval>& mean);

/// A group's point, whose title has its figures; values that it appends to `row` follow
/// cell_values() in the table. Nothing if the group has no such figures.
using PointOf =
    std::function<std::optional<PlotPoint>(const CellGroup& group, std::vector<std::string>& row)>;
/// Adds to a plot the points of each line, and to the table their rows.
void add_lines(Chart& plot, PlotTable& table, const std::vector<CellLine>& lines,
               const PointOf& point_of);

/// The groups of `lines` with the largest number of clients; and a sentence about this choice,
/// empty if there is only one number.
std::vector<CellLine> largest_crowds(std::vector<CellLine> lines);
std::string largest_crowd_words(const Findings& findings);
/// The range of a linear axis that shows data between `low` and `high`, both at least 0, with a
/// little room, from 0 on.
std::pair<double, double> zoomed(double low, double high);

/// Bytes by purpose, stacked.
SectionContent bytes_by_kind_content(const Findings& findings);
/// Payload by message and field; nothing if no run has counted them.
SectionContent bytes_by_field_content(const Findings& findings);
/// The displayed error's distribution function; nothing if no run left one.
void add_error_distribution(SectionContent& content, const Findings& findings);
/// Recall by the delay of parts that are otherwise alike; nothing if there are no such parts.
void add_recall_against_delay(SectionContent& content, const Findings& findings);
/// Bytes against clients.
SectionContent traffic_content(const Findings& findings);
/// The load of each node with a server and without, and its bytes by purpose.
SectionContent modes_content(const Findings& findings);
/// Bytes against error, and the gains by filter and policy.
SectionContent gains_content(const Findings& findings);
/// Rivals at equal displayed error and recall, which must not be empty, and the curves of `runs`
/// behind them; and the best of them in a sentence, empty if there is none.
SectionContent equal_error_content(const Experiment& experiment, std::span<const RunRecord> runs,
                                   const std::vector<EqualError>& comparisons);
std::string equal_error_headline(const std::vector<EqualError>& comparisons);
/// Precision against recall.
SectionContent relevance_content(const Findings& findings);
/// Bytes against the recall and against the precision of the filter's decisions, for each line that
/// is drawn; nothing if no run was compared with truth.
void add_bytes_against_relevance(SectionContent& content, const Findings& findings);
/// Late discoveries and missed contacts as distribution functions, of the largest number of
/// clients.
SectionContent discovery_content(const Findings& findings);
/// The effect of each parameter of which the experiment lists several values.
SectionContent sweep_content(const Findings& findings);
/// Whether some of the compared expressions differ in their numbers alone, and bytes against error
/// and recall with a curve for each form of them.
bool has_expressions_of_one_form(const Findings& findings);
SectionContent stages_content(const Findings& findings);
/// Whole curves of latency percentiles.
SectionContent latency_content(const Findings& findings);
/// What a tick costs, by part.
SectionContent cost_content(const Findings& findings);
/// How replications scatter.
SectionContent replication_content(const Findings& findings);
/// How a tick's cost grows with clients, pucks and bats, and what a second processor changes.
SectionContent growth_content(const Findings& findings);
/// The state of the load generator itself.
SectionContent generator_content(const Findings& findings);
/// Every run with its figures, and those that do not count with their reasons.
SectionContent runs_content(const Findings& findings);

}  // namespace rink::loadgen
