// Who may join a federation execution, and who is notified when a federate comes or goes (IEEE
// 1516.1-2010, 4.9 and 4.10).
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

  /// Why it may not join; nothing if it may.
  std::optional<Objection> objection(const JoinMessage& message) const;
  /// It wants to be told of all who are there, who come and who go.
  Status handle_watch(std::uint32_t slot);
  void joined(std::uint32_t slot);
  /// While its handle and name are still known.
  void left(std::uint32_t slot, ResignReason reason);

 private:
  std::optional<Refusal> refusal(const JoinMessage& message) const;

  FederationBasis basis_;
};

}  // namespace rink::rti
