// What the author of a federate or of a filter includes, and how little comes with it.
#include <map>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include "tests/house/source_tree.h"

namespace rink::house {
namespace {

/// All that is there for whoever writes a federate, and what a filter's user or author needs.
const std::vector<std::string> public_headers{"rti/ambassador.h", "rti/federate_ambassador.h",
                                              "rti/types.h",      "rti/handles.h",
                                              "rti/hla_error.h",  "rti/membership.h",
                                              "rti/fom/fom.h",    "rti/transport/federate_link.h",
                                              "im/region.h",      "im/change.h",
                                              "im/filter.h"};

using Graph = std::map<std::string, std::set<std::string>>;

Graph includes() {
  static const std::regex pattern("^#include \"([^\"]+)\"");
  Graph graph;
  for (const SourceFile& source : read_sources({"im", "rti"}, {".h"}))
    for (const std::string& line : source.lines)
      if (std::smatch match; std::regex_search(line, match, pattern))
        graph[source.path].insert(match[1]);
  return graph;
}

void gather(const Graph& graph, const std::string& header, std::set<std::string>& closure) {
  if (const auto found = graph.find(header); found != graph.end())
    for (const std::string& included : found->second)
      if (closure.insert(included).second) gather(graph, included, closure);
}

TEST(PublicFace, BringsAtMostTwelveHeadersAlong) {
  const Graph graph = includes();
  for (const std::string& header : public_headers) {
    std::set<std::string> closure;
    gather(graph, header, closure);
    EXPECT_LE(closure.size(), 12u) << header << " includes " << ::testing::PrintToString(closure);
  }
}

TEST(PublicFace, OfAFilterIsWithoutTheRtiAndThatOfAFederateWithoutItsInside) {
  const Graph graph = includes();
  for (const std::string& header : public_headers) {
    std::set<std::string> closure;
    gather(graph, header, closure);
    for (const std::string& included : closure) {
      EXPECT_FALSE(header.starts_with("im/") && !included.starts_with("im/"))
          << header << " includes " << included;
      EXPECT_FALSE(included.starts_with("rti/federate/") || included.starts_with("rti/federation/"))
          << header << " includes " << included;
    }
  }
}

}  // namespace
}  // namespace rink::house
