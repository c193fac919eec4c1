// The exception that ends a peer's session early.
#pragma once

#include <exception>
#include <optional>
#include <stdexcept>
#include <string>

#include "game/net/exit_status.h"
#include "game/peer/protocol.h"

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

/// The exit status for what ends a session early; nothing for any other error.
inline std::optional<ExitStatus> session_status(const std::exception& error) {
  if (const auto* session = dynamic_cast<const SessionError*>(&error)) return session->status();
  if (dynamic_cast<const peer::Halt*>(&error) != nullptr) return ExitStatus::connection_lost;
  if (dynamic_cast<const peer::ProtocolError*>(&error) != nullptr) return ExitStatus::failed;
  return std::nullopt;
}

}  // namespace rink::game
