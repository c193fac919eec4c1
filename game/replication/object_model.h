// The handles of Rink's object model, looked up by name once so that an incomplete model file is
// refused at the start.
#pragma once

#include "rti/fom/fom.h"
#include "rti/handles.h"

namespace rink::game {

/// Handles of every class, attribute and dimension that the game uses (game/net/rink.fom.xml).
struct ObjectModel {
  /// Throws rti::FileError naming the first class or attribute that `fom` lacks, or whose size
  /// differs from the game's.
  explicit ObjectModel(const rti::Fom& fom);

  rti::ObjectClassHandle entity, score, field, match;
  rti::AttributeHandle shape, input, position, trajectory, snapshot;  ///< of entity
  rti::AttributeHandle goals;                                         ///< of score
  rti::AttributeHandle extent, drag;                                  ///< of field
  rti::AttributeHandle match_state, match_scene, match_tick;          ///< of match
  rti::InteractionClassHandle key_down, key_up, update, seat;
  rti::InteractionClassHandle pause, rematch, ping, pong;  ///< of hosted matches
  rti::InteractionClassHandle inspect, interest;           ///< of watchers
  rti::InteractionClassHandle pace;  ///< of servers that wait for turns or keep logical time
  rti::AttributeHandle exact;        ///< of entity
  rti::InteractionClassHandle push;  ///< of hosted matches
};

}  // namespace rink::game
