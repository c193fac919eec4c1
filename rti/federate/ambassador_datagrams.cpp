// Best-effort updates on the federate's side: applied unless something newer is known, acknowledged
// so that the RTI need not send them again.
#include <bit>
#include <utility>

#include "rti/buffering/best_effort_outbox.h"
#include "rti/federate/ambassador_services.h"
#include "rti/fom/coded_values.h"
#include "rti/wire/datagram.h"
#include "rti/wire/update_block.h"

namespace rink::rti {

namespace {
constexpr std::size_t held_max =
    256;  ///< datagrams that wait for their frames; more are lost, and come again
}

void AmbassadorServices::receive_datagram(Bytes datagram) {
  if (!phase_.is_joined()) return;
  watch_.heard();
  arrivals_.expect_datagrams();
  counters_.bytes_received += datagram.size();
  DatagramHead head;
  Reader reader(datagram);
  if (!exchange(reader, head)) {
    ++counters_.datagrams_ignored;
    return;
  }
  // It may speak of objects that a frame on its way tells of; and while callbacks are disabled
  // frames are held back too.
  if (gate_.is_open() && head.frames <= arrivals_.frames_heard()) apply_datagram(datagram);
  else if (held_datagrams_.size() < held_max)
    held_datagrams_.emplace_back(datagram.begin(), datagram.end());
  else ++counters_.datagrams_ignored;
}

void AmbassadorParts::apply_datagram(Bytes datagram) {
  DatagramHead head;
  Reader reader(datagram);
  exchange(reader, head);
  if (head.number != 0) {
    if (!receipts_.is_due()) receipts_due_since_ = watch_.now();
    if (!receipts_.note(head.number)) {
      ++counters_.datagrams_ignored;
      return;
    }
  }
  ++(take_datagram(head, reader) ? counters_.datagrams_received : counters_.datagrams_ignored);
  if (receipts_.is_urgent()) acknowledge_datagrams();
}

void AmbassadorParts::apply_held_datagrams() {
  for (std::size_t i = 0; i < held_datagrams_.size() && phase_.is_joined();) {
    DatagramHead head;
    Reader reader(held_datagrams_[i]);
    exchange(reader, head);
    if (head.frames > arrivals_.frames_heard()) {
      ++i;
      continue;
    }
    const std::vector<std::byte> datagram = std::move(held_datagrams_[i]);
    held_datagrams_.erase(held_datagrams_.begin() + static_cast<std::ptrdiff_t>(i));
    apply_datagram(datagram);
  }
}

bool AmbassadorParts::take_datagram(const DatagramHead& head, Reader& reader) {
  ReadContext context;
  bool is_understood = true;
  while (is_understood && !reader.is_at_end() && phase_.is_joined()) {
    std::uint8_t kind = 0;
    reader.number(kind);
    if (kind == datagram_end) break;
    AcknowledgeDatagramsMessage ours;
    if (static_cast<MessageKind>(kind) == MessageKind::stamp)
      is_understood = UpdateReceiver::handle_stamp(reader, context);
    else if (static_cast<MessageKind>(kind) == MessageKind::acknowledge_datagrams)
      is_understood = exchange(reader, ours) && outbox_ && outbox_->acknowledge(ours, watch_.now());
    else
      is_understood = static_cast<MessageKind>(kind) == MessageKind::updates &&
                      update_receiver_.handle_datagram_updates(reader, head, context);
  }
  return is_understood;
}

void AmbassadorParts::acknowledge_datagrams() {
  if (acknowledgement_.empty()) {
    DatagramHead head;
    Writer writer(acknowledgement_);
    exchange(writer, head);
  }
  AcknowledgeDatagramsMessage message = receipts_.acknowledge();
  write(acknowledgement_, message);
}

}  // namespace rink::rti
