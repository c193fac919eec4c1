// The stages between a command's socket and its federates: limits of addresses and rates, and a
// shared key, where flags ask for them.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>

#include "rti/transport/staged/address_limit.h"
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
  std::optional<std::uint32_t> address_limit = 0;  ///< connections of one address; 0: any; nothing:
                                                   ///< the default, for other machines alone
};

/// Adds to `transport` the stages that the settings ask for. With a key the rate counts what was
/// opened, so that its last words are sealed, and at the socket twice as many bytes: what is sent
/// in records of a few bytes, or does not open, costs as well. Throws std::runtime_error, which
/// names the key file, if it can't be read, is too short or open to others. Returns `transport`.
inline rti::StagedTransport& add_gate(rti::StagedTransport& transport, const GateSettings& settings,
                                      const rti::TransportStage::Clock& now_s) {
  if (settings.address_limit != 0u) {
    rti::AddressLimitSettings limit{.most = settings.address_limit.value_or(0),
                                    .spares_loopback = !settings.address_limit};
    if (!settings.address_limit) limit.most = rti::address_limit_default();
    if (settings.key_file.empty())  // else nobody reads what is not sealed
      limit.last_words =
          rti::framed(rti::ExpelledMessage{rti::to_string(rti::CloseReason::too_many)});
    transport.add<rti::AddressLimit>(std::move(limit));
  }
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
