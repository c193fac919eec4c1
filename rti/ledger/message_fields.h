// The names of all messages and of their fields, in the order in which they travel (docs/wire.md).
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string_view>

#include "rti/wire/message.h"

namespace rink::rti {

struct MessageFields {
  MessageKind kind;
  std::string_view form;
  std::array<std::string_view, 18> names{};  ///< what has no name on the page is called by what it
                                             ///< says; a longer list repeats its last name
};

inline constexpr MessageFields message_fields[] = {
    {MessageKind::join, "join", {"magic", "version", "fom_hash", "federation", "name", "type"}},
    {MessageKind::resign, "resign"},
    {MessageKind::heartbeat, "heartbeat"},
    {MessageKind::register_synchronization_point,
     "register_synchronization_point",
     {"label", "tag", "count", "members"}},
    {MessageKind::synchronization_point_achieved,
     "synchronization_point_achieved",
     {"label", "success"}},
    {MessageKind::watch_federates, "watch_federates"},
    {MessageKind::publish_object_class, "publish_object_class", {"class", "attributes"}},
    {MessageKind::subscribe_object_class,
     "subscribe_object_class",
     {"class", "attributes", "region", "passive"}},
    {MessageKind::publish_interaction_class, "publish_interaction_class", {"class", "declared"}},
    {MessageKind::subscribe_interaction_class, "subscribe_interaction_class", {"class", "action"}},
    {MessageKind::register_object, "register_object", {"object", "class", "name"}},
    {MessageKind::delete_object, "delete_object", {"object"}},
    {MessageKind::updates, "updates", {"class", "attributes"}},
    {MessageKind::interaction,
     "interaction",
     {"class", "receiver", "stamp.sizes", "stamp.time", "stamp.tag", "parameters"}},
    {MessageKind::create_region, "create_region", {"region"}},
    {MessageKind::modify_regions, "modify_regions", {"count", "regions"}},
    {MessageKind::associate_region, "associate_region", {"object", "region"}},
    {MessageKind::delete_region, "delete_region", {"region"}},
    {MessageKind::stamp, "stamp", {"stamp.sizes", "stamp.time", "stamp.tag"}},
    {MessageKind::create_federation_execution,
     "create_federation_execution",
     {"federation", "fom_hash"}},
    {MessageKind::destroy_federation_execution, "destroy_federation_execution", {"federation"}},
    {MessageKind::list_federation_executions, "list_federation_executions"},
    {MessageKind::query_management, "query_management"},
    {MessageKind::enable_time_regulation, "enable_time_regulation", {"lookahead"}},
    {MessageKind::time_switch, "time_switch", {"which"}},
    {MessageKind::modify_lookahead, "modify_lookahead", {"lookahead"}},
    {MessageKind::advance_request, "advance_request", {"service", "time"}},
    {MessageKind::timed_send,
     "timed_send",
     {"number", "stamp.sizes", "stamp.time", "stamp.tag", "content"}},
    {MessageKind::retract, "retract", {"number"}},
    {MessageKind::query_time_bounds, "query_time_bounds"},
    {MessageKind::ownership_request, "ownership_request", {"service", "attributes", "tag"}},
    {MessageKind::query_ownership, "query_ownership", {"object", "attribute"}},
    {MessageKind::resign_directive, "resign_directive", {"action"}},
    {MessageKind::request_update, "request_update", {"of", "number", "attributes", "tag"}},
    {MessageKind::change_transportation,
     "change_transportation",
     {"of", "number", "attributes", "transportation"}},
    {MessageKind::query_transportation,
     "query_transportation",
     {"of", "number", "attribute_or_federate"}},
    {MessageKind::instance_names, "instance_names", {"action", "names"}},
    {MessageKind::spare_update, "spare_update", {"object", "attributes"}},
    {MessageKind::local_delete, "local_delete", {"object"}},
    {MessageKind::advisory_switch, "advisory_switch", {"on"}},
    {MessageKind::acknowledge_keyframe, "acknowledge_keyframe", {"number"}},
    {MessageKind::refuse_keyframe, "refuse_keyframe", {"number"}},
    {MessageKind::create_region_over, "create_region_over", {"region", "dimensions"}},
    {MessageKind::modify_ranges, "modify_ranges", {"region", "count", "ranges"}},
    {MessageKind::regional_class, "regional_class", {"class", "action", "count", "pairs"}},
    {MessageKind::regional_interaction,
     "regional_interaction",
     {"class", "action", "count", "regions"}},
    {MessageKind::associate_regions, "associate_regions", {"object", "action", "count", "pairs"}},
    {MessageKind::interaction_within,
     "interaction_within",
     {"class", "stamp.sizes", "stamp.time", "stamp.tag", "count", "regions", "parameters"}},
    {MessageKind::notify_host, "notify_host"},
    {MessageKind::acknowledge_datagrams, "acknowledge_datagrams", {"newest", "before"}},
    {MessageKind::joined, "joined", {"federate", "block"}},
    {MessageKind::refused, "refused", {"refusal", "why"}},
    {MessageKind::announce_synchronization_point,
     "announce_synchronization_point",
     {"label", "tag"}},
    {MessageKind::federation_synchronized, "federation_synchronized", {"label", "count", "failed"}},
    {MessageKind::federate_joined, "federate_joined", {"federate", "name", "type"}},
    {MessageKind::federate_resigned, "federate_resigned", {"federate", "reason", "name", "type"}},
    {MessageKind::discover_object, "discover_object", {"object", "class", "name"}},
    {MessageKind::remove_object, "remove_object", {"object"}},
    {MessageKind::in_scope, "in_scope"},
    {MessageKind::out_of_scope, "out_of_scope"},
    {MessageKind::synchronization_point_registered,
     "synchronization_point_registered",
     {"label", "outcome"}},
    {MessageKind::federation_execution_created,
     "federation_execution_created",
     {"federation", "error"}},
    {MessageKind::federation_execution_destroyed,
     "federation_execution_destroyed",
     {"federation", "error"}},
    {MessageKind::federation_execution,
     "federation_execution",
     {"which", "federation", "model", "federates"}},
    {MessageKind::federation_report,
     "federation_report",
     {"federation", "model", "filter", "objects", "drops"}},
    {MessageKind::federate_report,
     "federate_report",
     {"federate", "name", "type", "updates_sent", "reflections_received", "interactions_sent",
      "interactions_received", "bytes_sent", "bytes_received", "bytes_queued", "objects_owned",
      "objects_in_scope", "regions", "regulating", "constrained", "logical_time", "least_stamp",
      "silence_s"}},
    {MessageKind::report_end, "report_end"},
    {MessageKind::time_regulation_enabled, "time_regulation_enabled", {"time", "least_stamp"}},
    {MessageKind::time_constrained_enabled, "time_constrained_enabled", {"time"}},
    {MessageKind::time_advance_grant, "time_advance_grant", {"time"}},
    {MessageKind::timed_delivery,
     "timed_delivery",
     {"sender", "in_order", "number", "stamp.sizes", "stamp.time", "stamp.tag", "content"}},
    {MessageKind::request_retraction, "request_retraction", {"sender", "number", "time"}},
    {MessageKind::time_bounds, "time_bounds", {"galt", "lits"}},
    {MessageKind::ownership_notice, "ownership_notice", {"notice", "attributes", "tag"}},
    {MessageKind::inform_ownership, "inform_ownership", {"object", "attribute", "federate"}},
    {MessageKind::instance_names_answer, "instance_names_answer", {"answer", "names"}},
    {MessageKind::class_relevance, "class_relevance", {"of", "class", "heard", "active"}},
    {MessageKind::object_relevance, "object_relevance", {"object", "attributes"}},
    {MessageKind::transportation,
     "transportation",
     {"of", "confirmation", "number", "which", "transportation"}},
    {MessageKind::begin_keyframe, "begin_keyframe", {"number"}},
    {MessageKind::deltas, "deltas", {"class"}},
    {MessageKind::residuals, "residuals", {"class", "size"}},
    {MessageKind::entries, "entries", {"class", "attributes", "repeated", "recalled"}},
    {MessageKind::entries_again, "entries_again"},
    {MessageKind::stamp_step, "stamp_step", {"count", "time", "tag"}},
    {MessageKind::fom_digest, "fom_digest", {"count", "elements"}},
    {MessageKind::provide_update, "provide_update", {"object", "attributes", "tag"}},
    {MessageKind::expelled, "expelled", {"why"}},
    {MessageKind::further_block, "further_block", {"block"}},
    {MessageKind::host_message, "host_message", {"size"}},
    {MessageKind::hello, "hello", {"version", "nonce", "federation"}},
    {MessageKind::challenge, "challenge", {"nonce"}},
    {MessageKind::proof, "proof", {"proof"}},
    {MessageKind::admitted, "admitted", {"proof"}},
};

/// Null for what is no kind.
constexpr const MessageFields* fields_of(std::uint8_t kind) {
  constexpr auto places = [] {
    std::array<std::uint8_t, 256> by_kind{};  // one more than the place
    for (std::size_t i = 0; i < std::size(message_fields); ++i)
      by_kind[static_cast<std::size_t>(message_fields[i].kind)] = static_cast<std::uint8_t>(i + 1);
    return by_kind;
  }();
  return places[kind] == 0 ? nullptr : &message_fields[places[kind] - 1];
}

}  // namespace rink::rti
