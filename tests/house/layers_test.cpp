// Who may know whom: fails when a folder includes what the layout forbids it to know.
#include <gtest/gtest-spi.h>

#include <map>
#include <optional>
#include <set>

#include "tests/house/source_tree.h"

namespace rink::house {
namespace {

using Names = std::vector<std::string>;

/// A folder's code and the project's folders (without those below them) that it may include.
struct Layer {
  std::string folder;
  Names may_know;
};

/// The most specific folder stands before those that contain it. bench and tests may include
/// anything.
const std::vector<Layer> layers{
    {"im/basics", {}},
    {"im/matching", {"im/matching", "im"}},
    {"im/pairs/template", {"im/pairs"}},
    {"im/pairs", {"im/pairs", "im/schemes", "im", "im/matching"}},
    {"im/view", {"im/view", "im/schemes", "im", "im/matching"}},
    {"im/composition", {"im/composition", "im/stages", "im/pairs", "im", "im/matching"}},
    {"im/stages", {"im/stages", "im/schemes", "im/pairs", "im/composition", "im", "im/matching"}},
    {"im/schemes", {"im/schemes", "im", "im/matching"}},
    {"im", {"im", "im/matching", "im/composition"}},
    {"rti/transport/mpi", {"rti/transport/mpi", "rti/transport"}},
    {"rti/transport/modelled", {"rti/transport/modelled", "rti/transport"}},
    {"rti/transport", {"rti/transport", "rti/transport/modelled", "rti", "im"}},
    {"rti/standard", {"rti/standard", "rti/transport", "rti", "im"}},
    {"rti", {"rti", "im", "im/stages"}},
    {"game/physics/events", {"game/physics/events", "game/physics"}},
    {"game/physics/flight", {"game/physics/flight", "game/physics"}},
    {"game/physics/grid", {"game/physics/grid", "game/physics"}},
    {"game/physics/bodies",
     {"game/physics/bodies", "game/physics/grid", "game/physics/flight", "game/physics"}},
    {"game/physics/contact", {"game/physics/contact", "game/physics/flight", "game/physics"}},
    {"game/physics/engine",
     {"game/physics/engine", "game/physics/bodies", "game/physics/contact", "game/physics/events",
      "game/physics/grid", "game/physics/flight", "game/physics"}},
    {"game/physics/slabs",
     {"game/physics/slabs", "game/physics/engine", "game/physics/bodies", "game/physics/events",
      "game/physics/grid", "game/physics/flight", "game/physics"}},
    {"game/physics/collision", {"game/physics/collision", "game/physics/flight", "game/physics"}},
    {"game/physics/extended", {"game/physics/extended", "game/physics"}},
    {"game/physics/paper",
     {"game/physics/paper", "game/physics/bodies", "game/physics/collision", "game/physics"}},
    {"game/physics",
     {"game/physics", "game/physics/bodies", "game/physics/engine", "game/physics/flight",
      "game/physics/paper", "game/physics/slabs"}},
    {"game/version", {"game/version"}},
    {"game/process", {"game/process", "game/physics"}},
    {"game/model", {"game/model", "game/physics", "game/physics/flight"}},
    {"game/peer", {"game/peer", "game/physics", "game/physics/flight"}},
    {"game/control", {"game/control", "game/players", "game/model", "game/physics"}},
    {"game/match", {"game/match", "game/control", "game/players", "game/model", "game/physics"}},
    {"game/players", {"game/players", "game/model", "game/physics", "game/physics/flight"}},
    {"game/replication",
     {"game/replication", "game/control", "game/model", "game/physics", "rti", "im",
      "game/physics/flight"}},
    {"game/net/peer",
     {"game/net/peer", "game/net", "game/match", "game/peer", "game/replication", "game/control",
      "game/players", "game/model", "game/physics", "rti", "rti/transport", "rti/transport/mpi",
      "im", "game/physics/flight"}},
    {"game/net/server",
     {"game/net/server", "game/net", "game/match", "game/replication", "game/control", "game/model",
      "game/physics", "rti", "rti/transport", "im"}},
    {"game/net/client",
     {"game/net/client", "game/net", "game/match", "game/replication", "game/control", "game/model",
      "game/physics", "rti", "rti/transport"}},
    {"game/net",
     {"game/net", "game/match", "game/replication", "game/control", "game/model", "game/physics",
      "rti", "rti/transport", "im/pairs"}},
    {"game/node",
     {"game/node", "game/net/server", "game/net", "game/net/peer", "game/peer", "game/replication",
      "game/control", "game/players", "game/model", "game/physics", "rti/transport", "im"}},
    {"game/apps",
     {"game/apps",       "game/version",     "game/view",    "game/view/render", "game/match",
      "game/net/server", "game/net/client",  "game/net",     "game/net/peer",    "game/node",
      "game/peer",       "game/replication", "game/control", "game/players",     "game/model",
      "game/physics",    "game/process",     "rti",          "rti/transport",    "im"}},
    {"game/view/render", {"game/view/render"}},
    {"game/view",
     {"game/view", "game/view/render", "game/process", "game/match", "game/net/client", "game/net",
      "game/net/peer", "game/replication", "game/control", "game/model", "game/physics", "rti"}},
    {"loadgen/experiment",
     {"loadgen/experiment", "game/players", "game/net", "game/net/peer", "game/replication",
      "game/model", "rti", "rti/transport/modelled"}},
    {"loadgen/mobility",
     {"loadgen/mobility", "loadgen/experiment", "game/net/server", "game/net", "game/control",
      "game/model", "game/physics", "game/physics/flight", "im"}},
    {"loadgen/measure",
     {"loadgen/measure", "loadgen/mobility", "loadgen/experiment", "game/net/server", "game/net",
      "game/replication", "game/control", "game/model", "game/physics", "rti",
      "game/physics/flight"}},
    {"loadgen/run",
     {"loadgen/run", "loadgen/measure", "loadgen/mobility", "loadgen/experiment", "game/process",
      "game/players", "game/net/server", "game/net/client", "game/net", "game/net/peer",
      "game/peer", "game/match", "game/replication", "game/control", "game/model", "game/physics",
      "rti", "rti/transport", "rti/transport/modelled"}},
    {"loadgen/dds",
     {"loadgen/dds", "loadgen/run", "game/net/server", "game/net", "game/replication",
      "game/control", "game/model", "game/physics", "im"}},
    {"loadgen/duel",
     {"loadgen/duel", "loadgen/run", "game/players", "game/net/server", "game/net/client",
      "game/net", "game/match", "game/replication", "game/control", "game/model", "game/physics",
      "rti", "rti/transport", "rti/transport/modelled"}},
    {"loadgen/report",
     {"loadgen/report", "loadgen/run", "loadgen/measure", "loadgen/mobility", "loadgen/experiment",
      "game/process", "game/version", "game/model"}},
    {"loadgen/apps", {"loadgen/apps",       "game/apps",        "game/process",
                      "loadgen/experiment", "loadgen/run",      "loadgen/measure",
                      "loadgen/report",     "loadgen/duel",     "loadgen/dds",
                      "game/players",       "game/net/server",  "game/net/client",
                      "game/net",           "game/net/peer",    "game/peer",
                      "game/match",         "game/replication", "game/control",
                      "game/model",         "game/physics",     "rti",
                      "rti/transport"}},
};

/// Folders that a layer is divided into for whoever looks for a file; those of the RTI but for its
/// transports are all of this kind.
const Names divisions{"im/matching/index",
                      "rti/transport/tcp",
                      "rti/transport/udp",
                      "rti/transport/shared_memory",
                      "rti/transport/staged",
                      "game/net/server/players",
                      "game/peer/session",
                      "game/peer/standby",
                      "game/replication/exact",
                      "game/peer/window",
                      "game/apps/rti",
                      "game/net/server/overload",
                      "game/net/peer/network",
                      "game/net/peer/ranks",
                      "game/net/peer/interest",
                      "game/node/match",
                      "game/physics/rounding",
                      "game/node/recovery",
                      "game/physics/halves",
                      "game/view/feel",
                      "game/view/overlays",
                      "game/view/render/shaders",
                      "game/view/window",
                      "game/view/film",
                      "game/net/discovery",
                      "rti/transport/multicast",
                      "loadgen/run/bots",
                      "loadgen/run/nodes",
                      "loadgen/run/peers",
                      "loadgen/run/saturation",
                      "loadgen/measure/statistics",
                      "loadgen/measure/tables",
                      "loadgen/measure/truth",
                      "loadgen/report/sections",
                      "loadgen/report/plots"};

const Names network_headers{"asio",    "sys/socket.h", "netinet/", "arpa/inet.h",
                            "netdb.h", "sys/epoll.h",  "mpi.h"};
const Names clock_headers{"chrono", "ctime", "time.h"};
const Names file_headers{"cstdio", "stdio.h",    "fstream",    "iostream", "ostream", "istream",
                         "ios",    "syncstream", "filesystem", "dirent.h", "fcntl.h", "spdlog"};
const Names system_headers{"unistd.h", "sys/",    "poll.h",  "csignal",
                           "signal.h", "dlfcn.h", "sched.h", "random"};
const Names thread_headers{"thread",    "future", "mutex",   "shared_mutex", "condition_variable",
                           "semaphore", "latch",  "barrier", "stop_token",   "pthread.h"};

/// Both advise the kernel to use large pages, which changes nothing but speed.
const std::map<std::string, std::string> exceptions{{"im/matching/buffer.cpp", "sys/mman.h"},
                                                    {"game/physics/large_pages.h", "sys/mman.h"}};

/// The load generator watches processes and instants, so it owns clocks as commands do, and what
/// commands have in common does. A transport
/// measures how long its poll waits for its sockets.
bool may_read_clocks(const SourceFile& source) {
  return source.is_command() || source.is_in("game/apps") || source.is_in("loadgen") ||
         source.is_in("bench") || source.is_in("tests") || source.is_in("rti/transport") ||
         source.is_in("rti/standard");
}

/// Whether `line` names a clock, be it for an alias, or calls one that has no type.
bool names_a_clock(const std::string& line) {
  static const std::regex clock(
      R"(\b(steady|system|high_resolution|file|utc|tai|gps)_clock\b|\b(clock_gettime|gettimeofday|timespec_get|ftime|__rdtscp?)\b|\bstd::(time|clock)\s*\(|\btime\s*\((0|NULL|nullptr)\))");
  return std::regex_search(line, clock);
}

struct Include {
  std::string path;
  bool is_ours;  // in quotes
};

std::optional<Include> included(const std::string& line) {
  static const std::regex pattern(R"(^\s*#\s*include\s*(["<])([^">]+)[">])");
  std::smatch match;
  if (!std::regex_search(line, match, pattern)) return std::nullopt;
  return Include{match[2], match[1] == "\""};
}

std::string folder_of(const std::string& path) {
  const auto slash = path.find_last_of('/');
  return slash == std::string::npos ? "" : path.substr(0, slash);
}

/// The folder that layers know `path` by.
std::string part_of(const std::string& path) {
  const std::string folder = folder_of(path);
  if (folder.starts_with("rti/standard")) return "rti/standard";
  if (folder.starts_with("rti/") && !folder.starts_with("rti/transport")) return "rti";
  return std::ranges::find(divisions, folder) == divisions.end() ? folder : folder_of(folder);
}

const Layer* layer_of(const SourceFile& source) {
  for (const Layer& layer : layers)
    if (source.is_in(layer.folder)) return &layer;
  return nullptr;
}

std::string joined(const Names& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

std::string component_of(const std::string& path) { return path.substr(0, path.rfind('.')); }

/// Who includes whom, by names that `name_of` makes of paths.
using Graph = std::map<std::string, std::set<std::string>>;

template <class NameOf>
Graph includes_between(const std::vector<SourceFile>& sources, const NameOf& name_of) {
  Graph graph;
  for (const SourceFile& source : sources)
    for (const std::string& line : source.lines)
      if (const auto include = included(line);
          include && include->is_ours && name_of(include->path) != name_of(source.path))
        graph[name_of(source.path)].insert(name_of(include->path));
  return graph;
}

/// The first circle of `graph`, its first name again at the end; empty if there is none.
Names circle_in(const Graph& graph) {
  std::set<std::string> finished;
  Names way;
  const auto visit = [&](const auto& self, const std::string& name) -> bool {
    if (finished.contains(name)) return false;
    const bool is_circle = std::ranges::find(way, name) != way.end();
    way.push_back(name);
    if (is_circle) return way.erase(way.begin(), std::ranges::find(way, name)), true;
    if (const auto known = graph.find(name); known != graph.end())
      for (const std::string& next : known->second)
        if (self(self, next)) return true;
    way.pop_back();
    finished.insert(name);
    return false;
  };
  for (const auto& [name, ignored] : graph)
    if (visit(visit, name)) return way;
  return {};
}

bool starts_with_any(const std::string& path, const Names& prefixes) {
  return std::ranges::any_of(prefixes, [&](const std::string& prefix) {
    return path == prefix || path.starts_with(prefix + ".") || path.starts_with(prefix + "/") ||
           (prefix.ends_with('/') && path.starts_with(prefix));
  });
}

bool is_impure(const std::string& header) {
  return std::ranges::any_of(
      std::array{&network_headers, &clock_headers, &file_headers, &system_headers, &thread_headers},
      [&](const Names* names) { return starts_with_any(header, *names); });
}

/// What `layer` may include from `source`: commands say which version they are, those of the game
/// choose a transport.
Names allowed(const Layer& layer, const SourceFile& source) {
  Names names = layer.may_know;
  names.push_back("im/basics");  // which knows nobody
  if (source.is_command()) names.push_back("game/version");
  if (source.is_command() && source.is_in("game")) names.push_back("rti/transport");
  return names;
}

template <class Judge>
void for_each_include(const Judge& judge) {
  for (const SourceFile& source : read_sources(code_folders, code_extensions))
    for (std::size_t i = 0; i < source.lines.size(); ++i)
      if (const auto include = included(source.lines[i])) judge(source, i, *include);
}

TEST(Layers, EachFolderIncludesOnlyWhatItMayKnow) {
  for_each_include([](const SourceFile& source, std::size_t line, const Include& include) {
    const Layer* layer = layer_of(source);
    if (layer == nullptr || !include.is_ours) return;
    const Names names = allowed(*layer, source);
    if (std::ranges::find(names, part_of(include.path)) == names.end())
      report(source, line,
             "\"" + include.path + "\" is not for " + layer->folder +
                 ", which may include from: " + joined(names));
  });
}

TEST(Layers, EveryFolderWithCodeHasItsLayer) {
  for (const SourceFile& source : read_sources({"im", "game", "rti", "loadgen"}, code_extensions)) {
    const Layer* layer = layer_of(source);
    if (layer == nullptr)
      report(source, 0, "its folder is in no layer; add it to tests/house/layers_test.cpp");
    else if (part_of(source.path) != layer->folder)
      report(source, 0, "folders below " + layer->folder + " need a layer of their own");
  }
}

TEST(Layers, PureFoldersDoNoInputOrOutputAndReadNoClock) {
  for_each_include([](const SourceFile& source, std::size_t line, const Include& include) {
    if (!source.is_in("im") && !source.is_in("game/physics") && !source.is_in("game/peer")) return;
    if (const auto known = exceptions.find(source.path);
        known != exceptions.end() && include.path == known->second)
      return;
    if (is_impure(include.path))
      report(source, line,
             "<" + include.path +
                 "> in a pure folder: im, game/physics and game/peer are handed time, seeds and "
                 "bytes, they do no input or output");
  });
}

TEST(Layers, OnlyTransportsOwnSockets) {
  for_each_include([](const SourceFile& source, std::size_t line, const Include& include) {
    if (source.is_in("rti/transport") || source.is_in("bench") || source.is_in("tests")) return;
    // Owns none: it counts what passes through those of another engine's library.
    if (source.path == "loadgen/dds/socket_taps.cpp") return;
    if (starts_with_any(include.path, network_headers))
      report(source, line,
             "<" + include.path + "> outside rti/transport, the only code that owns sockets");
  });
}

TEST(Layers, OnlyCommandsReadClocks) {
  for (const SourceFile& source : read_sources(code_folders, code_extensions))
    for (std::size_t i = 0; i < source.lines.size(); ++i)
      if (!may_read_clocks(source) && names_a_clock(source.lines[i]))
        report(source, i,
               "names a clock; only *_main.cpp, rti/transport, loadgen, bench and tests may, all "
               "others are handed time");
}

TEST(Layers, NoFileIncludesItselfThroughOthers) {
  EXPECT_EQ(joined(circle_in(includes_between(read_sources(code_folders, code_extensions),
                                              [](const std::string& path) { return path; }))),
            "");
}

TEST(Layers, HeadersWithTheirSourcesFormNoCircle) {
  const std::vector<SourceFile> sources =
      read_sources({"im", "rti", "game", "loadgen"}, code_extensions);
  EXPECT_EQ(joined(circle_in(includes_between(sources, component_of))), "");
}

TEST(LayersThemselves, SeeAClockBehindAnAliasToo) {
  for (const char* line :
       {"using Clock = std::chrono::steady_clock;", "auto now = std::chrono::system_clock::now();",
        "  namespace c = std::chrono; c::steady_clock t;", "clock_gettime(CLOCK_MONOTONIC, &now);",
        "std::time(nullptr)", "seed(time(0));", "std::clock()"})
    EXPECT_TRUE(names_a_clock(line)) << line;
  for (const char* line : {"double time(const Body& body);", "server_clock.advance(now_s);",
                           "Real World::now() const", "body.time(0.5)"})
    EXPECT_FALSE(names_a_clock(line)) << line;
}

TEST(LayersThemselves, KnowWhatIsImpure) {
  for (const char* header : {"unistd.h", "sys/mman.h", "poll.h", "cstdio", "stdio.h", "mutex",
                             "chrono", "asio.hpp", "sys/socket.h", "spdlog/spdlog.h"})
    EXPECT_TRUE(is_impure(header)) << header;
  for (const char* header :
       {"cmath", "vector", "immintrin.h", "Eigen/Core", "charconv", "system_error"})
    EXPECT_FALSE(is_impure(header)) << header;
}

TEST(LayersThemselves, SeeCirclesOfAnyLength) {
  EXPECT_EQ(joined(circle_in({{"a", {"b", "c"}}, {"b", {"c"}}, {"c", {"d"}}})), "");
  EXPECT_EQ(joined(circle_in({{"a", {"b"}}, {"b", {"a"}}})), "a, b, a");
  EXPECT_EQ(joined(circle_in({{"a", {"b"}}, {"b", {"c"}}, {"c", {"d"}}, {"d", {"b"}}})),
            "b, c, d, b");
}

TEST(LayersThemselves, MissAFolderThatIsGone) {
  EXPECT_NONFATAL_FAILURE(read_sources({"im/nowhere"}, code_extensions),
                          "there is no folder im/nowhere to judge");
}

}  // namespace
}  // namespace rink::house
