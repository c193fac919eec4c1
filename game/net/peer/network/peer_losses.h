// What becomes of the session when a peer is lost: it goes on without it, or ends with the first
// reason.
#pragma once

#include <optional>
#include <string>

#include "game/net/peer/network/peer_link.h"
#include "game/net/peer/network/session_error.h"

namespace rink::game {

class PeerLosses {
 public:
  /// From here on the game continues without a peer that is lost, if each part is replicated.
  void begin(bool is_replicated) { are_survived_ = is_replicated; }
  bool are_survived() const { return are_survived_; }

  /// The session cannot go on.
  void fail(ExitStatus status, const std::string& what) {
    if (!error_) error_.emplace(status, what);
  }
  /// The peer of `link` is gone, which its first loss says.
  void lose(PeerLink& link, ExitStatus status, const std::string& what) {
    if (!are_survived_) return fail(status, what);
    if (link.loss.empty()) link.loss = what;
  }
  /// Throws SessionError if the session cannot go on.
  void check() const {
    if (error_) throw SessionError(*error_);
  }

 private:
  bool are_survived_ = false;
  std::optional<SessionError> error_;
};

}  // namespace rink::game
