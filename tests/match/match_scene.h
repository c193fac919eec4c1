// The match at the pace of the paper, of which figures are known, and the object model, for tests.
#pragma once

#include "game/model/scene_file.h"
#include "game/replication/trajectory_codec.h"
#include "tests/places.h"

namespace rink::game {

inline std::string match_text() { return scene_text(test::source_folder() + "/scenes/paper.toml"); }
inline Scene match_scene() { return parse_scene(match_text(), "paper.toml"); }
inline const rti::Fom& rink_fom() {
  static const rti::Fom fom = load_rink_fom(test::source_folder() + "/game/net/rink.fom.xml");
  return fom;
}

}  // namespace rink::game
