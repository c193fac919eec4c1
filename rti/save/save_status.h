// How far a save or a restore of a federation is, and why it failed (IEEE 1516.1-2010, 4.16 to
// 4.31).
#pragma once

#include <cstdint>

#include "rti/handles.h"

namespace rink::rti {

/// The numbers of all of these are those on the wire.
enum class SaveFailure : std::uint8_t {
  rti_unable_to_save,
  federate_reported_failure,
  federate_resigned,
  rti_detected_failure,
  save_time_cannot_be_honored,
  save_aborted,
};
enum class RestoreFailure : std::uint8_t {
  rti_unable_to_restore,
  federate_reported_failure,
  federate_resigned,
  rti_detected_failure,
  restore_aborted,
};
/// The standard's words, "RTI unable to save".
const char* to_string(SaveFailure failure);
const char* to_string(RestoreFailure failure);

/// One federate's part in a save.
enum class SaveStatus : std::uint8_t { none, instructed, saving, waiting };
struct FederateSaveStatus {
  FederateHandle federate;
  SaveStatus status = SaveStatus::none;
  friend bool operator==(const FederateSaveStatus&, const FederateSaveStatus&) = default;
};

/// One federate's part in a restore.
enum class RestoreStatus : std::uint8_t {
  none,
  request_pending,
  waiting_to_begin,
  prepared,
  restoring,
  waiting,
};
struct FederateRestoreStatus {
  FederateHandle before, after;  ///< its handles before the restore and once it has succeeded
  RestoreStatus status = RestoreStatus::none;
  friend bool operator==(const FederateRestoreStatus&, const FederateRestoreStatus&) = default;
};

}  // namespace rink::rti
