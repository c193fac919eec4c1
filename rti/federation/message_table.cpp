// The table of message kinds that a federate may send and the services that handle them, one line
// for each.
#include <array>

#include "rti/federation/federation_parts.h"

namespace rink::rti {

namespace {

/// Kinds that federates send; those that only the RTI sends begin at `joined`.
constexpr std::size_t kind_count = static_cast<std::size_t>(MessageKind::joined);

class MessageTable {
  using Parts = FederationParts;
  using Slot = std::uint32_t;
  using Kind = MessageKind;
  using Handler = Status (*)(Parts&, Slot, Reader&);

 public:
  constexpr MessageTable() {
    handlers_.fill([](Parts&, Slot, Reader&) -> Status { return Violation::malformed; });
    add_membership();
    add_declarations();
    add_objects();
    add_regions();
    add_ownership();
    add_time();
  }
  Status take(Parts& parts, Slot slot, Reader& reader) const {
    std::uint8_t kind = 0;
    reader.number(kind);
    if (parts.saves.forbids(slot, static_cast<Kind>(kind))) return Violation::wrong_phase;
    return kind < kind_count ? handlers_[kind](parts, slot, reader) : Violation::malformed;
  }

 private:
  /// Notifies the parts of changed subscriptions if the message was valid.
  static Status subscribed(Parts& parts, Slot slot, const Status& status) {
    if (!status) parts.subscriptions_changed(slot);
    return status;
  }
  constexpr Handler& at(MessageKind kind) { return handlers_[static_cast<std::size_t>(kind)]; }

  constexpr void add_membership() {
    at(Kind::join) = [](Parts&, Slot, Reader&) -> Status { return Violation::wrong_phase; };
    at(Kind::heartbeat) = [](Parts&, Slot, Reader&) -> Status { return std::nullopt; };
    at(Kind::resign) = [](Parts& parts, Slot slot, Reader&) {
      return parts.connections.resign(parts.ground.federates[slot].connection);
    };
    at(Kind::watch_federates) = [](Parts& parts, Slot slot, Reader&) {
      return parts.membership.handle_watch(slot);
    };
    at(Kind::query_management) = [](Parts& parts, Slot slot, Reader&) {
      return parts.connections.query_report(parts.ground.federates[slot].connection);
    };
    at(Kind::notify_host) = [](Parts& parts, Slot slot, Reader&) -> Status {
      parts.ground.federates[slot].has_notice = true;
      return std::nullopt;
    };
    at(Kind::register_synchronization_point) = [](Parts& parts, Slot slot, Reader& reader) {
      return parts.synchronization.handle_register(slot, reader);
    };
    at(Kind::synchronization_point_achieved) = [](Parts& parts, Slot slot, Reader& reader) {
      return parts.synchronization.handle_achieved(slot, reader);
    };
    at(Kind::save_request) = [](Parts& parts, Slot slot, Reader& reader) {
      return parts.saves.handle_request(slot, reader);
    };
    at(Kind::ambassador_state) = [](Parts& parts, Slot slot, Reader& reader) {
      return parts.saves.handle_state(slot, reader);
    };
  }
  constexpr void add_declarations() {
    at(Kind::publish_object_class) = [](Parts& parts, Slot slot, Reader& reader) {
      return parts.declarations.handle_publish_class(slot, reader);
    };
    at(Kind::subscribe_object_class) = [](Parts& parts, Slot slot, Reader& reader) {
      return subscribed(parts, slot, parts.declarations.handle_subscribe_class(slot, reader));
    };
    at(Kind::publish_interaction_class) = [](Parts& parts, Slot slot, Reader& reader) {
      return parts.declarations.handle_publish_interaction(slot, reader);
    };
    at(Kind::subscribe_interaction_class) = [](Parts& parts, Slot slot, Reader& reader) {
      return subscribed(parts, slot, parts.interactions.handle_subscribe(slot, reader));
    };
    at(Kind::advisory_switch) = [](Parts& parts, Slot slot, Reader& reader) {
      return parts.declarations.handle_advisory_switch(slot, reader);
    };
  }
  constexpr void add_objects() {
    at(Kind::register_object) = [](Parts& parts, Slot slot, Reader& reader) {
      return parts.objects.objects.handle_register(slot, reader);
    };
    at(Kind::delete_object) = [](Parts& parts, Slot slot, Reader& reader) {
      return parts.objects.objects.handle_delete(slot, reader);
    };
    at(Kind::local_delete) = [](Parts& parts, Slot slot, Reader& reader) {
      return parts.objects.objects.handle_local_delete(slot, reader);
    };
    at(Kind::instance_names) = [](Parts& parts, Slot slot, Reader& reader) {
      return parts.objects.names.handle(slot, reader);
    };
    at(Kind::stamp) = [](Parts& parts, Slot slot, Reader& reader) {
      return parts.objects.updates.handle_stamp(slot, reader);
    };
    at(Kind::updates) = [](Parts& parts, Slot slot, Reader& reader) {
      return parts.objects.updates.handle_updates(slot, reader);
    };
    at(Kind::spare_update) = [](Parts& parts, Slot slot, Reader& reader) {
      return parts.objects.updates.handle_spare(slot, reader);
    };
    at(Kind::interaction) = [](Parts& parts, Slot slot, Reader& reader) -> Status {
      InteractionMessage message;
      if (const Status status = parts.interactions.read(reader, message)) return status;
      return parts.send(slot, message, {});
    };
    at(Kind::request_update) = [](Parts& parts, Slot slot, Reader& reader) {
      return parts.objects.requests.handle(slot, reader);
    };
    at(Kind::change_transportation) = [](Parts& parts, Slot slot, Reader& reader) {
      return parts.objects.types.handle_change(slot, reader);
    };
    at(Kind::query_transportation) = [](Parts& parts, Slot slot, Reader& reader) {
      return parts.objects.types.handle_query(slot, reader);
    };
    at(Kind::acknowledge_keyframe) = [](Parts& parts, Slot slot, Reader& reader) {
      return parts.periodic.handle_acknowledgement(slot, reader);
    };
    at(Kind::refuse_keyframe) = [](Parts& parts, Slot slot, Reader& reader) {
      return parts.periodic.handle_refusal(slot, reader);
    };
  }
  constexpr void add_regions() {
    at(Kind::create_region) = [](Parts& parts, Slot slot, Reader& reader) {
      return parts.regions.handle_create(slot, reader);
    };
    at(Kind::delete_region) = [](Parts& parts, Slot slot, Reader& reader) {
      const Status status = parts.regions.handle_delete(slot, reader);
      if (!status) parts.interactions.join_groups(slot);
      return subscribed(parts, slot, status);
    };
    at(Kind::create_region_over) = [](Parts& parts, Slot slot, Reader& reader) {
      return parts.regions.handle_create_over(slot, reader);
    };
    at(Kind::modify_regions) = [](Parts& parts, Slot slot, Reader& reader) {
      return parts.regions.handle_modify(slot, reader);
    };
    at(Kind::modify_ranges) = [](Parts& parts, Slot slot, Reader& reader) {
      return parts.regions.handle_modify_ranges(slot, reader);
    };
    at(Kind::associate_region) = [](Parts& parts, Slot slot, Reader& reader) {
      return parts.regions.handle_associate(slot, reader);
    };
    at(Kind::associate_regions) = [](Parts& parts, Slot slot, Reader& reader) {
      return parts.regions.handle_associate_parts(slot, reader);
    };
    at(Kind::regional_class) = [](Parts& parts, Slot slot, Reader& reader) {
      return subscribed(parts, slot, parts.regions.handle_class(slot, reader));
    };
    at(Kind::regional_interaction) = [](Parts& parts, Slot slot, Reader& reader) {
      return subscribed(parts, slot, parts.interactions.handle_subscribe_within(slot, reader));
    };
    at(Kind::interaction_within) = [](Parts& parts, Slot slot, Reader& reader) -> Status {
      InteractionMessage message;
      std::vector<RegionHandle> regions;
      const Status status = parts.interactions.read_within(slot, reader, message, regions);
      return status ? status : parts.send(slot, message, regions);
    };
  }
  constexpr void add_ownership() {
    at(Kind::ownership_request) = [](Parts& parts, Slot slot, Reader& reader) {
      return parts.owners.handle_requests(slot, reader);
    };
    at(Kind::query_ownership) = [](Parts& parts, Slot slot, Reader& reader) {
      return parts.owners.handle_query(slot, reader);
    };
    at(Kind::resign_directive) = [](Parts& parts, Slot slot, Reader& reader) {
      return parts.owners.handle_resign_directive(slot, reader);
    };
  }
  constexpr void add_time() {
    at(Kind::enable_time_regulation) = [](Parts& parts, Slot slot, Reader& reader) {
      return parts.time.handle_regulation(slot, reader);
    };
    at(Kind::modify_lookahead) = [](Parts& parts, Slot slot, Reader& reader) {
      return parts.time.handle_lookahead(slot, reader);
    };
    at(Kind::time_switch) = [](Parts& parts, Slot slot, Reader& reader) {
      return parts.time.handle_switch(slot, reader);
    };
    at(Kind::advance_request) = [](Parts& parts, Slot slot, Reader& reader) {
      return parts.time.handle_advance(slot, reader);
    };
    at(Kind::timed_send) = [](Parts& parts, Slot slot, Reader& reader) {
      return parts.time.handle_send(slot, reader);
    };
    at(Kind::retract) = [](Parts& parts, Slot slot, Reader& reader) {
      return parts.time.handle_retract(slot, reader);
    };
    at(Kind::query_time_bounds) = [](Parts& parts, Slot slot, Reader&) {
      return parts.time.handle_query(slot);
    };
  }

  std::array<Handler, kind_count> handlers_{};
};

constexpr MessageTable message_table;

}  // namespace

Status FederationParts::handle_message(std::uint32_t slot, Reader& reader) {
  return message_table.take(*this, slot, reader);
}

}  // namespace rink::rti
