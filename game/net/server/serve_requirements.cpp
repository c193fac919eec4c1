// Checks flags; errors name the flag and what is allowed.
#include "game/net/server/serve_requirements.h"

#include <sstream>
#include <stdexcept>

#include "game/control/match_flow.h"
#include "game/control/replay.h"
#include "game/model/listed.h"
#include "game/model/scene_file.h"
#include "game/net/fom_file.h"
#include "game/net/record_file.h"
#include "game/net/server/serving.h"
#include "game/replication/attributes.h"
#include "game/replication/update_policy.h"

namespace rink::game {
namespace {

/// Throws if the options cannot host matches of `scene`.
void require_match(const ServeOptions& options, const Scene& scene) {
  if (const auto objection = match_objection(scene))
    throw std::runtime_error("scene '" + options.scene + "' cannot be hosted: " + *objection);
  if (scene_text(options.scene).size() > SceneText::size_max)
    throw std::runtime_error("scene '" + options.scene +
                             "' is too long a text to be sent to players");
  if (!options.keys.empty() || options.pace != "realtime" || options.is_time_managed)
    throw std::runtime_error(
        "a hosted match is played by its players in real time: --keys, --pace and "
        "--time-management cannot be given");
}

/// Throws if a scheme ignores the given cell size, since a sweep of it would compare equal runs.
void require_cells(const ServeOptions& options) {
  if (options.cell_size == 0.0 || im::takes_cell_size(options.scheme)) return;
  std::string having;
  for (const std::string& name : im::filter_names())
    if (im::takes_cell_size(name)) add_to_list(having, name);
  throw std::runtime_error("--cell-size: the scheme " + options.scheme +
                           " has no cells whose size it leaves open; schemes with cells are " +
                           having);
}

/// Throws if the scheme names a plugin that is not loaded.
void require_scheme(const ServeOptions& options, const Scene& scene) {
  const rti::FederationSettings settings =
      federation_settings(scene, options.scheme, options.cell_size);
  if (const auto complaint = im::complaint_about(options.scheme, settings.filter_settings))
    throw std::runtime_error("--scheme: " + *complaint);
}

/// Throws if a scheme ignores the kinds given as always relevant, since comparing them would
/// compare equal runs.
void require_always(const ServeOptions& options) {
  if (!options.always.empty() && !im::names_scheme(options.scheme, "always"))
    throw std::runtime_error("--always: the scheme " + options.scheme +
                             " does not name always; one that does is " + options.scheme +
                             " or always");
}

/// Throws if other options ask for what nodes do not do.
void require_node(const ServeOptions& options) {
  if (!is_node(options)) {
    if (!options.node_listen.empty())
      throw std::runtime_error("--node-listen: expected --nodes or --join beside it");
    return;
  }
  if (options.pace != "realtime" || options.is_time_managed || !options.keys.empty() ||
      !options.from_state.empty() || !options.trace.empty() || options.threads > 1)
    throw std::runtime_error(
        "--nodes, --join, --transport mpi: nodes play their clients' keys in real time from the "
        "scene's beginning: --pace synchronous, --time-management, --keys, --from-state, "
        "--evidence and --threads can't be given with them");
  if (options.is_rank && !options.hosted.empty())
    throw std::runtime_error("--transport mpi: expected no hosted match, which --nodes can play");
  if (!options.hosted.empty() && options.duration_s > 0.0)
    throw std::runtime_error(
        "--duration: nodes host matches until they are interrupted, and then say whether others "
        "may have gone on without them");
  if (options.join.empty() && options.hosted.empty() && options.duration_s == 0.0)
    throw std::runtime_error(
        "--nodes, --transport mpi: expected a --duration above 0, at which all end together");
}

/// Throws if other options ask for what clients that compute do not follow.
void require_exact(const ServeOptions& options, const Scene& scene) {
  if (options.policy != exact_policy) return;
  if (scene.rules.possession_s > 0.0)
    throw std::runtime_error("--policy exact: scene '" + options.scene +
                             "' has [match] possession_s, which clients do not compute");
  if (!options.hosted.empty() || is_node(options) || options.pace != "realtime" ||
      options.is_time_managed)
    throw std::runtime_error(
        "--policy exact: clients compute one game that goes on, of one server, in real time: a "
        "hosted match, --nodes, --join, --transport mpi, --pace synchronous and --time-management "
        "can't be given with it");
}

/// Throws if clients cannot be told less often than the game ticks.
void require_output_rate(const ServeOptions& options) {
  if (options.output_rate_hz == 0.0) return;
  if (options.output_rate_hz > options.rate_hz) {
    std::ostringstream text;
    text << "--output-rate: clients cannot be told " << options.output_rate_hz
         << " times a second of a game of --rate " << options.rate_hz
         << "; allowed is from 0.1 to that, and 0 for each tick";
    throw std::runtime_error(text.str());
  }
  if (needs_every_tick(options))
    throw std::runtime_error(
        "--output-rate: --policy exact, a hosted match, --nodes, --join, --transport mpi, --pace "
        "synchronous and --time-management need every tick to be told and can't be given with it");
}

/// Throws if other options need a game from the scene's beginning.
void require_beginning(const ServeOptions& options) {
  if (options.from_state.empty()) return;
  if (!options.hosted.empty() || options.pace != "realtime" || options.is_time_managed ||
      !options.record.empty())
    throw std::runtime_error(
        "--from-state: a hosted match, --pace synchronous, --time-management and --record begin "
        "with the scene and can't be given with it");
}

/// Throws if no match of this server alone can go on from a record.
void require_continued(const ServeOptions& options) {
  if (options.continued.empty() || (!options.hosted.empty() && !is_node(options))) return;
  throw std::runtime_error(
      "--continue: only a match that one server hosts goes on from a record: expected a scene to "
      "host, as in rink serve match, and no --nodes, --join or --transport mpi");
}

}  // namespace

bool needs_every_tick(const ServeOptions& options) {
  return options.policy == exact_policy || !options.hosted.empty() || is_node(options) ||
         options.pace != "realtime" || options.is_time_managed;
}

rti::FederationFile follow_federation_file(ServeOptions& options) {
  if (options.federation_file.empty())
    return {.federation = "rink", .fom = {fom_file()}, .nodes = {}};
  const rti::FederationFile file = rti::load_federation_file(options.federation_file);
  options.address = file.nodes.front().address;
  options.port = file.nodes.front().port;
  options.members = file.members();
  const auto count = static_cast<std::uint32_t>(options.members.size());
  if (count > 0 && options.clients > 0 && options.clients != count)
    throw std::runtime_error("--clients: " + std::to_string(options.clients) + " players, but '" +
                             options.federation_file + "' lists " + std::to_string(count) +
                             ", for which the server waits");
  if (count > 0) options.clients = count;
  return file;
}

rti::FederationSettings federation_of(const ServeOptions& options, const Scene& scene,
                                      const std::string& federation, im::Worker* worker) {
  rti::FederationSettings settings = federation_settings(scene, options.scheme, options.cell_size);
  settings.match_worker = worker;
  // Clients that wait for logical time would miss what is sent before they are taken in.
  if (options.pace == "synchronous" || options.is_time_managed)
    settings.newcomer_pairs_per_match_max = rti::FederationSettings{}.newcomer_pairs_per_match_max;
  settings.update_rate = update_rate_of(options.output_rate_hz, options.rate_hz);
  settings.federation = federation;
  settings.members = options.members;
  if (!settings.members.empty())
    settings.members.emplace_back("server");  // the server's own
                                              // federate
  return settings;
}

void require_room(const ServeOptions& options, const Scene& scene) {
  const Bodies& bodies = scene.bodies;
  if (options.clients > bodies.bats.size())
    throw std::runtime_error(
        "--clients: " + std::to_string(options.clients) + " players, but scene '" + options.scene +
        "' has " + std::to_string(bodies.bats.size()) + " bats; allowed is at most as many");
  const std::size_t body_count = count_of(bodies);
  if (body_count > served_bodies_max)
    throw std::runtime_error("scene '" + options.scene + "' has " + std::to_string(body_count) +
                             " bodies; allowed is at most " + std::to_string(served_bodies_max));
  require_scheme(options, scene);
  require_cells(options);
  require_always(options);
  require_beginning(options);
  require_continued(options);
  require_node(options);
  require_exact(options, scene);
  require_output_rate(options);
  if (options.spread > 0.0 && (options.pace != "realtime" || options.transport == "udp"))
    throw std::runtime_error(
        "--spread staggers writes to streams in real time: --pace synchronous and --transport "
        "udp or mpi can't be given with it");
  if (!options.trace.empty() && options.duration_s == 0.0)
    throw std::runtime_error(
        "--evidence: what is to be sampled is drawn beforehand; it needs a --duration above 0");
  require_writable("--report", options.report);
  if (options.hosted.empty()) require_writable("--record", options.record);
  else require_match(options, scene);
  require_writable("--evidence", options.trace);
}

}  // namespace rink::game
