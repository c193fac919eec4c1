// Looks every name up once and checks the sizes that the encodings in attributes.h have.
#include "game/replication/object_model.h"

#include <string>

#include "game/replication/attributes.h"
#include "game/replication/trajectory.h"

namespace rink::game {
namespace {

[[noreturn]] void refuse(const rti::Fom& fom, const std::string& what) {
  throw rti::FileError("object model '" + fom.name() + "': " + what +
                       "; use the rink.fom.xml that comes with this version");
}

rti::ObjectClassHandle object_class(const rti::Fom& fom, const char* name) {
  const std::optional<rti::ObjectClassHandle> found = fom.object_class(name);
  if (!found) refuse(fom, std::string("has no object class '") + name + "'");
  return *found;
}

rti::InteractionClassHandle interaction_class(const rti::Fom& fom, const char* name) {
  const std::optional<rti::InteractionClassHandle> found = fom.interaction_class(name);
  if (!found) refuse(fom, std::string("has no interaction class '") + name + "'");
  return *found;
}

template <class Value>
rti::AttributeHandle attribute(const rti::Fom& fom, rti::ObjectClassHandle owner,
                               const char* name) {
  const std::string full = fom.at(owner).name + "." + name;
  const std::optional<rti::AttributeHandle> found = fom.attribute(owner, name);
  if (!found) refuse(fom, "has no attribute '" + full + "'");
  rti::Measurer measurer;
  Value value;
  exchange(measurer, value);
  if (fom.values_size(owner, {*found}) != measurer.size())
    refuse(fom,
           "attribute '" + full + "' is not " + std::to_string(measurer.size()) + " bytes long");
  return *found;
}

rti::AttributeHandle varying_attribute(const rti::Fom& fom, rti::ObjectClassHandle owner,
                                       const char* name) {
  const std::optional<rti::AttributeHandle> found = fom.attribute(owner, name);
  if (!found || fom.values_size(owner, {*found}))
    refuse(fom, "has no attribute '" + fom.at(owner).name + "." + name + "' whose size varies");
  return *found;
}

}  // namespace

ObjectModel::ObjectModel(const rti::Fom& fom)
    : entity(object_class(fom, "Entity")),
      score(object_class(fom, "Score")),
      field(object_class(fom, "Field")),
      match(object_class(fom, "Match")),
      shape(attribute<Shape>(fom, entity, "shape")),
      input(attribute<Input>(fom, entity, "input")),
      position(attribute<Position>(fom, entity, "position")),
      trajectory(attribute<Trajectory>(fom, entity, "trajectory")),
      snapshot(attribute<Snapshot>(fom, entity, "snapshot")),
      goals(attribute<Goals>(fom, score, "goals")),
      extent(attribute<Extent>(fom, field, "extent")),
      drag(attribute<Drag>(fom, field, "drag")),
      match_state(attribute<MatchState>(fom, match, "state")),
      match_scene(varying_attribute(fom, match, "scene")),
      match_tick(attribute<TickPeriod>(fom, match, "tick")),
      key_down(interaction_class(fom, "KeyDown")),
      key_up(interaction_class(fom, "KeyUp")),
      update(interaction_class(fom, "Update")),
      seat(interaction_class(fom, "Seat")),
      pause(interaction_class(fom, "Pause")),
      rematch(interaction_class(fom, "Rematch")),
      ping(interaction_class(fom, "Ping")),
      pong(interaction_class(fom, "Pong")),
      inspect(interaction_class(fom, "Inspect")),
      interest(interaction_class(fom, "Interest")),
      pace(interaction_class(fom, "Pace")),
      exact(varying_attribute(fom, entity, "exact")),
      push(interaction_class(fom, "Push")) {}

}  // namespace rink::game
