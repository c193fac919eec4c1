// The exception that ends a peer's session early.
#pragma once

#include <stdexcept>
#include <string>

#include "game/net/exit_status.h"

namespace rink::game {

/// The reason why a peer's session ends early.
class SessionError : public std::runtime_error {
 public:
  SessionError(ExitStatus status, const std::string& what)
      : std::runtime_error(what), status_(status) {}
  ExitStatus status() const { return status_; }

 private:
  ExitStatus status_;
};

}  // namespace rink::game
