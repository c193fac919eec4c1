// Applies datagrams of federates to the objects' states.
#include "rti/federation/delivery/best_effort_receiver.h"

#include <algorithm>
#include <utility>

#include "rti/fom/coded_values.h"
#include "rti/wire/update_block.h"

namespace rink::rti {

void BestEffortReceiver::joined(std::uint32_t slot) {
  if (slot >= federates_.size()) federates_.resize(slot + 1);
  assert(federates_[slot] == nullptr);
}

void BestEffortReceiver::receive(std::uint32_t slot, Bytes datagram) {
  DatagramHead head;
  Reader reader(datagram);
  if (!exchange(reader, head) || !admit(slot, head, datagram)) ++basis_.counters.datagrams_ignored;
}

/// A datagram that names objects which a frame on its way registers waits for that frame.
bool BestEffortReceiver::admit(std::uint32_t slot, const DatagramHead& head, Bytes datagram) {
  if (head.number == 0) return take(slot, datagram);
  if (!federates_[slot] && uses_.types.has_best_effort()) {
    federates_[slot] = std::make_unique<Received>();
    uses_.arrivals.begin(slot);
  }
  if (!federates_[slot] || head.frames < uses_.arrivals.first_frames(slot)) return false;
  if (head.frames <= uses_.arrivals.frames_received(slot)) return take(slot, datagram);
  std::vector<std::vector<std::byte>>& held = federates_[slot]->held;
  if (held.size() >= held_max) return false;
  held.emplace_back(datagram.begin(), datagram.end());
  return true;
}

bool BestEffortReceiver::take(std::uint32_t slot, Bytes datagram) {
  DatagramHead head;
  Reader reader(datagram);
  exchange(reader, head);
  if (head.number != 0) {
    Received& received = *federates_[slot];
    if (!received.receipts.is_due()) received.due_since = basis_.now;
    if (!received.receipts.note(head.number)) return false;
    ++basis_.counters.datagrams_received;
  }
  std::optional<Stamp> stamp;
  while (!reader.is_at_end()) {
    if (std::to_integer<std::uint8_t>(reader.rest().front()) == datagram_end) return true;
    if (!handle_message(slot, head, stamp, reader)) return false;
  }
  return true;
}

bool BestEffortReceiver::handle_message(std::uint32_t slot, const DatagramHead& head,
                                        std::optional<Stamp>& stamp, Reader& reader) {
  std::uint8_t kind = 0;
  reader.number(kind);
  switch (static_cast<MessageKind>(kind)) {
    case MessageKind::acknowledge_datagrams:
      return uses_.sender.acknowledge(slot, reader);
    case MessageKind::stamp: {
      StampMessage stamped;
      if (!exchange(reader, stamped)) return false;
      stamp = stamped.stamp;
      return true;
    }
    case MessageKind::updates:
      return head.number != 0 && stamp && handle_updates(slot, head, *stamp, reader);
    default:
      return false;
  }
}

bool BestEffortReceiver::handle_updates(std::uint32_t slot, const DatagramHead& head,
                                        const Stamp& stamp, Reader& reader) {
  UpdatesMessage message;
  if (!exchange(reader, message) || message.object_class >= basis_.fom.object_classes().size())
    return false;
  const AttributeSet attributes{message.attributes};
  if (attributes.is_empty() || !uses_.types.best_effort(message.object_class).includes(attributes))
    return false;
  const ObjectClass& object_class = basis_.fom.object_classes()[message.object_class];
  return read_records(reader, object_class, attributes, [&](std::uint32_t handle, Bytes values) {
    const ObjectSlot object = basis_.objects.find({handle});
    if (object == no_object) return uses_.known.is_late({handle});
    if (basis_.objects[object].object_class != message.object_class) return false;
    const AttributeSet accepted = accept(slot, head, object, attributes);
    if (accepted.is_empty()) return ++basis_.counters.updates_outdated, true;
    uses_.newest.note_unless_older(slot, stamp);
    if (accepted == attributes)
      return uses_.updates.store(slot, object, accepted, stamp, values), true;
    std::vector<std::byte> cut;
    accepted.for_each([&](AttributeHandle each) {
      const Bytes value = coded_value(object_class, attributes, each, values);
      cut.insert(cut.end(), value.begin(), value.end());
    });
    return uses_.updates.store(slot, object, accepted, stamp, cut), true;
  });
}

/// Values of attributes that the sender does not own are ignored.
AttributeSet BestEffortReceiver::accept(std::uint32_t slot, const DatagramHead& head,
                                        ObjectSlot object, AttributeSet attributes) {
  const AttributeSet owned = attributes & uses_.ownership.owned_by(slot, object);
  if (owned.is_empty()) return owned;
  const Object& target = basis_.objects[object];
  return uses_.arrivals.accept(slot, target.handle, target.object_class, owned,
                               order_of_datagram(head));
}

void BestEffortReceiver::handle_held(std::uint32_t slot) {
  if (!federates_[slot] || federates_[slot]->held.empty()) return;
  std::vector<std::vector<std::byte>>& held = federates_[slot]->held;
  for (std::size_t i = 0; i < held.size();) {
    DatagramHead head;
    Reader reader(held[i]);
    exchange(reader, head);
    if (head.frames > uses_.arrivals.frames_received(slot)) {
      ++i;
      continue;
    }
    const std::vector<std::byte> datagram = std::move(held[i]);
    held.erase(held.begin() + static_cast<std::ptrdiff_t>(i));
    if (!take(slot, datagram)) ++basis_.counters.datagrams_ignored;
  }
}

void BestEffortReceiver::acknowledge(std::uint32_t slot, Outlet& outlet) {
  if (!federates_[slot]) return;
  Received& received = *federates_[slot];
  if (!received.receipts.is_due() ||
      (!received.receipts.is_urgent() &&
       basis_.now - received.due_since < DatagramReceipts::longest_delay_s))
    return;
  const ConnectionId connection = basis_.federates[slot].connection;
  if (outlet.datagram_max(connection) == 0) return;
  std::vector<std::byte> bytes;
  DatagramHead head;
  Writer writer(bytes);
  exchange(writer, head);
  auto acknowledgement = received.receipts.acknowledge();
  write(bytes, acknowledgement);
  const Datagram whole{bytes, {}};
  basis_.counters.bytes_sent += bytes.size();
  ++basis_.counters.datagrams_sent;
  outlet.send_datagrams(connection, std::span(&whole, 1));
}

}  // namespace rink::rti
