// The standard's words for failures.
#include "rti/save/save_status.h"

namespace rink::rti {

const char* to_string(SaveFailure failure) {
  switch (failure) {
    case SaveFailure::rti_unable_to_save:
      return "RTI unable to save";
    case SaveFailure::federate_reported_failure:
      return "federate reported failure during save";
    case SaveFailure::federate_resigned:
      return "federate resigned during save";
    case SaveFailure::rti_detected_failure:
      return "RTI detected failure during save";
    case SaveFailure::save_time_cannot_be_honored:
      return "save time cannot be honored";
    case SaveFailure::save_aborted:
      return "save aborted";
  }
  return "unknown failure";
}

const char* to_string(RestoreFailure failure) {
  switch (failure) {
    case RestoreFailure::rti_unable_to_restore:
      return "RTI unable to restore";
    case RestoreFailure::federate_reported_failure:
      return "federate reported failure during restore";
    case RestoreFailure::federate_resigned:
      return "federate resigned during restore";
    case RestoreFailure::rti_detected_failure:
      return "RTI detected failure during restore";
    case RestoreFailure::restore_aborted:
      return "restore aborted";
  }
  return "unknown failure";
}

}  // namespace rink::rti
