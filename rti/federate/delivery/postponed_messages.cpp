// Keeps messages as bytes until they may be delivered.
#include "rti/federate/delivery/postponed_messages.h"

#include "rti/baselines/residual_bits.h"
#include "rti/wire/entry_block.h"
#include "rti/wire/update_block.h"

namespace rink::rti {

bool PostponedMessages::keep(Reader& reader, MessageKind kind, const ReadContext& context) {
  const Bytes body = reader.rest();
  const bool is_stamped = kind == MessageKind::updates || kind == MessageKind::residuals;
  if (is_stamped && !context.stamp) return false;
  const std::size_t start = bytes_.size();
  if (is_stamped) {
    StampMessage stamp{*context.stamp};
    write(bytes_, stamp);
  }
  if (!skip(reader, kind)) {
    bytes_.resize(start);
    return false;
  }
  bytes_.push_back(static_cast<std::byte>(kind));
  bytes_.insert(bytes_.end(), body.begin(),
                body.end() - static_cast<std::ptrdiff_t>(reader.left()));
  return true;
}

void PostponedMessages::keep_values(const Stamp& stamp, const EntriesMessage& block,
                                    ObjectHandle object, Bytes values) {
  StampMessage stamped{stamp};
  UpdatesMessage header{block.object_class, block.attributes};
  write(bytes_, stamped);
  write(bytes_, header);
  RecordWriter(bytes_).add(object.value, values);
}

void PostponedMessages::keep_held(const Stamp& stamp, const EntriesMessage& block,
                                  ObjectHandle object) {
  StampMessage stamped{stamp};
  EntriesMessage header{block.object_class, block.attributes, 0};
  write(bytes_, stamped);
  write(bytes_, header);
  write_entry(bytes_, first_in_scope_block, {object.value, EntryForm::held});
}

/// Steps over a message.
bool PostponedMessages::skip(Reader& reader, MessageKind kind) const {
  if (kind == MessageKind::updates) {
    UpdatesMessage message;
    return exchange(reader, message) && message.object_class < fom_.object_classes().size() &&
           read_records(reader, fom_.object_classes()[message.object_class],
                        AttributeSet(message.attributes),
                        [](std::uint32_t, Bytes) { return true; });
  }
  if (kind == MessageKind::residuals) {
    ResidualsMessage message;
    Bytes bits;
    return exchange(reader, message) && reader.rest(bits, message.size);
  }
  if (kind == MessageKind::interaction) {
    InteractionMessage message;
    return exchange(reader, message);
  }
  RemoveObjectMessage message;
  return exchange(reader, message);
}

}  // namespace rink::rti
