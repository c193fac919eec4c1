// The stages between a command's socket and its federates: a shared key and a rate limit, where
// flags ask for them.
#pragma once

#include <string>

#include "rti/transport/staged/guard.h"
#include "rti/transport/staged/rate_limiter.h"
#include "rti/wire/federation_messages.h"
#include "rti/wire/membership_messages.h"

namespace rink::game {

struct GateSettings {
  std::string key_file{};  ///< empty: no key is required
  rti::Role role = rti::Role::rti;
  std::string federation = "rink";
  rti::RateLimit rate_limit{};
};

/// Adds to `transport` the stages that the settings ask for. With a key the rate counts what was
/// opened, so that its last words are sealed, and at the socket twice as many bytes: what is sent
/// in records of a few bytes, or does not open, costs as well. Throws std::runtime_error, which
/// names the key file, if it can't be read, is too short or open to others. Returns `transport`.
inline rti::StagedTransport& add_gate(rti::StagedTransport& transport, const GateSettings& settings,
                                      const rti::TransportStage::Clock& now_s) {
  if (!settings.key_file.empty()) {
    if (settings.rate_limit.bytes_per_s > 0.0)
      transport.add<rti::RateLimiter>(
          rti::RateLimit{.bytes_per_s = 2.0 * settings.rate_limit.bytes_per_s}, now_s);
    transport.add<rti::Guard>(
        rti::SharedKey::load(settings.key_file),
        rti::GuardSettings{.role = settings.role, .federation = settings.federation}, now_s);
  }
  if (settings.rate_limit.bytes_per_s > 0.0 || settings.rate_limit.frames_per_s > 0.0) {
    rti::RateLimit limit = settings.rate_limit;
    limit.last_words =
        rti::framed(rti::ExpelledMessage{rti::to_string(rti::CloseReason::too_fast)});
    transport.add<rti::RateLimiter>(limit, now_s);
  }
  return transport;
}

}  // namespace rink::game
