// Applies datagrams, and holds them until the frames that they rely on have come.
#include "rti/federate/delivery/datagram_receiver.h"

#include <cassert>
#include <utility>

namespace rink::rti {

void DatagramReceiver::receive(Bytes datagram, bool is_gate_open) {
  assert(basis_.phase.is_joined());
  uses_.arrivals.expect_datagrams();
  basis_.counters.bytes_received += datagram.size();
  DatagramHead head;
  Reader reader(datagram);
  if (!exchange(reader, head)) {
    ++basis_.counters.datagrams_ignored;
    return;
  }
  if (is_gate_open && head.frames <= uses_.arrivals.frames_received()) apply(datagram);
  else if (held_.size() < held_max) held_.emplace_back(datagram.begin(), datagram.end());
  else ++basis_.counters.datagrams_ignored;
}

/// The head of the datagram has been read once already, without fault.
void DatagramReceiver::apply(Bytes datagram) {
  DatagramHead head;
  Reader reader(datagram);
  exchange(reader, head);
  if (head.number != 0) {
    if (!receipts_.is_due()) due_since_ = uses_.watch.now();
    if (!receipts_.note(head.number)) {
      ++basis_.counters.datagrams_ignored;
      return;
    }
  }
  ++(read(head, reader) ? basis_.counters.datagrams_received : basis_.counters.datagrams_ignored);
  if (receipts_.is_urgent()) acknowledge();
}

void DatagramReceiver::apply_held() {
  for (std::size_t i = 0; i < held_.size() && basis_.phase.is_joined();) {
    DatagramHead head;
    Reader reader(held_[i]);
    exchange(reader, head);
    if (head.frames > uses_.arrivals.frames_received()) {
      ++i;
      continue;
    }
    const std::vector<std::byte> datagram = std::move(held_[i]);
    held_.erase(held_.begin() + static_cast<std::ptrdiff_t>(i));
    apply(datagram);
  }
}

bool DatagramReceiver::read(const DatagramHead& head, Reader& reader) {
  ReadContext context;
  bool is_understood = true;
  while (is_understood && !reader.is_at_end() && basis_.phase.is_joined()) {
    std::uint8_t kind = 0;
    reader.number(kind);
    if (kind == datagram_end) break;
    AcknowledgeDatagramsMessage ours;
    if (static_cast<MessageKind>(kind) == MessageKind::stamp)
      is_understood = UpdateReceiver::handle_stamp(reader, context);
    else if (static_cast<MessageKind>(kind) == MessageKind::acknowledge_datagrams)
      is_understood = exchange(reader, ours) && uses_.sender.acknowledge(ours);
    else
      is_understood = static_cast<MessageKind>(kind) == MessageKind::updates &&
                      uses_.updates.handle_datagram_updates(reader, head, context);
  }
  return is_understood;
}

void DatagramReceiver::advance_clock() {
  if (receipts_.is_due() && uses_.watch.now() - due_since_ >= DatagramReceipts::longest_delay_s)
    acknowledge();
}

void DatagramReceiver::acknowledge() {
  if (acknowledgement_.empty()) {
    DatagramHead head;
    Writer writer(acknowledgement_);
    exchange(writer, head);
  }
  AcknowledgeDatagramsMessage message = receipts_.acknowledge();
  write(acknowledgement_, message);
}

}  // namespace rink::rti
