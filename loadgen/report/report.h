// The comparison as one HTML page that needs neither network nor script, its plots, and the tables
// behind them.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "loadgen/report/page.h"
#include "loadgen/report/sections/section_content.h"

namespace rink::loadgen {

/// A section from another part of the load generator, e.g. where the server saturates.
struct ReportSection {
  std::string id, title;  ///< `id` of letters and dashes
  SectionContent content;
};

/// Findings that a page may show besides runs.
struct MoreFindings {
  std::span<const CellLatencies> latencies{};
  std::span<const CellDiscoveries> discoveries{};
  std::span<const ReportSection> sections{};
};

/// The page: plots, tables, the runs that did not count with their reasons, definitions, how to
/// reproduce, and provenance. Light and dark follow the reader's setting; print is light. All text
/// from outside is escaped. The same input gives the same bytes. A sentence replaces what was not
/// measured.
Report report_of(const Experiment& experiment, std::span<const RunRecord> runs,
                 const Provenance& provenance, const MoreFindings& more = {});

/// The whole histograms of the valid `runs` from their reports in `cells`; missing or unreadable
/// ones are left out.
std::vector<CellLatencies> latencies_in(const std::filesystem::path& cells,
                                        std::span<const RunRecord> runs);

}  // namespace rink::loadgen
