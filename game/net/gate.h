// What stands between a command's socket and its federates: a shared key and a rate limit, where
// flags ask for them.
#pragma once

#include <optional>
#include <string>

#include "rti/transport/guarded_transport.h"
#include "rti/transport/rate_limited_transport.h"
#include "rti/wire/federation_messages.h"
#include "rti/wire/membership_messages.h"

namespace rink::game {

struct GateSettings {
  std::string key_file{};  ///< empty: no key is asked for
  rti::Role role = rti::Role::rti;
  std::string federation = "rink";
  rti::RateLimit rate_limit{};
};

/// Nothing at all unless the settings ask for it. The rate counts from the socket on, so a stranger
/// is held to it too.
class Gate {
 public:
  /// `socket` must outlive it. Throws std::runtime_error, which names the key file, if it can't be
  /// read or is too short.
  Gate(rti::Transport& socket, const GateSettings& settings,
       const rti::GuardedTransport::Clock& now_s)
      : transport_(&socket) {
    if (settings.rate_limit.bytes_per_s > 0.0 || settings.rate_limit.frames_per_s > 0.0) {
      rti::RateLimit limit = settings.rate_limit;
      limit.last_words =
          rti::framed(rti::ExpelledMessage{rti::to_string(rti::CloseReason::too_fast)});
      transport_ = &limited_.emplace(*transport_, limit, now_s);
    }
    if (settings.key_file.empty()) return;
    key_ = rti::SharedKey::load(settings.key_file);
    transport_ = &guarded_.emplace(
        *transport_, *key_,
        rti::GuardSettings{.role = settings.role, .federation = settings.federation}, now_s);
  }
  Gate(const Gate&) = delete;
  Gate& operator=(const Gate&) = delete;
  rti::Transport& transport() { return *transport_; }

 private:
  rti::Transport* transport_;
  std::optional<rti::RateLimitedTransport> limited_;
  std::optional<rti::SharedKey> key_;
  std::optional<rti::GuardedTransport> guarded_;
};

}  // namespace rink::game
