// The table of message kinds that the RTI may send and the services that handle them, one line for
// each.
#include <array>

#include "rti/federate/ambassador_parts.h"
#include "rti/wire/membership_messages.h"

namespace rink::rti {

namespace {

class FederateMessageTable {
  using Parts = AmbassadorParts;
  using Kind = MessageKind;
  using Handler = bool (*)(Parts&, Reader&, ReadContext&);

 public:
  constexpr FederateMessageTable() {
    add_membership();
    add_host();
    add_declarations();
    add_objects();
    add_updates();
    add_time();
  }
  bool handle(Parts& parts, MessageKind kind, Reader& reader, ReadContext& context) const {
    const Entry& entry = entries_[static_cast<std::uint8_t>(kind)];
    return entry.handler != nullptr && is_time_for(entry.when, parts.ground.phase) &&
           entry.handler(parts, reader, context);
  }

 private:
  enum class When : std::uint8_t { joined, joining, ever };
  struct Entry {
    Handler handler = nullptr;
    When when = When::joined;
  };
  static bool is_time_for(When when, const JoinPhase& phase) {
    if (when == When::joined) return phase.is_joined();
    return when == When::ever || phase.is_joining();
  }
  constexpr Handler& at(MessageKind kind) {
    return entries_[static_cast<std::uint8_t>(kind)].handler;
  }
  constexpr Handler& at(MessageKind kind, When when) {
    entries_[static_cast<std::uint8_t>(kind)].when = when;
    return at(kind);
  }

  constexpr void add_membership() {
    at(Kind::joined, When::joining) = [](Parts& parts, Reader& reader, ReadContext&) {
      return parts.handle_joined(reader);
    };
    at(Kind::refused, When::joining) = [](Parts& parts, Reader& reader, ReadContext&) {
      return parts.session.handle_refused(reader);
    };
    at(Kind::fom_digest, When::joining) = [](Parts& parts, Reader& reader, ReadContext&) {
      return parts.session.handle_fom_digest(reader);
    };
    at(Kind::expelled, When::ever) = [](Parts& parts, Reader& reader, ReadContext&) {
      return parts.handle_expelled(reader);
    };
    at(Kind::heartbeat) = [](Parts&, Reader&, ReadContext&) { return true; };
    at(Kind::federate_joined) = [](Parts& parts, Reader& reader, ReadContext&) {
      return parts.session.handle_federate_joined(reader);
    };
    at(Kind::federate_resigned) = [](Parts& parts, Reader& reader, ReadContext&) {
      return parts.session.handle_federate_resigned(reader);
    };
    at(Kind::synchronization_point_registered) = [](Parts& parts, Reader& reader, ReadContext&) {
      return parts.synchronization.handle_registered(reader);
    };
    at(Kind::announce_synchronization_point) = [](Parts& parts, Reader& reader, ReadContext&) {
      return parts.synchronization.handle_announced(reader);
    };
    at(Kind::federation_synchronized) = [](Parts& parts, Reader& reader, ReadContext&) {
      return parts.synchronization.handle_synchronized(reader);
    };
    at(Kind::save_notice) = [](Parts& parts, Reader& reader, ReadContext&) {
      return parts.saves.handle_notice(reader);
    };
    at(Kind::save_status) = [](Parts& parts, Reader& reader, ReadContext&) {
      return parts.saves.handle_status(reader);
    };
    at(Kind::restored) = [](Parts& parts, Reader& reader, ReadContext&) {
      return parts.saves.handle_restored(reader);
    };
  }
  constexpr void add_host() {
    at(Kind::federation_execution_created, When::ever) = [](Parts& parts, Reader& reader,
                                                            ReadContext&) {
      return parts.questions.handle_created(reader);
    };
    at(Kind::federation_execution_destroyed, When::ever) = [](Parts& parts, Reader& reader,
                                                              ReadContext&) {
      return parts.questions.handle_destroyed(reader);
    };
    at(Kind::federation_execution, When::ever) = [](Parts& parts, Reader& reader, ReadContext&) {
      return parts.questions.handle_execution(reader);
    };
    at(Kind::federation_report, When::ever) = [](Parts& parts, Reader& reader, ReadContext&) {
      return parts.questions.handle_federation_report(reader);
    };
    at(Kind::federate_report, When::ever) = [](Parts& parts, Reader& reader, ReadContext&) {
      return parts.questions.handle_federate_report(reader);
    };
    at(Kind::host_message) = [](Parts& parts, Reader& reader, ReadContext&) {
      HostMessage message;
      if (!exchange(reader, message)) return false;
      parts.ground.gate.callbacks().receive_host_message(message.content);
      return true;
    };
    at(Kind::report_end, When::ever) = [](Parts& parts, Reader&, ReadContext&) {
      return parts.questions.handle_report_end();
    };
  }
  constexpr void add_declarations() {
    at(Kind::class_relevance) = [](Parts& parts, Reader& reader, ReadContext&) {
      return parts.declarations.handle_class_relevance(reader);
    };
    at(Kind::object_relevance) = [](Parts& parts, Reader& reader, ReadContext&) {
      return parts.declarations.handle_object_relevance(reader);
    };
    at(Kind::ownership_notice) = [](Parts& parts, Reader& reader, ReadContext&) {
      return parts.owners.handle_notices(reader);
    };
    at(Kind::inform_ownership) = [](Parts& parts, Reader& reader, ReadContext&) {
      return parts.owners.handle_owner(reader);
    };
  }
  constexpr void add_objects() {
    at(Kind::further_block) = [](Parts& parts, Reader& reader, ReadContext&) {
      return parts.objects.handle_further_block(reader);
    };
    at(Kind::discover_object) = [](Parts& parts, Reader& reader, ReadContext&) {
      return parts.objects.handle_discovery(reader);
    };
    at(Kind::remove_object) = [](Parts& parts, Reader& reader, ReadContext& context) {
      return parts.objects.handle_removal(reader, context);
    };
    at(Kind::in_scope) = [](Parts& parts, Reader& reader, ReadContext&) {
      return parts.objects.handle_scope(reader, true);
    };
    at(Kind::entries) = [](Parts& parts, Reader& reader, ReadContext& context) {
      return parts.handle_entries(reader, context, false);
    };
    at(Kind::entries_again) = [](Parts& parts, Reader& reader, ReadContext& context) {
      return parts.handle_entries(reader, context, true);
    };
    at(Kind::out_of_scope) = [](Parts& parts, Reader& reader, ReadContext&) {
      return parts.objects.handle_scope(reader, false);
    };
    at(Kind::provide_update) = [](Parts& parts, Reader& reader, ReadContext&) {
      return parts.objects.handle_request(reader);
    };
    at(Kind::instance_names_answer) = [](Parts& parts, Reader& reader, ReadContext&) {
      return parts.names.handle_answer(reader);
    };
    at(Kind::transportation) = [](Parts& parts, Reader& reader, ReadContext&) {
      return parts.transportation.handle_answer(reader);
    };
  }
  constexpr void add_updates() {
    at(Kind::stamp) = [](Parts&, Reader& reader, ReadContext& context) {
      return UpdateReceiver::handle_stamp(reader, context);
    };
    at(Kind::stamp_step) = [](Parts& parts, Reader& reader, ReadContext& context) {
      return parts.update_receiver.handle_stamp_step(reader, context);
    };
    at(Kind::updates) = [](Parts& parts, Reader& reader, ReadContext& context) {
      return parts.update_receiver.handle_updates(reader, context);
    };
    at(Kind::begin_keyframe) = [](Parts& parts, Reader& reader, ReadContext&) {
      return parts.keyframes.handle_begin(reader);
    };
    at(Kind::deltas) = [](Parts& parts, Reader& reader, ReadContext& context) {
      return parts.keyframes.handle_deltas(reader, context);
    };
    at(Kind::residuals) = [](Parts& parts, Reader& reader, ReadContext& context) {
      return parts.ground.residuals.handle(reader, context);
    };
    at(Kind::interaction) = [](Parts& parts, Reader& reader, ReadContext& context) {
      return parts.update_receiver.handle_interaction(reader, context);
    };
  }
  constexpr void add_time() {
    at(Kind::time_regulation_enabled) = [](Parts& parts, Reader& reader, ReadContext&) {
      return parts.time.handle_regulation_enabled(reader);
    };
    at(Kind::time_constrained_enabled) = [](Parts& parts, Reader& reader, ReadContext&) {
      return parts.time.handle_constrained_enabled(reader);
    };
    at(Kind::time_advance_grant) = [](Parts& parts, Reader& reader, ReadContext&) {
      return parts.time.handle_grant(reader);
    };
    at(Kind::timed_delivery) = [](Parts& parts, Reader& reader, ReadContext& context) {
      return parts.handle_timed(reader, context);
    };
    at(Kind::request_retraction) = [](Parts& parts, Reader& reader, ReadContext&) {
      return parts.time.handle_retraction(reader);
    };
    at(Kind::time_bounds) = [](Parts& parts, Reader& reader, ReadContext&) {
      return parts.time.handle_bounds(reader);
    };
  }

  std::array<Entry, 256> entries_{};  ///< by kind, which is one byte
};

constexpr FederateMessageTable federate_message_table;

}  // namespace

bool AmbassadorParts::dispatch(MessageKind kind, Reader& reader, ReadContext& context) {
  return federate_message_table.handle(*this, kind, reader, context);
}

}  // namespace rink::rti
