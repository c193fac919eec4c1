// Rink's object model, read once for all tests of a program.
#pragma once

#include "game/net/fom_file.h"
#include "game/replication/object_model.h"
#include "game/replication/trajectory_codec.h"

namespace rink::game {

inline const rti::Fom& rink_fom() {
  static const rti::Fom fom = load_rink_fom(fom_file());
  return fom;
}
inline const ObjectModel& rink_model() {
  static const ObjectModel model(rink_fom());
  return model;
}

}  // namespace rink::game
