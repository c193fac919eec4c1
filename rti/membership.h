// Why a federate was refused, and how a federate left.
#pragma once

#include <cstdint>

#include "rti/hla_error.h"

namespace rink::rti {

/// Why a join failed; the numbers are those on the wire.
enum class Refusal : std::uint8_t {
  wrong_version = 1,    ///< the two ends speak different protocol versions
  wrong_fom,            ///< the two ends loaded object models that differ
  wrong_federation,     ///< no federation execution of that name here
  name_taken,           ///< a federate of that name has joined
  federation_full,      ///< the federation execution has its greatest number of federates
  bad_name,             ///< the federate's name is empty
  not_admitted,         ///< the RTI asks for a shared key, and got no proof of it
  not_listed,           ///< the federation's members are listed, and the federate is none of them
  save_in_progress,     ///< the federation is being saved
  restore_in_progress,  ///< the federation is being restored
};
/// A sentence for a user about what is wrong, or "unknown refusal".
const char* to_string(Refusal refusal);
/// The standard's name for it (4.9), to switch on: InconsistentFDD,
/// FederationExecutionDoesNotExist, FederateNameAlreadyInUse, IllegalName, Unauthorized;
/// RTIinternalError for what the standard does not know: another version, a federation that is
/// full.
HlaError error_of(Refusal refusal);

/// Why a synchronisation point was not registered; the numbers are those on the wire.
enum class SynchronizationFailure : std::uint8_t {
  label_not_unique = 1,  ///< a point of that label has not been reached yet
  member_not_joined,     ///< the set names a federate that is not joined
  over_limit,  ///< the federate has too many points that are registered and not reached yet; Rink's
               ///< own, for the standard knows no limit
};
/// The standard's words, "label not unique".
const char* to_string(SynchronizationFailure failure);

/// How a federate left.
enum class ResignReason : std::uint8_t {
  resigned,    ///< by its own request
  lost,        ///< its connection closed or fell silent
  misbehaved,  ///< it broke the protocol or used what it had not declared or did not own
};
const char* to_string(ResignReason reason);

}  // namespace rink::rti
