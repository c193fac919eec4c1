// What the flags of rink serve ask for, completed and checked before anything is opened.
#pragma once

#include <string>

#include "game/model/scene.h"
#include "game/net/server/serve_options.h"
#include "rti/federation_execution.h"
#include "rti/federation_file.h"

namespace rink::game {

/// The federation file of the options, or what stands for it where there is none; takes over where
/// to listen, who may join and for how many to wait. Throws rti::FileError, or std::runtime_error
/// if the flags contradict it.
rti::FederationFile follow_federation_file(ServeOptions& options);

/// How the options' federation, of this name, is run; `worker`, if any, takes half of its matches.
rti::FederationSettings federation_of(const ServeOptions& options, const Scene& scene,
                                      const std::string& federation, im::Worker* worker);

/// Throws std::runtime_error if nobody could ever satisfy the options, or a file for the results
/// could not be written when the run is over.
void require_room(const ServeOptions& options, const Scene& scene);

}  // namespace rink::game
