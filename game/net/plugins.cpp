// Loads with dlopen, and tries a plugin in a child before the process asks it anything.
#include "game/net/plugins.h"

#include <dlfcn.h>
#include <fcntl.h>
#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cmath>
#include <csignal>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <limits>
#include <string_view>

namespace rink::game {
namespace {

struct Loaded {
  std::vector<const rink_plugin*> plugins;
  std::vector<std::string> files;
};
Loaded& loaded() {
  static Loaded all;
  return all;
}

constexpr int trial_limit_ms = 10'000;
constexpr const char* nothing_found = "sound";

[[noreturn]] void refuse(const std::string& file, const std::string& what) {
  throw PluginError(file + ": " + what);
}

/// Parties near each other and far, at rest and moving, with and without roles.
std::vector<rink_party> trial_parties(std::uint32_t count, double spread) {
  std::vector<rink_party> parties;
  std::uint64_t state = 0x9e3779b97f4a7c15u;
  const auto draw = [&state] {
    state = state * 6364136223846793005u + 1442695040888963407u;
    return static_cast<double>(state >> 11) * 0x1p-53;
  };
  for (std::uint32_t id = 0; id < count; ++id) {
    const double x = spread * draw(), y = spread * draw(),
                 half = id % 3 == 0 ? 0.0 : spread * draw();
    rink_party party{};
    party.low_x = x - half, party.low_y = y - half, party.high_x = x + half,
    party.high_y = y + half;
    party.x = x, party.y = y, party.id = id;
    if (id % 4 != 0) party.velocity_x = draw() - 0.5, party.velocity_y = draw() - 0.5;
    party.heading_x = party.velocity_x, party.heading_y = party.velocity_y;
    party.age = id % 5 == 0 ? std::numeric_limits<double>::infinity() : 10.0 * draw();
    party.team = id % 2 == 0 ? RINK_NONE : id % 3;
    party.owner = id % 7 == 0 ? id : RINK_NONE;
    party.kind = id % 4;
    party.is_always_relevant = id % 11 == 0 ? 1 : 0;
    parties.push_back(party);
  }
  return parties;
}

/// The child's side: writes its finding and ends without a word to anybody else.
[[noreturn]] void try_in_child(const rink_plugin& plugin, int finding) {
  // Whatever handlers this process has, the parent is to see of which signal the child dies.
  for (const int crash : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT}) std::signal(crash, SIG_DFL);
  const int nowhere = open("/dev/null", O_RDWR | O_CLOEXEC);
  if (nowhere >= 0) dup2(nowhere, 0), dup2(nowhere, 1), dup2(nowhere, 2);
  std::string what;
  try {
    what = try_out(plugin);
  } catch (const std::exception& error) {
    what = std::string("it throws: ") + error.what();
  } catch (...) {
    what = "it throws";
  }
  if (what.empty()) what = nothing_found;
  _exit(write(finding, what.data(), what.size()) == static_cast<ssize_t>(what.size()) ? 0 : 1);
}

/// What the trial finds, which `finding` tells until the child ends.
std::string found_by(pid_t child, int finding) {
  std::string what;
  std::array<char, 256> part;
  pollfd waiting{finding, POLLIN, 0};
  while (poll(&waiting, 1, trial_limit_ms) == 1) {
    const ssize_t count = read(finding, part.data(), part.size());
    if (count <= 0) break;
    what.append(part.data(), static_cast<std::size_t>(count));
  }
  const bool is_late = (waiting.revents & (POLLIN | POLLHUP)) == 0;
  if (is_late) kill(child, SIGKILL);
  int status = 0;
  waitpid(child, &status, 0);
  if (is_late) return "it did not answer within 10 s";
  if (WIFSIGNALED(status)) return std::string("it crashes: ") + strsignal(WTERMSIG(status));
  if (what.empty()) return "it ends the process that asks it";
  return what == nothing_found ? "" : what;
}

std::string found_apart(const rink_plugin& plugin) {
  std::array<int, 2> ends;
  if (pipe2(ends.data(), O_CLOEXEC) != 0) return std::string("no trial: ") + strerror(errno);
  const pid_t child = fork();
  if (child < 0) return std::string("no trial: ") + strerror(errno);
  if (child == 0) try_in_child(plugin, ends[1]);
  close(ends[1]);
  std::string what = found_by(child, ends[0]);
  close(ends[0]);
  return what;
}

}  // namespace

std::string objection_to(const rink_plugin* plugin) {
  if (plugin == nullptr) return "rink_plugin_describe returns nothing";
  if (plugin->version != RINK_PLUGIN_VERSION)
    return "it is of version " + std::to_string(plugin->version) +
           " of im/pairs/rink_plugin.h, expected " + std::to_string(RINK_PLUGIN_VERSION) +
           ": build it against this one";
  if (plugin->party_size != sizeof(rink_party))
    return "its rink_party has " + std::to_string(plugin->party_size) + " bytes, expected " +
           std::to_string(sizeof(rink_party));
  const std::string_view name = plugin->name == nullptr ? "" : plugin->name;
  const bool is_plain =
      name.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789_") == std::string_view::npos;
  if (name.empty() || name.size() > 32 || !is_plain || name.front() < 'a' || name.front() > 'z')
    return "its name is '" + std::string(name.substr(0, 40)) +
           "', expected small letters, digits and _, first a letter, at most 32";
  if (plugin->kind != RINK_PREDICATE && plugin->kind != RINK_SCORE)
    return "its kind is " + std::to_string(plugin->kind) +
           ", expected RINK_PREDICATE or RINK_SCORE";
  if ((plugin->uses & ~(RINK_USES_ROLES | RINK_USES_MOTION | RINK_USES_AGE)) != 0)
    return "it uses " + std::to_string(plugin->uses) + ", expected a sum of RINK_USES_...";
  return plugin->evaluate == nullptr ? "it has no function evaluate" : "";
}

std::string try_out(const rink_plugin& plugin) {
  constexpr std::uint32_t count = 24;
  const std::vector<rink_party> subscribers = trial_parties(count, 40.0),
                                entities = trial_parties(count + 1, 50.0);
  std::vector<rink_pair> pairs;
  for (std::uint32_t s = 0; s < count; ++s)
    for (std::uint32_t e = 0; e <= count; ++e) pairs.push_back({s, e});
  constexpr double rubbish = std::numeric_limits<double>::quiet_NaN();
  const auto ask = [&](const std::vector<rink_pair>& asked) {
    std::vector<double> results(asked.size() + 1, rubbish), slacks(asked.size() + 1, 0.0);
    const rink_pairs all{subscribers.data(), entities.data(), asked.data(), asked.size()};
    plugin.evaluate(&all, results.data(), slacks.data());
    results.insert(results.end(), slacks.begin(), slacks.end());
    return results;
  };
  const std::vector<double> results = ask(pairs);
  const std::size_t size = pairs.size();
  for (std::size_t i = 0; i < size; ++i) {
    const double result = results[i], slack = results[size + 1 + i];
    const std::string of = "for pair " + std::to_string(i) + " of the trial it returns ";
    if (!std::isfinite(result)) return of + std::to_string(result) + ", expected a finite number";
    if (plugin.kind == RINK_PREDICATE && result != 0.0 && result != 1.0)
      return of + std::to_string(result) + ", expected 0 or 1";
    if (!(slack >= 0.0)) return of + "a slack of " + std::to_string(slack) + ", expected 0 or more";
    if (slack > 0.0 && (plugin.uses != 0 || plugin.kind == RINK_SCORE))
      return of + "a slack, which only predicates have that use nothing beside regions";
  }
  if (!std::isnan(results[size]) || results.back() != 0.0) return "it writes beyond the last pair";
  std::vector<rink_pair> backwards(pairs.rbegin(), pairs.rend());
  const std::vector<double> again = ask(backwards);
  for (std::size_t i = 0; i < size; ++i) {
    const double alone = ask({pairs[i]})[0];
    if (again[size - 1 - i] != results[i] || alone != results[i])
      return "for pair " + std::to_string(i) +
             " of the trial its answer differs when asked again: expected a pure function";
  }
  return "";
}

void load_plugin(const std::string& file) {
  std::error_code error;
  const std::filesystem::path path = std::filesystem::absolute(file, error);
  if (error || !std::filesystem::is_regular_file(path, error))
    refuse(file, "there is no such file");
  void* const object = dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (object == nullptr) refuse(file, dlerror());
  // POSIX lets an object's address stand for a function.
  const auto describe =
      reinterpret_cast<const rink_plugin* (*)()>(dlsym(object, "rink_plugin_describe"));
  if (describe == nullptr)
    refuse(file, "it has no function rink_plugin_describe (im/pairs/rink_plugin.h)");
  const rink_plugin* const plugin = describe();
  std::string what = objection_to(plugin);
  if (what.empty()) what = found_apart(*plugin);
  if (!what.empty()) refuse(file, what);
  for (const rink_plugin* each : loaded().plugins)
    if (std::string_view(each->name) == plugin->name)
      refuse(file, std::string("a plugin called '") + plugin->name + "' is loaded already");
  loaded().plugins.push_back(plugin);
  loaded().files.push_back(path.string());
}

std::span<const rink_plugin* const> loaded_plugins() { return loaded().plugins; }
const std::vector<std::string>& plugin_files() { return loaded().files; }

}  // namespace rink::game
