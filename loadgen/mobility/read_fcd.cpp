// Reads SUMO's floating car data (Lopez et al. 2018): all vehicles, persons and containers of each
// time step. Who is missing from a step has left, and may come back.
#include <algorithm>
#include <limits>
#include <pugixml.hpp>

#include "loadgen/mobility/trace_formats.h"
#include "loadgen/mobility/trace_text.h"

namespace rink::loadgen {
namespace {

class FcdReader {
 public:
  FcdReader(std::string_view text, TraceBuilder& builder) : text_(text), builder_(builder) {}

  void read() {
    pugi::xml_document document;
    const pugi::xml_parse_result result =
        document.load_buffer(text_.data(), text_.size(), pugi::parse_default, pugi::encoding_utf8);
    if (!result)
      builder_.refuse(line_at(result.offset), "not XML: " + std::string(result.description()));
    const pugi::xml_node root = document.child("fcd-export");
    if (!root) builder_.refuse(1, "no element fcd-export: expected floating car data of SUMO");
    for (const pugi::xml_node step : root.children("timestep")) read_step(step);
  }

 private:
  void read_step(const pugi::xml_node& step) {
    const double time_s = number(step, "time");
    if (steps_ > 0 && !(time_s > time_s_))
      builder_.refuse(line_of(step), "timestep at " + std::string(step.attribute("time").value()) +
                                         " s after a later one: expected times that rise");
    time_s_ = time_s;
    ++steps_;
    for (const pugi::xml_node each : step.children())
      if (const std::string kind = each.name();
          kind == "vehicle" || kind == "person" || kind == "container")
        read_agent(each, kind);
  }

  void read_agent(const pugi::xml_node& node, const std::string& kind) {
    const std::string id = node.attribute("id").value();
    const std::size_t line = line_of(node);
    if (id.empty()) builder_.refuse(line, kind + " without an id");
    const std::uint32_t agent = builder_.agent(kind == "vehicle" ? id : kind + " " + id, line);
    if (seen_.size() <= agent) seen_.resize(agent + std::size_t{1}, 0);
    if (seen_[agent] == steps_)
      builder_.refuse(line, kind + " " + id + " again in one timestep: expected it once");
    using Way = TraceBuilder::Way;
    const Way way = seen_[agent] + 1 == steps_ ? Way::straight : Way::away;
    seen_[agent] = steps_;
    builder_.add(agent, {time_s_, number(node, "x"), number(node, "y")}, line, way);
  }

  double number(const pugi::xml_node& node, const char* name) {
    const std::string word = node.attribute(name).value();
    const auto read = number_in(word);
    if (!read)
      builder_.refuse(line_of(node), std::string(node.name()) + ": " + name + " = '" + word +
                                         "': expected a number");
    return *read;
  }

  std::size_t line_of(const pugi::xml_node& node) { return line_at(node.offset_debug()); }
  /// The line of a byte; fast for those that come in order.
  std::size_t line_at(std::ptrdiff_t offset) {
    const auto end =
        std::min(text_.size(), static_cast<std::size_t>(std::max<std::ptrdiff_t>(offset, 0)));
    if (end < counted_) counted_ = 0, line_ = 1;
    line_ += static_cast<std::size_t>(
        std::count(text_.begin() + static_cast<std::ptrdiff_t>(counted_),
                   text_.begin() + static_cast<std::ptrdiff_t>(end), '\n'));
    counted_ = end;
    return line_;
  }

  std::string_view text_;
  TraceBuilder& builder_;
  double time_s_ = 0.0;
  std::size_t steps_ = 0;
  std::vector<std::size_t> seen_;  ///< by agent: the number of the last step that it was in
  std::size_t counted_ = 0, line_ = 1;
};

}  // namespace

void read_fcd(std::string_view text, TraceBuilder& builder) { FcdReader(text, builder).read(); }

}  // namespace rink::loadgen
