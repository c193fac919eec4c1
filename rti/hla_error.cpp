// The standard's spelling of its errors.
#include "rti/hla_error.h"

namespace rink::rti {

const char* to_string(HlaError error) {
  switch (error) {
    case HlaError::none: return "";
    case HlaError::already_connected: return "AlreadyConnected";
    case HlaError::not_connected: return "NotConnected";
    case HlaError::federation_execution_already_exists: return "FederationExecutionAlreadyExists";
    case HlaError::federation_execution_does_not_exist: return "FederationExecutionDoesNotExist";
    case HlaError::federates_currently_joined: return "FederatesCurrentlyJoined";
    case HlaError::could_not_open_fdd: return "CouldNotOpenFDD";
    case HlaError::inconsistent_fdd: return "InconsistentFDD";
    case HlaError::error_reading_fdd: return "ErrorReadingFDD";
    case HlaError::federate_already_execution_member: return "FederateAlreadyExecutionMember";
    case HlaError::federate_not_execution_member: return "FederateNotExecutionMember";
    case HlaError::federate_name_already_in_use: return "FederateNameAlreadyInUse";
    case HlaError::federate_owns_attributes: return "FederateOwnsAttributes";
    case HlaError::ownership_acquisition_pending: return "OwnershipAcquisitionPending";
    case HlaError::synchronization_point_label_not_announced: return "SynchronizationPointLabelNotAnnounced";
    case HlaError::object_class_not_defined: return "ObjectClassNotDefined";
    case HlaError::object_class_not_published: return "ObjectClassNotPublished";
    case HlaError::attribute_not_defined: return "AttributeNotDefined";
    case HlaError::attribute_not_published: return "AttributeNotPublished";
    case HlaError::interaction_class_not_defined: return "InteractionClassNotDefined";
    case HlaError::interaction_class_not_published: return "InteractionClassNotPublished";
    case HlaError::interaction_parameter_not_defined: return "InteractionParameterNotDefined";
    case HlaError::illegal_name: return "IllegalName";
    case HlaError::object_instance_name_in_use: return "ObjectInstanceNameInUse";
    case HlaError::object_instance_name_not_reserved: return "ObjectInstanceNameNotReserved";
    case HlaError::object_instance_not_known: return "ObjectInstanceNotKnown";
    case HlaError::attribute_not_owned: return "AttributeNotOwned";
    case HlaError::attribute_already_owned: return "AttributeAlreadyOwned";
    case HlaError::attribute_already_being_acquired: return "AttributeAlreadyBeingAcquired";
    case HlaError::attribute_already_being_divested: return "AttributeAlreadyBeingDivested";
    case HlaError::attribute_acquisition_was_not_requested: return "AttributeAcquisitionWasNotRequested";
    case HlaError::attribute_divestiture_was_not_requested: return "AttributeDivestitureWasNotRequested";
    case HlaError::delete_privilege_not_held: return "DeletePrivilegeNotHeld";
    case HlaError::invalid_logical_time: return "InvalidLogicalTime";
    case HlaError::logical_time_already_passed: return "LogicalTimeAlreadyPassed";
    case HlaError::in_time_advancing_state: return "InTimeAdvancingState";
    case HlaError::request_for_time_regulation_pending: return "RequestForTimeRegulationPending";
    case HlaError::request_for_time_constrained_pending: return "RequestForTimeConstrainedPending";
    case HlaError::time_regulation_already_enabled: return "TimeRegulationAlreadyEnabled";
    case HlaError::time_constrained_already_enabled: return "TimeConstrainedAlreadyEnabled";
    case HlaError::time_regulation_is_not_enabled: return "TimeRegulationIsNotEnabled";
    case HlaError::time_constrained_is_not_enabled: return "TimeConstrainedIsNotEnabled";
    case HlaError::invalid_lookahead: return "InvalidLookahead";
    case HlaError::message_can_no_longer_be_retracted: return "MessageCanNoLongerBeRetracted";
    case HlaError::invalid_message_retraction_handle: return "InvalidMessageRetractionHandle";
    case HlaError::invalid_region: return "InvalidRegion";
    case HlaError::invalid_region_context: return "InvalidRegionContext";
    case HlaError::invalid_range_bound: return "InvalidRangeBound";
    case HlaError::region_in_use_for_update_or_subscription: return "RegionInUseForUpdateOrSubscription";
    case HlaError::region_not_created_by_this_federate: return "RegionNotCreatedByThisFederate";
    case HlaError::region_does_not_contain_specified_dimension: return "RegionDoesNotContainSpecifiedDimension";
    case HlaError::invalid_dimension_handle: return "InvalidDimensionHandle";
    case HlaError::name_not_found: return "NameNotFound";
    case HlaError::call_not_allowed_from_within_callback: return "CallNotAllowedFromWithinCallback";
    case HlaError::unauthorized: return "Unauthorized";
    case HlaError::rti_internal_error: return "RTIinternalError";
    case HlaError::asynchronous_delivery_already_enabled: return "AsynchronousDeliveryAlreadyEnabled";
    case HlaError::asynchronous_delivery_already_disabled: return "AsynchronousDeliveryAlreadyDisabled";
    case HlaError::no_acquisition_pending: return "NoAcquisitionPending";
    case HlaError::object_class_relevance_advisory_switch_is_on: return "ObjectClassRelevanceAdvisorySwitchIsOn";
    case HlaError::object_class_relevance_advisory_switch_is_off: return "ObjectClassRelevanceAdvisorySwitchIsOff";
    case HlaError::attribute_relevance_advisory_switch_is_on: return "AttributeRelevanceAdvisorySwitchIsOn";
    case HlaError::attribute_relevance_advisory_switch_is_off: return "AttributeRelevanceAdvisorySwitchIsOff";
    case HlaError::attribute_scope_advisory_switch_is_on: return "AttributeScopeAdvisorySwitchIsOn";
    case HlaError::attribute_scope_advisory_switch_is_off: return "AttributeScopeAdvisorySwitchIsOff";
    case HlaError::interaction_relevance_advisory_switch_is_on: return "InteractionRelevanceAdvisorySwitchIsOn";
    case HlaError::interaction_relevance_advisory_switch_is_off: return "InteractionRelevanceAdvisorySwitchIsOff";
    case HlaError::name_set_was_empty: return "NameSetWasEmpty";
  }
  return "unknown error";
}

}  // namespace rink::rti
