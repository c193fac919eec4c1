// Figures of a process and of its part of the game.
#include "game/apps/peer_report.h"

#include <sys/resource.h>

#include "game/control/key_log_file.h"
#include "game/net/scene_choice.h"
#include "im/basics/hexadecimal.h"

namespace rink::game {

double processor_s() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const auto seconds = [](const timeval& time) {
    return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

SharedGame game_of(const PeerOptions& options) {
  Scene scene = chosen_scene({.scene = options.scene,
                              .bats = options.bats,
                              .bat_count = options.bat_count,
                              .puck_count = options.puck_count,
                              .seed = options.seed});
  std::vector<InputEvent> recorded;
  if (!options.keys.empty()) {
    KeyLog log = read_key_log(std::filesystem::path(options.keys));
    require_fit(log, scene, options.keys);
    require_keys_alone(log, options.keys, "a game among peers");
    recorded = std::move(log.events);
  }
  return SharedGame(std::move(scene), recorded);
}

void add_hash(nlohmann::ordered_json& report, const PlayedPart& part) {
  report[report::hash.key] = hexadecimal(part.hash);
}

}  // namespace rink::game
