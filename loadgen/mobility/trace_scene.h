// Scenes whose bats are the agents of a mobility trace (docs/scenes.md, "Traces").
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "game/model/scene.h"
#include "game/net/scene_choice.h"
#include "loadgen/mobility/mobility_trace.h"

namespace rink::loadgen {

/// A scene, and what moves its bats if that is a trace: agent k is bat k. The trace counts time
/// from the run's beginning and places from the corner of the field. First come the agents who are
/// there at the beginning, those who stay longest before others.
struct PlayedScene {
  game::Scene scene;
  std::optional<MobilityTrace> trace;

  /// The agents that are there from the beginning to `until_s` [s]; they are the first.
  std::uint32_t staying_until(double until_s) const;
};

/// The scene that `choice` names. A model heeds the choice's seed and numbers of bats as a crowd
/// does; a trace of a file has none to choose. Throws game::SceneError.
PlayedScene played_scene(const game::SceneChoice& choice);

/// The file of the trace that `scene` names, or nothing if it is none of a file.
std::optional<std::filesystem::path> trace_file_of(const std::string& scene);

/// Name of the copy of the trace `file` in a report folder. A scene prefers such a file beside it
/// to the one that it names, so that a copied report is complete.
std::string kept_trace_name(const std::filesystem::path& file);

}  // namespace rink::loadgen
