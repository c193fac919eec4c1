// How a federate joins its federation execution and resigns, and who else is in it.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "rti/federate/ambassador_basis.h"
#include "rti/wire/membership_messages.h"
#include "rti/wire/state_stream.h"

namespace rink::rti {

/// The only part that changes the phase.
class JoinSession {
 public:
  JoinSession(const AmbassadorBasis& basis, JoinPhase& phase) : basis_(basis), phase_(phase) {}

  /// Throws FederateAlreadyExecutionMember.
  void join(std::string_view federation, std::string_view federate_name,
            std::string_view federate_type);
  void resign();
  void watch_federates();
  /// Throw NameNotFound.
  FederateHandle handle_of(std::string_view federate_name) const;
  const std::string& name_of(FederateHandle federate) const;

  /// The RTI has accepted the join.
  void joined(FederateHandle federate);
  /// The federation is restored, in which the federate has this handle.
  void restored(FederateHandle federate) { phase_.restored(federate); }
  template <class Stream>
  bool keep(Stream& stream) {
    return keep_all(stream, federates_);
  }
  bool handle_refused(Reader& reader);
  /// Handles the digest of the federation's model, which precedes a refusal.
  bool handle_fom_digest(Reader& reader);
  bool handle_federate_joined(Reader& reader);
  bool handle_federate_resigned(Reader& reader);

 private:
  AmbassadorBasis basis_;
  JoinPhase& phase_;
  std::string fom_difference_;  ///< from the federation's model, if the RTI sent its digest
  std::vector<std::pair<FederateHandle, std::string>> federates_;  ///< this federate first
};

}  // namespace rink::rti
