// The preset of the match, and Rink's object model, for tests.
#pragma once

#include "game/model/scene_file.h"
#include "game/replication/trajectory_codec.h"

namespace rink::game {

inline std::string match_text() { return scene_text(RINK_SOURCE_DIR "/scenes/match.toml"); }
inline Scene match_scene() { return parse_scene(match_text(), "match.toml"); }
inline const rti::Fom& rink_fom() {
  static const rti::Fom fom = load_rink_fom(RINK_SOURCE_DIR "/game/net/rink.fom.xml");
  return fom;
}

}  // namespace rink::game
