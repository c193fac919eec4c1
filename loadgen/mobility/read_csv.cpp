// Reads traces of comma-separated values: a line per point, under a heading with id, t, x and y.
#include <algorithm>
#include <array>

#include "loadgen/mobility/trace_formats.h"
#include "loadgen/mobility/trace_text.h"

namespace rink::loadgen {
namespace {

using Fields = std::vector<std::string_view>;
constexpr std::array<std::string_view, 4> columns{"id", "t", "x", "y"};

void split(std::string_view line, Fields& fields) {
  fields.clear();
  for (std::size_t end = 0; end != std::string_view::npos;) {
    end = line.find(',');
    std::string_view field = line.substr(0, end);
    const std::size_t first = field.find_first_not_of(" \t"), last = field.find_last_not_of(" \t");
    field = first == std::string_view::npos ? std::string_view()
                                            : field.substr(first, last - first + 1);
    fields.push_back(field);
    if (end != std::string_view::npos) line.remove_prefix(end + 1);
  }
}

/// Where each of `columns` stands.
std::array<std::size_t, 4> places_in(const Fields& heading, std::size_t line,
                                     const TraceBuilder& builder) {
  std::array<std::size_t, 4> places{};
  for (std::size_t k = 0; k < columns.size(); ++k) {
    if (std::ranges::count(heading, columns[k]) != 1)
      builder.refuse(line, "expected a heading with each of id, t, x and y once, such as id,t,x,y");
    places[k] = static_cast<std::size_t>(std::ranges::find(heading, columns[k]) - heading.begin());
  }
  return places;
}

bool is_skipped(std::string_view line) { return line.empty() || line.starts_with('#'); }

}  // namespace

void read_csv(std::string_view text, TraceBuilder& builder) {
  TextLines lines(text);
  Fields fields;
  while (lines.next() && is_skipped(lines.line())) {
  }
  split(lines.line(), fields);
  const std::size_t field_count = fields.size();
  const auto places = places_in(fields, lines.number(), builder);
  while (lines.next()) {
    if (is_skipped(lines.line())) continue;
    split(lines.line(), fields);
    if (fields.size() != field_count)
      builder.refuse(lines.number(), std::to_string(fields.size()) + " values: expected " +
                                         std::to_string(field_count) + " as in the heading");
    std::array<double, 3> numbers{};
    for (std::size_t k = 0; k < numbers.size(); ++k) {
      const std::string_view field = fields[places[k + 1]];
      const auto number = number_in(field);
      if (!number)
        builder.refuse(lines.number(), std::string(columns[k + 1]) + " = '" + std::string(field) +
                                           "': expected a number");
      numbers[k] = *number;
    }
    const std::uint32_t agent = builder.agent(fields[places[0]], lines.number());
    builder.add(agent, {numbers[0], numbers[1], numbers[2]}, lines.number());
  }
}

}  // namespace rink::loadgen
