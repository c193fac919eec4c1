// Best-effort updates by datagram from federates: applied unless something newer is known,
// acknowledged so that they need not be sent again.
#include <algorithm>
#include <bit>

#include "rti/federation/federation_parts.h"
#include "rti/fom/coded_values.h"
#include "rti/wire/update_block.h"

namespace rink::rti {

/// Nothing in a datagram costs anybody the connection.
void FederationParts::receive_datagram(ConnectionId id, Bytes datagram) {
  if (id >= connections_.size() || connections_[id].phase != Phase::joined) return;
  counters_.bytes_received += datagram.size();
  connections_[id].has_spoken = true;
  const std::uint32_t slot = connections_[id].federate;
  Federate& federate = federates_[slot];
  federate.counts.bytes_sent += datagram.size();
  DatagramHead head;
  Reader reader(datagram);
  bool is_taken = exchange(reader, head);
  if (is_taken && head.number != 0) {
    if (!federate.upward && has_best_effort_)
      federate.upward = std::make_unique<UpwardWay>(fom_, federate.frames_heard);
    is_taken = federate.upward && head.frames >= federate.upward->first_frames;
  }
  // It may speak of objects that a frame on its way registers.
  if (is_taken && head.number != 0 && head.frames > federate.frames_heard) {
    is_taken = federate.upward->held.size() < UpwardWay::held_max;
    if (is_taken) federate.upward->held.emplace_back(datagram.begin(), datagram.end());
  } else {
    is_taken = is_taken && take_datagram(slot, datagram);
  }
  if (!is_taken) ++counters_.datagrams_ignored;
}

bool FederationParts::take_datagram(std::uint32_t slot, Bytes datagram) {
  DatagramHead head;
  Reader reader(datagram);
  exchange(reader, head);
  if (head.number != 0) {
    UpwardWay& way = *federates_[slot].upward;
    if (!way.receipts.is_due()) way.due_since = now_;
    if (!way.receipts.note(head.number)) return false;
    ++counters_.datagrams_received;
  }
  std::optional<Stamp> stamp;
  while (!reader.is_at_end()) {
    std::uint8_t kind = 0;
    reader.number(kind);
    if (kind == datagram_end) return true;
    StampMessage stamped;
    bool is_understood = false;
    if (static_cast<MessageKind>(kind) == MessageKind::acknowledge_datagrams)
      is_understood = take_acknowledgement(slot, reader);
    if (static_cast<MessageKind>(kind) == MessageKind::stamp && exchange(reader, stamped))
      stamp = stamped.stamp, is_understood = true;
    if (static_cast<MessageKind>(kind) == MessageKind::updates)
      is_understood =
          head.number != 0 && stamp && take_datagram_updates(slot, head, *stamp, reader);
    if (!is_understood) return false;
  }
  return true;
}

bool FederationParts::take_acknowledgement(std::uint32_t slot, Reader& reader) {
  DatagramWay* way = federates_[slot].way.get();
  AcknowledgeDatagramsMessage message;
  if (way == nullptr || !exchange(reader, message) ||
      !way->ledger.acknowledge(message, now_, way->due))
    return false;
  counters_.datagram_recoveries += way->has_fallen_back ? 1u : 0u;
  way->has_fallen_back = false;
  return true;
}

bool FederationParts::take_datagram_updates(std::uint32_t slot, const DatagramHead& head,
                                            const Stamp& stamp, Reader& reader) {
  UpdatesMessage message;
  if (!exchange(reader, message) || message.object_class >= fom_.object_classes().size())
    return false;
  const AttributeSet attributes{message.attributes};
  if (attributes.is_empty() || !best_effort_[message.object_class].includes(attributes))
    return false;
  const ObjectClass& object_class = fom_.object_classes()[message.object_class];
  return read_records(reader, object_class, attributes, [&](std::uint32_t handle, Bytes values) {
    const ObjectSlot object = objects_.find({handle});
    if (object == no_object) return is_late({handle});
    if (objects_[object].object_class != message.object_class) return false;
    const AttributeSet owned = attributes & ownership_.owned_by(slot, object);
    if (owned.is_empty())
      return ++counters_.updates_outdated, true;  // nothing is kept of what is not its own
    const AttributeSet accepted = federates_[slot].upward->accept({handle}, message.object_class,
                                                                  owned, order_of_datagram(head));
    if (accepted.is_empty()) return ++counters_.updates_outdated, true;
    if (accepted == attributes) return store_update(slot, object, accepted, stamp, values), true;
    std::vector<std::byte> cut;
    accepted.for_each([&](AttributeHandle each) {
      const Bytes value = coded_value(object_class, attributes, each, values);
      cut.insert(cut.end(), value.begin(), value.end());
    });
    return store_update(slot, object, accepted, stamp, cut), true;
  });
}

void FederationParts::take_held_datagrams(std::uint32_t slot) {
  std::vector<std::vector<std::byte>>& held = federates_[slot].upward->held;
  for (std::size_t i = 0; i < held.size();) {
    DatagramHead head;
    Reader reader(held[i]);
    exchange(reader, head);
    if (head.frames > federates_[slot].frames_heard) {
      ++i;
      continue;
    }
    const std::vector<std::byte> datagram = std::move(held[i]);
    held.erase(held.begin() + static_cast<std::ptrdiff_t>(i));
    if (!take_datagram(slot, datagram)) ++counters_.datagrams_ignored;
  }
}

/// When many are due, one is missing, or the first has waited for long enough.
void FederationParts::acknowledge_datagrams(Federate& federate, Outlet& outlet) {
  UpwardWay& way = *federate.upward;
  if (!way.receipts.is_due() ||
      (!way.receipts.is_urgent() && now_ - way.due_since < DatagramReceipts::longest_delay_s))
    return;
  if (outlet.datagram_max(federate.connection) == 0) return;
  std::vector<std::byte> bytes;
  DatagramHead head;
  Writer writer(bytes);
  exchange(writer, head);
  say(bytes, way.receipts.acknowledge());
  const Datagram whole{bytes, {}};
  counters_.bytes_sent += bytes.size();
  ++counters_.datagrams_sent;
  outlet.send_datagrams(federate.connection, std::span(&whole, 1));
}

}  // namespace rink::rti
