// Reads what a federate may send in time-stamp order.
#pragma once

#include <cstdint>

#include "rti/federation/federation_basis.h"
#include "rti/federation/services/known_objects.h"
#include "rti/federation/services/publications.h"
#include "rti/federation/status.h"
#include "rti/federation/time/timed_messages.h"
#include "rti/ownership/ownership.h"

namespace rink::rti {

/// Reads the update, interaction or deletion in such a message, and checks that its sender may send
/// it.
class TimedContentReader {
 public:
  TimedContentReader(const FederationBasis& basis, const Publications& publications,
                     const Ownership& ownership, KnownObjects& known)
      : basis_(basis), publications_(publications), ownership_(ownership), known_(known) {}

  /// Marks an object as leaving when its deletion was read.
  Status read(std::uint32_t slot, Bytes content, StampedMessage& message);

 private:
  Status read_update(std::uint32_t slot, Reader& content, StampedMessage& message);
  Status read_interaction(std::uint32_t slot, Reader& content, StampedMessage& message);
  Status read_deletion(std::uint32_t slot, Reader& content, StampedMessage& message);

  FederationBasis basis_;
  const Publications& publications_;
  const Ownership& ownership_;
  KnownObjects& known_;
};

}  // namespace rink::rti
