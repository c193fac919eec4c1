// The flag --plugin of the commands that run filters.
#pragma once

#include <string>
#include <vector>

#include "game/apps/flags.h"

namespace rink::game {

/// Files to be loaded by `load_plugin` (game/net/plugins.h) before a scheme is judged.
inline void add_plugin_option(Flags& flags, std::vector<std::string>& files) {
  flags
      .option("--plugin", files,
              "a shared object with a predicate or score, which schemes then name: when NAME, "
              "top(k=5) by NAME (docs/im.md); may be repeated")
      .check(existing_file())
      .repeats();
}

}  // namespace rink::game
