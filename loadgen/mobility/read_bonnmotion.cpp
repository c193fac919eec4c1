// Reads BonnMotion's native format (Aschenbruck et al. 2010): a line per node with all of its
// waypoints, each a time, an x and a y.
#include "loadgen/mobility/trace_formats.h"
#include "loadgen/mobility/trace_text.h"

namespace rink::loadgen {

void read_bonnmotion(std::string_view text, TraceBuilder& builder) {
  TextLines lines(text);
  std::vector<std::string_view> words;
  std::uint32_t node = 0;
  while (lines.next()) {
    if (lines.line().starts_with('#')) continue;
    list_words(lines.line(), " \t", words);
    if (words.empty() || words.size() % 3 != 0)
      builder.refuse(lines.number(),
                     "node " + std::to_string(node) + " has " + std::to_string(words.size()) +
                         " numbers: expected waypoints of a time, an x and a y each");
    const std::uint32_t agent = builder.agent(std::to_string(node++), lines.number());
    for (std::size_t first = 0; first < words.size(); first += 3) {
      double numbers[3];
      for (std::size_t k = 0; k < 3; ++k) {
        const auto number = number_in(words[first + k]);
        if (!number)
          builder.refuse(lines.number(), "'" + std::string(words[first + k]) + "', the number " +
                                             std::to_string(first + k + 1) +
                                             " of the line: expected a number");
        numbers[k] = *number;
      }
      builder.add(agent, {numbers[0], numbers[1], numbers[2]}, lines.number());
    }
  }
  builder.hold_to_end();
}

}  // namespace rink::loadgen
