// The formats of mobility traces (docs/scenes.md, "Traces").
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "loadgen/mobility/mobility_trace.h"
#include "loadgen/mobility/trace_builder.h"

namespace rink::loadgen {

/// The names of all formats: csv, fcd, ns-2, bonnmotion.
std::vector<std::string> trace_formats();

/// The format that the ending of `file` tells: .csv; .xml; .tcl and .ns_movements; .movements.
std::optional<std::string> trace_format_of(const std::filesystem::path& file);

/// The trace in `text`, which is of `format`, one of trace_formats() (asserted). Throws
/// game::SceneError that begins with `file` and the line.
MobilityTrace parse_trace(std::string_view text, const std::string& file, const std::string& format,
                          const TraceRules& rules = {});

/// The trace in `file`. Throws game::SceneError, also if it cannot be read.
MobilityTrace read_trace(const std::filesystem::path& file, const std::string& format,
                         const TraceRules& rules = {});

/// `trace` as CSV, with numbers that read back to the same bits. Agents that come back need a
/// `gap_s` to be read as such. For tools and tests.
std::string csv_of(const MobilityTrace& trace);

/// Readers of one format each.
void read_csv(std::string_view text, TraceBuilder& builder);
void read_fcd(std::string_view text, TraceBuilder& builder);
void read_setdest(std::string_view text, TraceBuilder& builder);
void read_bonnmotion(std::string_view text, TraceBuilder& builder);

}  // namespace rink::loadgen
