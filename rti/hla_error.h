// The errors of IEEE 1516.1-2010 by name, which services report at the federate's side and at the
// RTI's.
#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>

namespace rink::rti {

/// Exceptions of IEEE 1516.1-2010, annex A, as far as Rink refuses for these reasons. The numbers
/// are those on the wire.
enum class HlaError : std::uint8_t {
  none,
  already_connected,
  not_connected,
  federation_execution_already_exists,
  federation_execution_does_not_exist,
  federates_currently_joined,
  could_not_open_fdd,
  inconsistent_fdd,
  error_reading_fdd,
  federate_already_execution_member,
  federate_not_execution_member,
  federate_name_already_in_use,
  federate_owns_attributes,
  ownership_acquisition_pending,
  synchronization_point_label_not_announced,
  object_class_not_defined,
  object_class_not_published,
  attribute_not_defined,
  attribute_not_published,
  interaction_class_not_defined,
  interaction_class_not_published,
  interaction_parameter_not_defined,
  illegal_name,
  object_instance_name_in_use,
  object_instance_name_not_reserved,
  object_instance_not_known,
  attribute_not_owned,
  attribute_already_owned,
  attribute_already_being_acquired,
  attribute_already_being_divested,
  attribute_acquisition_was_not_requested,
  attribute_divestiture_was_not_requested,
  delete_privilege_not_held,
  invalid_logical_time,
  logical_time_already_passed,
  in_time_advancing_state,
  request_for_time_regulation_pending,
  request_for_time_constrained_pending,
  time_regulation_already_enabled,
  time_constrained_already_enabled,
  time_regulation_is_not_enabled,
  time_constrained_is_not_enabled,
  invalid_lookahead,
  message_can_no_longer_be_retracted,
  invalid_message_retraction_handle,
  invalid_region,
  invalid_region_context,
  invalid_range_bound,
  region_in_use_for_update_or_subscription,
  region_not_created_by_this_federate,
  region_does_not_contain_specified_dimension,
  invalid_dimension_handle,
  name_not_found,
  call_not_allowed_from_within_callback,
  unauthorized,
  rti_internal_error,
  asynchronous_delivery_already_enabled,
  asynchronous_delivery_already_disabled,
  no_acquisition_pending,
  object_class_relevance_advisory_switch_is_on,
  object_class_relevance_advisory_switch_is_off,
  attribute_relevance_advisory_switch_is_on,
  attribute_relevance_advisory_switch_is_off,
  attribute_scope_advisory_switch_is_on,
  attribute_scope_advisory_switch_is_off,
  interaction_relevance_advisory_switch_is_on,
  interaction_relevance_advisory_switch_is_off,
  name_set_was_empty,
  save_in_progress,
  save_not_initiated,
  save_not_in_progress,
  federate_has_not_begun_save,
  federate_unable_to_use_time,
  restore_in_progress,
  restore_not_requested,
  restore_not_in_progress,
};
/// The standard's own spelling, "AttributeNotOwned"; "" for none.
const char* to_string(HlaError error);

/// Thrown by a service of the federate's side that is refused, before anything is sent or changed;
/// `what` names the error, the thing and what was expected.
class RtiException : public std::logic_error {
 public:
  RtiException(HlaError error, std::string_view about)
      : std::logic_error(std::string(to_string(error)) + ": " + std::string(about)),
        error_(error) {}
  HlaError error() const { return error_; }

 private:
  HlaError error_;
};

}  // namespace rink::rti
