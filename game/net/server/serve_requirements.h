// Completes and checks the flags of rink serve before anything is opened.
#pragma once

#include <string>

#include "game/model/scene.h"
#include "game/net/server/serve_options.h"
#include "rti/federation_execution.h"
#include "rti/federation_file.h"

namespace rink::game {

/// The federation file of the options, or a default if there is none; takes from it the address,
/// the members and the number of clients to wait for. Throws rti::FileError, or std::runtime_error
/// if the flags contradict it.
rti::FederationFile follow_federation_file(ServeOptions& options);

/// Settings of the options' federation of this name; `worker`, if any, takes half of its matches.
rti::FederationSettings federation_of(const ServeOptions& options, const Scene& scene,
                                      const std::string& federation, im::Worker* worker);

/// Whether clients have to be told of every tick, none of which may be left out.
bool needs_every_tick(const ServeOptions& options);

/// Throws std::runtime_error if the options cannot be satisfied, or a file for results cannot be
/// written.
void require_room(const ServeOptions& options, const Scene& scene);

}  // namespace rink::game
