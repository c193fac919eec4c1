// Who may know whom: fails when a folder includes what the layout forbids it to know.
#include <map>
#include <optional>

#include "tests/house/source_tree.h"

namespace rink::house {
namespace {

using Names = std::vector<std::string>;

/// A folder's code and the project's folders (without those below them) that it may include.
struct Layer {
  std::string folder;
  Names may_know;
};

/// The most specific folder stands before those that contain it. bench and tests may include anything.
const std::vector<Layer> layers{
    {"im/matching", {"im/matching", "im"}},
    {"im/view", {"im/view", "im", "im/matching"}},
    {"im/composition", {"im/composition", "im/stages", "im", "im/matching"}},
    {"im/stages", {"im/stages", "im/composition", "im", "im/matching"}},
    {"im", {"im", "im/matching", "im/composition"}},
    {"rti/transport/mpi", {"rti/transport/mpi", "rti/transport"}},
    {"rti/transport", {"rti/transport", "rti", "im"}},
    {"rti", {"rti", "im"}},
    {"game/physics/collision", {"game/physics/collision", "game/physics"}},
    {"game/physics/paper", {"game/physics/paper", "game/physics/collision", "game/physics"}},
    {"game/physics", {"game/physics", "game/physics/paper"}},
    {"game/version", {"game/version"}},
    {"game/model", {"game/model", "game/physics"}},
    {"game/peer", {"game/peer", "game/physics"}},
    {"game/control", {"game/control", "game/players", "game/model", "game/physics"}},
    {"game/match", {"game/match", "game/control", "game/players", "game/model", "game/physics"}},
    {"game/players", {"game/players", "game/model", "game/physics"}},
    {"game/replication", {"game/replication", "game/control", "game/model", "game/physics", "rti", "im"}},
    {"game/net/peer", {"game/net/peer", "game/net", "game/match", "game/peer", "game/replication", "game/control", "game/players", "game/model", "game/physics", "rti", "rti/transport", "rti/transport/mpi", "im"}},
    {"game/net", {"game/net", "game/match", "game/replication", "game/control", "game/model", "game/physics", "rti", "rti/transport"}},
    {"game/view/render", {"game/view/render"}},
    {"game/view", {"game/view", "game/view/render", "game/match", "game/net", "game/net/peer", "game/replication", "game/control", "game/model", "game/physics", "rti"}},
    {"loadgen/duel", {"loadgen/duel", "loadgen", "game/players", "game/net", "game/match", "game/replication", "game/control", "game/model", "game/physics", "rti", "rti/transport"}},
    {"loadgen/truth", {"loadgen/truth", "loadgen", "game/net", "game/control", "game/model", "game/physics"}},
    {"loadgen/report", {"loadgen/report", "loadgen"}},
    {"loadgen", {"loadgen", "game/version", "loadgen/truth", "loadgen/report", "loadgen/duel", "game/players", "game/net", "game/net/peer", "game/peer", "game/match", "game/replication", "game/control", "game/model", "game/physics", "rti", "rti/transport"}},
};

const Names network_headers{"asio", "sys/socket.h", "netinet/", "arpa/inet.h", "netdb.h", "sys/epoll.h", "mpi.h"};
const Names impure_headers{"chrono", "thread", "fstream", "iostream", "filesystem", "ctime", "time.h", "sys/time.h", "future", "random", "spdlog"};

/// The load generator watches processes and instants, so it owns clocks as commands do.
bool may_read_clocks(const SourceFile& source) {
  return source.is_command() || source.is_in("loadgen") || source.is_in("bench") || source.is_in("tests");
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

/// The folder that layers know `path` by: the RTI's parts are folders of one layer, but for its transports.
std::string part_of(const std::string& path) {
  const std::string folder = folder_of(path);
  return folder.starts_with("rti/") && !folder.starts_with("rti/transport") ? "rti" : folder;
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

bool starts_with_any(const std::string& path, const Names& prefixes) {
  return std::ranges::any_of(prefixes, [&](const std::string& prefix) {
    return path == prefix || path.starts_with(prefix + ".") || path.starts_with(prefix + "/") || (prefix.ends_with('/') && path.starts_with(prefix));
  });
}

/// What `layer` may include from `source`: commands say which version they are, those of the game choose a transport.
Names allowed(const Layer& layer, const SourceFile& source) {
  Names names = layer.may_know;
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
      report(source, line, "\"" + include.path + "\" is not for " + layer->folder + ", which may include from: " + joined(names));
  });
}

TEST(Layers, EveryFolderWithCodeHasItsLayer) {
  for (const SourceFile& source : read_sources({"im", "game", "rti", "loadgen"}, code_extensions)) {
    const Layer* layer = layer_of(source);
    if (layer == nullptr) report(source, 0, "its folder is in no layer; add it to tests/house/layers_test.cpp");
    else if (part_of(source.path) != layer->folder) report(source, 0, "folders below " + layer->folder + " need a layer of their own");
  }
}

TEST(Layers, PureFoldersDoNoInputOrOutputAndReadNoClock) {
  for_each_include([](const SourceFile& source, std::size_t line, const Include& include) {
    if (!source.is_in("im") && !source.is_in("game/physics") && !source.is_in("game/peer")) return;
    if (starts_with_any(include.path, impure_headers) || starts_with_any(include.path, network_headers))
      report(source, line, "<" + include.path + "> in a pure folder: im, game/physics and game/peer are handed time, seeds and bytes, they do no input or output");
  });
}

TEST(Layers, OnlyTransportsOwnSockets) {
  for_each_include([](const SourceFile& source, std::size_t line, const Include& include) {
    if (source.is_in("rti/transport") || source.is_in("bench") || source.is_in("tests")) return;
    if (starts_with_any(include.path, network_headers)) report(source, line, "<" + include.path + "> outside rti/transport, the only code that owns sockets");
  });
}

TEST(Layers, OnlyCommandsReadClocks) {
  static const std::regex clock(R"(\b(steady|system|high_resolution)_clock::now\b|\bclock_gettime\b|\bgettimeofday\b|\bstd::time\()");
  for (const SourceFile& source : read_sources(code_folders, code_extensions))
    for (std::size_t i = 0; i < source.lines.size(); ++i)
      if (!may_read_clocks(source) && std::regex_search(source.lines[i], clock))
        report(source, i, "reads a clock; only *_main.cpp, loadgen, bench and tests may, all others are handed time");
}

}  // namespace
}  // namespace rink::house
