// The two roles over Cyclone DDS, from options to reports.
#include <nlohmann/json.hpp>

#include "game/control/key_log_file.h"
#include "game/net/interrupt.h"
#include "game/net/record_file.h"
#include "loadgen/dds/dds_crowd.h"
#include "loadgen/dds/dds_engine.h"
#include "loadgen/dds/dds_server.h"

namespace rink::loadgen {

namespace {

game::ServedGame game_of(const DdsServeOptions& options) {
  game::ServeOptions served;
  served.scene = options.scene, served.keys = options.keys, served.from_state = options.from_state;
  served.bats = options.bats, served.bat_count = options.bat_count;
  served.puck_count = options.puck_count, served.seed = options.seed;
  game::ServedGame played = game::served_game(served);
  if (!played.replay) played.replay.emplace();
  return played;
}

}  // namespace

DdsEnding serve_by_dds(const DdsServeOptions& options, const DdsClock& now_s,
                       const std::function<void(std::uint32_t)>& listening) {
  game::require_writable("--report", options.report);
  game::require_writable("--evidence", options.trace);
  game::ServedGame played = game_of(options);
  const std::size_t bats = played.scene.bodies.bats.size();
  if (bats < options.clients)
    throw game::SceneError("--clients: " + std::to_string(options.clients) + " for the " +
                           std::to_string(bats) + " bats of the scene");
  DdsServer server(options, played, now_s);
  listening(server.domain());
  DdsEnding ending;
  if (server.gather()) server.run();
  else if (!game::is_interrupted)
    ending = {std::to_string(server.ready()) + " of " + std::to_string(options.clients) +
                  " bots came within " + std::to_string(static_cast<int>(options.patience_s)) +
                  " s",
              true};
  const std::string why_invalid = game::is_interrupted ? "interrupted" : ending.error;
  if (!options.report.empty()) game::write_file(options.report, server.report(why_invalid).dump(2));
  if (!options.trace.empty() && why_invalid.empty())
    game::write_trace(options.trace, server.trace());
  return ending;
}

DdsEnding play_by_dds(const DdsBotsOptions& options, const DdsClock& now_s) {
  game::require_writable("--report", options.report);
  game::require_writable("--evidence", options.trace);
  std::vector<game::InputEvent> plan;
  if (!options.plan.empty()) {
    const game::KeyLog log = game::read_key_log(options.plan);
    game::require_keys_alone(log, options.plan, "a crowd of bots");
    plan = log.events;
  }
  DdsCrowd crowd(options, plan, now_s);
  const double give_up_s = now_s() + options.patience_s;
  while (!game::is_interrupted && !crowd.is_over() && (crowd.has_started() || now_s() < give_up_s))
    crowd.run_once();
  crowd.end();
  DdsEnding ending;
  if (crowd.is_left()) ending.error = "the server left the domain";
  else if (!crowd.has_started() && !game::is_interrupted)
    ending = {"nobody began a game in domain " + std::to_string(options.domain) + " within " +
                  std::to_string(static_cast<int>(options.patience_s)) + " s",
              true};
  const std::string why_invalid = game::is_interrupted ? "interrupted" : ending.error;
  if (!options.report.empty()) game::write_file(options.report, crowd.report(why_invalid).dump(2));
  if (!options.trace.empty() && why_invalid.empty())
    game::write_trace(options.trace, crowd.trace());
  return ending;
}

}  // namespace rink::loadgen
