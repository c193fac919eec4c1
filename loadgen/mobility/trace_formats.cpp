// Chooses the reader of a format.
#include "loadgen/mobility/trace_formats.h"

#include <cassert>
#include <fstream>
#include <sstream>

#include "loadgen/experiment/parameter.h"

namespace rink::loadgen {
namespace {

struct Format {
  const char* name;
  void (*read)(std::string_view, TraceBuilder&);
  std::vector<const char*> endings;
};

const std::vector<Format>& formats() {
  static const std::vector<Format> all{{"csv", read_csv, {".csv"}},
                                       {"fcd", read_fcd, {".xml"}},
                                       {"ns-2", read_setdest, {".tcl", ".ns_movements"}},
                                       {"bonnmotion", read_bonnmotion, {".movements"}}};
  return all;
}

}  // namespace

std::vector<std::string> trace_formats() {
  std::vector<std::string> names;
  for (const Format& format : formats()) names.emplace_back(format.name);
  return names;
}

std::optional<std::string> trace_format_of(const std::filesystem::path& file) {
  for (const Format& format : formats())
    for (const char* ending : format.endings)
      if (file.extension() == ending) return format.name;
  return std::nullopt;
}

MobilityTrace parse_trace(std::string_view text, const std::string& file, const std::string& format,
                          const TraceRules& rules) {
  TraceBuilder builder(file, rules);
  for (const Format& each : formats()) {
    if (each.name != format) continue;
    each.read(text, builder);
    return builder.finish();
  }
  assert(false && "the format is one of trace_formats()");
  builder.refuse_all("no format " + format);
}

MobilityTrace read_trace(const std::filesystem::path& file, const std::string& format,
                         const TraceRules& rules) {
  std::ifstream stream(file, std::ios::binary);
  std::ostringstream text;
  if (std::filesystem::is_directory(file) || !stream || !(text << stream.rdbuf()))
    throw game::SceneError(file.string() +
                           ": cannot be read, or is empty: expected a mobility trace");
  return parse_trace(text.view(), file.string(), format, rules);
}

std::string csv_of(const MobilityTrace& trace) {
  std::string text = "id,t,x,y\n";
  for (const Agent& agent : trace.agents)
    for (const TracePoint& point : agent.points)
      text += agent.id + "," + shortest(point.time_s) + "," + shortest(point.x) + "," +
              shortest(point.y) + "\n";
  return text;
}

}  // namespace rink::loadgen
