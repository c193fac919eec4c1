// The actions of an ambassador that concern several of its services.
#include "rti/federate/ambassador_parts.h"

#include "rti/wire/membership_messages.h"
#include "rti/wire/time_messages.h"

namespace rink::rti {

AmbassadorParts::AmbassadorParts(const Fom& fom, FederateAmbassador& callbacks,
                                 const Timeouts& timeouts, CallbackModel model)
    : ground(fom, callbacks, timeouts, model),
      lookup(fom),
      sender(ground.basis(), {ground.objects, ground.ownership, ground.classes, ground.arrivals,
                              ground.watch, ground.sent}),
      sparing(ground.basis(), {ground.classes, ground.ownership, ground.gate, ground.sent, sender}),
      updates(ground.basis(), {ground.objects, ground.ownership, ground.classes, sparing, sender}),
      owners(ground.basis(), {ground.objects, ground.classes, ground.ownership, sparing, sender}),
      declarations(ground.basis(), {ground.objects, ground.regions, ground.classes,
                                    ground.ownership, sparing, sender}),
      names(ground.basis(), ground.objects),
      objects(ground.basis(),
              {ground.classes, declarations, ground.objects, names, ground.ownership,
               ground.regions, ground.arrivals, sparing, sender, ground.residuals}),
      transportation(ground.basis(), {ground.objects, ground.ownership, ground.classes, sender}),
      regions(ground.basis(), {ground.regions, ground.objects, ground.ownership, updates, objects}),
      time(ground.basis(),
           {ground.objects, ground.ownership, ground.sent, sparing, sender, updates, objects}),
      synchronization(ground.basis()),
      questions(ground.basis()),
      session(ground.basis(), ground.phase),
      saves(ground.basis(), {session, sparing, sender, time}),
      update_receiver(ground.basis(), ground.objects, ground.arrivals, ground.residuals),
      keyframes(ground.basis(), ground.objects, ground.arrivals),
      datagrams(ground.basis(), {ground.watch, ground.arrivals, update_receiver, sender}),
      entries_(ground.basis(),
               {ground.objects, objects, update_receiver, ground.residuals, ground.postponed}) {}

void AmbassadorParts::join(std::string_view federation, std::string_view federate_name,
                           std::string_view federate_type) {
  session.join(federation, federate_name, federate_type);
  ground.regions.sign(federate_name);
}

void AmbassadorParts::resign(ResignAction action) {
  owners.prepare_to_resign(action);
  session.resign();
}

bool AmbassadorParts::receive(Bytes bytes) {
  if (ground.phase.has_ended()) return true;
  ground.watch.received();
  ground.counters.bytes_received += bytes.size();
  if (ground.gate.is_open()) return handle_bytes(bytes);
  if (ground.gate.hold(bytes)) return true;
  lose("callbacks were disabled for too long");
  return false;
}

bool AmbassadorParts::handle_bytes(Bytes bytes) {
  const bool is_understood =
      ground.incoming.receive(
          bytes, [] { return frame_max_to_federate; },
          [this](Bytes frame) { return handle_frame(frame); }) == Framing::sound;
  if (!is_understood) lose("the RTI sent what this version does not understand");
  datagrams.apply_held();
  if (!is_understood || !ground.gate.is_overfull()) return is_understood;
  lose("too many callbacks wait to be evoked");
  return false;
}

bool AmbassadorParts::handle_frame(Bytes frame) {
  ++ground.counters.frames_received;
  if (ground.phase.is_joined()) ground.arrivals.count_frame();
  if (!ground.postponed.is_empty() && !release_postponed()) return false;
  ReadContext context;
  Reader reader(frame);
  while (!reader.is_at_end() && !ground.phase.has_ended())
    if (!handle_message(reader, context)) return false;
  keyframes.end_frame();
  ground.objects.sweep();
  return true;
}

bool AmbassadorParts::handle_message(Reader& reader, ReadContext& context) {
  std::uint8_t number = 0;
  reader.number(number);
  const auto kind = static_cast<MessageKind>(number);
  if (is_postponing(context) && is_receive_ordered(kind)) return postpone(reader, kind, context);
  // A callback to a message before this one may have asked to advance: what was put off comes
  // first.
  if (!ground.postponed.is_empty() && !context.is_released && !release_postponed()) return false;
  if (ground.phase.has_ended()) return true;
  return dispatch(kind, reader, context);
}

bool AmbassadorParts::postpone(Reader& reader, MessageKind kind, const ReadContext& context) {
  const bool is_read = ground.postponed.keep(reader, kind, context);
  lose_if_overfull();
  return is_read;
}

bool AmbassadorParts::release_postponed() {
  if (time.clock().holds_receive_order()) return true;
  const std::vector<std::byte> messages = ground.postponed.take();
  Reader reader(messages);
  ReadContext context;
  context.is_released = true;
  while (!reader.is_at_end() && ground.phase.is_joined())
    if (!handle_message(reader, context)) return false;
  return true;
}

bool AmbassadorParts::handle_joined(Reader& reader) {
  JoinedMessage message;
  if (!ground.phase.is_joining() || !exchange(reader, message)) return false;
  session.joined({message.federate});
  ground.objects.begin(message.object_block);
  ground.arrivals.begin();
  declarations.joined();
  ground.gate.callbacks().joined(ground.phase.federate());
  return true;
}

/// The RTI's last message gives the reason why the connection is lost.
bool AmbassadorParts::handle_expelled(Reader& reader) {
  ExpelledMessage message;
  if (!exchange(reader, message)) return false;
  lose("the RTI closed the connection: " + std::string(message.why));
  return true;
}

/// A message that was sent in time-stamp order holds another.
bool AmbassadorParts::handle_timed(Reader& reader, const ReadContext& context) {
  TimedDeliveryMessage message;
  if (!exchange(reader, message) || context.timed != nullptr) return false;
  ++ground.counters.timed_received;
  const TimedStamp timed{message.stamp,
                         message.is_in_order != 0,
                         {{message.sender}, message.number, message.stamp.time}};
  ReadContext inner{message.stamp, &timed};
  Reader content(message.content);
  const bool is_content =
      !message.content.empty() && is_receive_ordered(static_cast<MessageKind>(message.content[0]));
  return is_content && handle_message(content, inner) &&
         (content.is_at_end() || !ground.phase.is_joined());
}

bool AmbassadorParts::handle_entries(Reader& reader, const ReadContext& context, bool is_again) {
  const bool is_read = is_again ? entries_.handle_again(reader, context, is_postponing(context))
                                : entries_.handle(reader, context, is_postponing(context));
  lose_if_overfull();
  return is_read;
}

void AmbassadorParts::lose_if_overfull() {
  if (ground.postponed.is_overfull())
    lose("more to tell than a federate that never advances is kept");
}

void AmbassadorParts::lose(std::string_view why) {
  if (ground.phase.has_ended() || (ground.phase.is_idle() && !questions.has_asked())) return;
  if (!ground.gate.is_open()) return ground.gate.hold_loss(why);
  ground.phase.end();
  ground.gate.callbacks().connection_lost(why);
}

void AmbassadorParts::receive_datagram(Bytes datagram) {
  if (!ground.phase.is_joined()) return;
  ground.watch.received();
  if (!saves.takes_datagrams()) return;
  datagrams.receive(datagram, ground.gate.is_open());
}

void AmbassadorParts::expect_datagrams(std::size_t size_max) {
  if (size_max > 0) ground.arrivals.expect_datagrams();
  sender.expect_datagrams(size_max);
}

std::span<const Datagram> AmbassadorParts::outgoing_datagrams() {
  return sender.datagrams(datagrams.acknowledgement());
}

void AmbassadorParts::clear_outgoing_datagrams() {
  sender.clear_datagrams();
  datagrams.clear_acknowledgement();
}

void AmbassadorParts::clear_outgoing() {
  if (!ground.frames.is_empty()) ground.watch.sent();
  ground.counters.bytes_sent += ground.frames.bytes().size();
  ground.counters.frames_sent = ground.frames.frame_count();
  ground.frames.clear();
}

void AmbassadorParts::advance_clock(double now, bool is_behind) {
  ground.watch.advance(now, !ground.frames.is_empty(), is_behind);
  if (ground.phase.is_joined()) sender.repair();
  if (!ground.postponed.is_empty()) release_postponed();
  if (!ground.phase.may_send()) return;
  datagrams.advance_clock();
  if (ground.watch.is_rti_lost()) return lose("the RTI has been silent for too long");
  if (ground.phase.is_joined() && ground.watch.is_heartbeat_due()) {
    ground.frames.enqueue(HeartbeatMessage{});
    ground.watch.beat();
  }
}

void AmbassadorParts::disable_callbacks() {
  ground.gate.disable();
  sparing.gate_closed();
}

void AmbassadorParts::enable_callbacks() {
  const bool was_open = ground.gate.is_open();
  ground.gate.enable();
  const std::vector<std::byte> held = ground.gate.take_held();
  const std::string loss = ground.gate.take_held_loss();
  if (!held.empty()) handle_bytes(held);
  if (!was_open) datagrams.apply_held();
  if (!loss.empty()) lose(loss);
}

std::size_t AmbassadorParts::memory_bytes() const {
  const std::size_t books = ground.objects.memory_bytes() + ground.regions.memory_bytes() +
                            ground.classes.memory_bytes() + ground.sent.memory_bytes() +
                            ground.arrivals.memory_bytes() + ground.ownership.memory_bytes() +
                            names.memory_bytes() + declarations.memory_bytes();
  const std::size_t sending = ground.frames.memory_bytes() + sender.memory_bytes() +
                              sparing.memory_bytes() + updates.memory_bytes() +
                              regions.memory_bytes() + time.memory_bytes();
  const std::size_t receiving = ground.gate.memory_bytes() + ground.incoming.memory_bytes() +
                                ground.postponed.memory_bytes() + entries_.memory_bytes() +
                                update_receiver.memory_bytes() + keyframes.memory_bytes() +
                                datagrams.memory_bytes() + ground.residuals.memory_bytes();
  return books + sending + receiving;
}

}  // namespace rink::rti
