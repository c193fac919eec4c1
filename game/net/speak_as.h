// How a networked command says its troubles. Apart from the flags, for spdlog's headers take the
// compiler longer than all else that a command includes.
#pragma once

#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

#include <string>

namespace rink::game {

/// Troubles go to the standard error as "command: trouble"; spdlog's own choice would mix them with
/// the report on the standard output.
inline void speak_as(const std::string& command) {
  spdlog::set_default_logger(spdlog::stderr_color_mt(command));
  spdlog::set_pattern("%n: %v");
}

}  // namespace rink::game
