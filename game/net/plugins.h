// Shared objects with predicates and scores, loaded by the flag --plugin (docs/im.md, "Plugins").
#pragma once

#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "im/pairs/rink_plugin.h"

namespace rink::game {

/// Names the file, what is wrong and what was expected.
struct PluginError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Loads the shared object `file` and tries it. Throws PluginError if it cannot be loaded, is no
/// plugin or of another version, has the name of one that is loaded, or fails the trial: it must
/// return, without an exception or a signal, finite numbers (a predicate 0 or 1) that are the same
/// when asked again, one by one and in another order. The trial runs in a child process, so that
/// one that crashes or does not end within 10 s takes nothing with it. Loaded plugins stay for the
/// process, as the code of a shared object does.
void load_plugin(const std::string& file);

/// All that are loaded, and their files as they were named, in that order.
std::span<const rink_plugin* const> loaded_plugins();
const std::vector<std::string>& plugin_files();

/// What is wrong with what `plugin` says about itself; empty if nothing is.
std::string objection_to(const rink_plugin* plugin);

/// What is wrong with the answers of a plugin without such an objection; empty if nothing is. What
/// it throws passes through.
std::string try_out(const rink_plugin& plugin);

}  // namespace rink::game
