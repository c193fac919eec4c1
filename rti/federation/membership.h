// Decides which federates may join a federation execution, and notifies watchers when a federate
// joins or leaves (IEEE 1516.1-2010, 4.9 and 4.10).
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "rti/federate_ambassador.h"
#include "rti/federation/federation_basis.h"
#include "rti/federation/status.h"
#include "rti/wire/membership_messages.h"

namespace rink::rti {

class Membership {
 public:
  struct Objection {
    Refusal refusal;
    std::string why;
  };
  explicit Membership(const FederationBasis& basis) : basis_(basis) {}

  /// The reason why the federate may not join; nothing if it may.
  std::optional<Objection> objection(const JoinMessage& message) const;
  /// The federate asks for notices of all that are joined, that join and that leave.
  Status handle_watch(std::uint32_t slot);
  void joined(std::uint32_t slot);
  /// Call it while the federate's handle and name are still known.
  void left(std::uint32_t slot, ResignReason reason);

 private:
  std::optional<Refusal> refusal(const JoinMessage& message) const;

  FederationBasis basis_;
};

}  // namespace rink::rti
