// The figures of a run that several sections draw.
#pragma once

#include "loadgen/report/sections/cell_lines.h"

namespace rink::loadgen {

inline constexpr FigureOf payload = [](const RunRecord& run) {
  return run.down_bytes_per_client_per_s;
};
inline constexpr FigureOf on_the_wire = [](const RunRecord& run) {
  return run.wire_bytes_per_client_per_s;
};
inline constexpr FigureOf displayed_rms = [](const RunRecord& run) {
  return run.truth.displayed_error_mm.rms;
};
inline constexpr FigureOf displayed_p99 = [](const RunRecord& run) {
  return run.truth.displayed_error_mm.p99;
};
inline constexpr FigureOf filter_precision{
    [](const RunRecord& run) { return run.truth.filter_precision; }, Scale::fraction};
inline constexpr FigureOf filter_recall{
    [](const RunRecord& run) { return run.truth.filter_recall; }, Scale::fraction};
inline constexpr FigureOf delivered_recall{
    [](const RunRecord& run) { return run.truth.delivered_recall; }, Scale::fraction};

}  // namespace rink::loadgen
