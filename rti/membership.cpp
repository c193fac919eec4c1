// The words for refusals and resignations.
#include "rti/membership.h"

namespace rink::rti {

const char* to_string(Refusal refusal) {
  switch (refusal) {
    case Refusal::wrong_version:
      return "the two ends speak different versions of the protocol: build both from one version "
             "of Rink";
    case Refusal::wrong_fom:
      return "the two ends have different object models: load the same FOM file at both";
    case Refusal::wrong_federation:
      return "no federation execution of that name here";
    case Refusal::name_taken:
      return "a federate of that name has already joined";
    case Refusal::federation_full:
      return "the federation execution has its greatest number of federates";
    case Refusal::bad_name:
      return "a federate needs a name";
    case Refusal::not_admitted:
      return "a shared key is asked for: give both ends the same key file";
    case Refusal::not_listed:
      return "the federation's members are listed by name in its federation file, and this "
             "federate is none of them";
    case Refusal::save_in_progress:
      return "the federation is being saved: join once that is done";
    case Refusal::restore_in_progress:
      return "the federation is being restored: join once that is done";
  }
  return "unknown refusal";
}

HlaError error_of(Refusal refusal) {
  switch (refusal) {
    case Refusal::wrong_fom:
      return HlaError::inconsistent_fdd;
    case Refusal::wrong_federation:
      return HlaError::federation_execution_does_not_exist;
    case Refusal::name_taken:
      return HlaError::federate_name_already_in_use;
    case Refusal::bad_name:
      return HlaError::illegal_name;
    case Refusal::not_listed:
    case Refusal::not_admitted:
      return HlaError::unauthorized;
    case Refusal::save_in_progress:
      return HlaError::save_in_progress;
    case Refusal::restore_in_progress:
      return HlaError::restore_in_progress;
    case Refusal::wrong_version:
    case Refusal::federation_full:
      break;
  }
  return HlaError::rti_internal_error;
}

const char* to_string(SynchronizationFailure failure) {
  switch (failure) {
    case SynchronizationFailure::label_not_unique:
      return "label not unique";
    case SynchronizationFailure::member_not_joined:
      return "a member of the set is not joined";
    case SynchronizationFailure::over_limit:
      return "more points than a federate may have open";
  }
  return "unknown failure";
}

const char* to_string(ResignReason reason) {
  switch (reason) {
    case ResignReason::resigned:
      return "resigned";
    case ResignReason::lost:
      return "lost";
    case ResignReason::misbehaved:
      return "misbehaved";
  }
  return "unknown reason";
}

}  // namespace rink::rti
