// What the RTI says to a federate: each message is checked and becomes a callback.
#include <algorithm>
#include <cassert>

#include "rti/federate/ambassador_services.h"
#include "rti/fom/coded_values.h"
#include "rti/wire/declaration_messages.h"
#include "rti/wire/membership_messages.h"
#include "rti/wire/message.h"
#include "rti/wire/time_messages.h"
#include "rti/wire/update_block.h"

namespace rink::rti {

bool AmbassadorServices::receive(Bytes bytes) {
  if (phase_.has_ended()) return true;
  watch_.heard();
  counters_.bytes_received += bytes.size();
  if (gate_.is_open()) return take_bytes(bytes);
  if (gate_.hold(bytes)) return true;
  lose("callbacks were disabled for too long");
  return false;
}

bool AmbassadorParts::take_bytes(Bytes bytes) {
  const bool is_understood =
      incoming_.receive(
          bytes, [] { return frame_max_to_federate; },
          [this](Bytes frame) { return take_frame(frame); }) == Framing::sound;
  if (!is_understood) lose("the RTI sent what this version does not understand");
  if (!held_datagrams_.empty()) apply_held_datagrams();
  return is_understood &&
         (!gate_.is_overfull() || (lose("too many callbacks wait to be evoked"), false));
}

void AmbassadorParts::lose(std::string_view why) {
  if (phase_.has_ended() || (phase_.is_idle() && !questions_.has_asked())) return;
  if (!gate_.is_open()) return gate_.hold_loss(why);
  phase_.end();
  callbacks_.connection_lost(why);
}

bool AmbassadorParts::take_frame(Bytes frame) {
  ++counters_.frames_received;
  if (phase_.is_joined()) arrivals_.count_frame();
  if (!postponed_.empty() && !release_postponed()) return false;
  ReadContext context;
  Reader reader(frame);
  while (!reader.is_at_end() && !phase_.has_ended())
    if (!take_message(reader, context)) return false;
  keyframe_reader_.end_frame();
  objects_.sweep();
  return true;
}

bool AmbassadorParts::take_message(Reader& reader, ReadContext& context) {
  std::uint8_t kind = 0;
  reader.number(kind);
  const auto name = static_cast<MessageKind>(kind);
  if (clock_.holds_receive_order() && context.timed == nullptr && is_receive_ordered(name))
    return postpone(reader, name, context);
  if (name == MessageKind::expelled) return take_expulsion(reader);
  switch (name) {
    case MessageKind::joined:
      return take_joined(reader);
    case MessageKind::refused:
      return phase_.is_joining() && session_.handle_refused(reader);
    case MessageKind::fom_digest:
      return phase_.is_joining() && session_.handle_fom_digest(reader);
    case MessageKind::federation_execution_created:
      return questions_.handle_created(reader);
    case MessageKind::federation_execution_destroyed:
      return questions_.handle_destroyed(reader);
    case MessageKind::federation_execution:
      return questions_.handle_execution(reader);
    case MessageKind::federation_report:
      return questions_.handle_federation_report(reader);
    case MessageKind::federate_report:
      return questions_.handle_federate_report(reader);
    case MessageKind::report_end:
      return questions_.handle_report_end();
    default:
      return phase_.is_joined() && take_joined_message(reader, name, context);
  }
}

/// What only a federate that has joined is told.
bool AmbassadorParts::take_joined_message(Reader& reader, MessageKind name, ReadContext& context) {
  switch (name) {
    case MessageKind::heartbeat:
      return true;
    case MessageKind::further_block:
      return take_further_block(reader);
    case MessageKind::synchronization_point_registered:
      return synchronization_.handle_registered(reader);
    case MessageKind::announce_synchronization_point:
      return synchronization_.handle_announced(reader);
    case MessageKind::federation_synchronized:
      return synchronization_.handle_synchronized(reader);
    case MessageKind::federate_joined:
      return session_.handle_federate_joined(reader);
    case MessageKind::federate_resigned:
      return session_.handle_federate_resigned(reader);
    case MessageKind::discover_object:
    case MessageKind::remove_object:
      return take_object(reader, static_cast<std::uint8_t>(name), context);
    case MessageKind::in_scope:
    case MessageKind::out_of_scope:
      return take_scope(reader, static_cast<std::uint8_t>(name));
    case MessageKind::provide_update:
      return take_provide_update(reader);
    case MessageKind::instance_names_answer:
      return names_.handle_answer(reader);
    case MessageKind::transportation:
      return take_transportation(reader);
    case MessageKind::class_relevance:
      return take_class_relevance(reader);
    case MessageKind::object_relevance:
      return take_object_relevance(reader);
    case MessageKind::ownership_notice:
    case MessageKind::inform_ownership:
      return take_ownership(reader, static_cast<std::uint8_t>(name));
    case MessageKind::stamp:
      return UpdateReceiver::handle_stamp(reader, context);
    case MessageKind::updates:
      return update_receiver_.handle_updates(reader, context);
    case MessageKind::begin_keyframe:
      return keyframe_reader_.handle_begin(reader);
    case MessageKind::deltas:
      return keyframe_reader_.handle_deltas(reader, context);
    case MessageKind::interaction:
      return take_interaction(reader, context);
    case MessageKind::time_regulation_enabled:
    case MessageKind::time_constrained_enabled:
    case MessageKind::time_advance_grant:
    case MessageKind::timed_delivery:
    case MessageKind::request_retraction:
    case MessageKind::time_bounds:
      return take_time(reader, static_cast<std::uint8_t>(name), context);
    default:
      return false;
  }
}

bool AmbassadorParts::take_joined(Reader& reader) {
  JoinedMessage message;
  if (!phase_.is_joining() || !exchange(reader, message)) return false;
  session_.joined({message.federate});
  objects_.begin(message.object_block);
  arrivals_.begin();
  if (declared_.is_on(Advisory::attribute_relevance)) frames_.enqueue(AdvisorySwitchMessage{true});
  callbacks_.joined(phase_.federate());
  return true;
}

/// The RTI's last message. What it says is why the connection is lost.
bool AmbassadorParts::take_expulsion(Reader& reader) {
  ExpelledMessage message;
  if (!exchange(reader, message)) return false;
  lose("the RTI closed the connection: " + std::string(message.why));
  return true;
}

bool AmbassadorParts::take_object(Reader& reader, std::uint8_t kind, const ReadContext& context) {
  if (static_cast<MessageKind>(kind) == MessageKind::remove_object) {
    RemoveObjectMessage message;
    if (!exchange(reader, message)) return false;
    const ObjectHandle object{message.object};
    if (objects_.find(object) == nullptr) {
      objects_.settle_gone(object);
      return objects_.is_gone(object);
    }
    arrivals_.leave(object);
    forget(object);
    objects_.remove(object);
    ++counters_.objects_removed;
    if (context.timed != nullptr)
      callbacks_.remove_object_instance_with_time({message.object}, *context.timed);
    else callbacks_.remove_object_instance({message.object});
    return true;
  }
  DiscoverObjectMessage message;
  if (!exchange(reader, message)) return false;
  const ObjectHandle object{message.object};
  if (message.object_class >= fom_.object_classes().size() ||
      !objects_.discover(object, {message.object_class}))
    return false;
  ++counters_.objects_discovered;
  names_.give(object, message.name);
  if (!message.name.empty())
    callbacks_.discover_object_instance(object, {message.object_class}, message.name);
  else
    callbacks_.discover_object_instance(object, {message.object_class},
                                        NameBook::default_name(object));
  return true;
}

bool AmbassadorParts::take_scope(Reader& reader, std::uint8_t kind) {
  InScopeMessage message;
  if (!exchange(reader, message)) return false;
  const KnownObject* known = objects_.find({message.object});
  if (known == nullptr) return objects_.is_gone({message.object});
  ++counters_.scope_changes;
  const bool is_in = static_cast<MessageKind>(kind) == MessageKind::in_scope;
  if (is_in) arrivals_.enter({message.object}, known->object_class);
  else arrivals_.leave({message.object});
  if (!declared_.is_on(Advisory::attribute_scope)) return true;
  if (is_in) callbacks_.attributes_in_scope({message.object});
  else callbacks_.attributes_out_of_scope({message.object});
  return true;
}

bool AmbassadorParts::take_interaction(Reader& reader, const ReadContext& context) {
  InteractionMessage message;
  if (!exchange(reader, message) || message.interaction_class >= fom_.interaction_classes().size())
    return false;
  ++counters_.interactions_received;
  if (context.timed != nullptr)
    callbacks_.receive_interaction_with_time({message.interaction_class}, message.parameters,
                                             {message.federate}, *context.timed);
  else
    callbacks_.receive_interaction({message.interaction_class}, message.parameters,
                                   {message.federate}, message.stamp);
  return true;
}

}  // namespace rink::rti
