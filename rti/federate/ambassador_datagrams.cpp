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
  has_datagrams_ = true;
  counters_.bytes_received += datagram.size();
  DatagramHead head;
  Reader reader(datagram);
  if (!exchange(reader, head)) {
    ++counters_.datagrams_ignored;
    return;
  }
  // It may speak of objects that a frame on its way tells of; and while callbacks are disabled
  // frames are held back too.
  if (gate_.is_open() && head.frames <= frames_heard_) apply_datagram(datagram);
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
    if (head.frames > frames_heard_) {
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
      is_understood = take_stamp(reader, context);
    else if (static_cast<MessageKind>(kind) == MessageKind::acknowledge_datagrams)
      is_understood = exchange(reader, ours) && outbox_ && outbox_->acknowledge(ours, watch_.now());
    else
      is_understood = static_cast<MessageKind>(kind) == MessageKind::updates &&
                      take_datagram_updates(head, reader, context);
  }
  return is_understood;
}

bool AmbassadorParts::take_datagram_updates(const DatagramHead& head, Reader& reader,
                                            const ReadContext& context) {
  UpdatesMessage message;
  if (!exchange(reader, message) || !context.stamp ||
      message.object_class >= fom_.object_classes().size())
    return false;
  const AttributeSet attributes{message.attributes};
  if (!arrivals_.best_effort(message.object_class).includes(attributes)) return false;
  const ObjectClass& object_class = fom_.at(ObjectClassHandle{message.object_class});
  const Stamp stamp = *context.stamp;
  const bool is_read =
      read_records(reader, object_class, attributes, [&](std::uint32_t object, Bytes values) {
        const KnownObject* known = objects_.find({object});
        // One that is unknown or out of scope by now has been told of since this was said, or will
        // be, with its whole state.
        const bool is_known = known != nullptr && known->object_class == message.object_class;
        const AttributeSet accepted = is_known
                                          ? arrivals_.accept({object}, message.object_class,
                                                             attributes, order_of_datagram(head))
                                          : AttributeSet();
        if (accepted.is_empty()) return ++counters_.updates_outdated, true;
        if (accepted != attributes) {
          heard_values_.clear();
          for (std::uint32_t bits = accepted.bits; bits != 0; bits &= bits - 1) {
            const Bytes value =
                coded_value(object_class, attributes,
                            {static_cast<std::uint32_t>(std::countr_zero(bits))}, values);
            heard_values_.insert(heard_values_.end(), value.begin(), value.end());
          }
          values = heard_values_;
        }
        if (is_coded(object_class, accepted)) {
          decoded_.clear();
          if (!decode(object_class, accepted, values, stamp.time, decoded_)) return false;
          values = decoded_;
        }
        ++counters_.updates_reflected;
        callbacks_.reflect_attribute_values({object}, accepted, values, stamp);
        return phase_.is_joined();
      });
  return is_read || !phase_.is_joined();
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
