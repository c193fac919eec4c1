// Message by message: header, records, values.
#include "rti/ledger/conversation_fields.h"

#include <cassert>
#include <utility>
#include <vector>

#include "rti/baselines/delta_bits.h"
#include "rti/fom/coded_values.h"
#include "rti/fom/fom.h"
#include "rti/fom/quantised_codec.h"
#include "rti/ledger/message_fields.h"
#include "rti/wire/admission_messages.h"
#include "rti/wire/baseline_messages.h"
#include "rti/wire/datagram.h"
#include "rti/wire/declaration_messages.h"
#include "rti/wire/federation_messages.h"
#include "rti/wire/fom_messages.h"
#include "rti/wire/management_messages.h"
#include "rti/wire/membership_messages.h"
#include "rti/wire/object_messages.h"
#include "rti/wire/ownership_messages.h"
#include "rti/wire/region_messages.h"
#include "rti/wire/stamp_steps.h"
#include "rti/wire/time_messages.h"

namespace rink::rti {
namespace {

template <class... Messages>
struct MessageList {};
using Messages = MessageList<
    JoinMessage, ResignMessage, HeartbeatMessage, RegisterSynchronizationPointMessage,
    SynchronizationPointAchievedMessage, WatchFederatesMessage, PublishObjectClassMessage,
    SubscribeObjectClassMessage, PublishInteractionClassMessage, SubscribeInteractionClassMessage,
    RegisterObjectMessage, DeleteObjectMessage, InteractionMessage, CreateRegionMessage,
    ModifyRegionsMessage, AssociateRegionMessage, DeleteRegionMessage, StampMessage,
    CreateFederationExecutionMessage, DestroyFederationExecutionMessage,
    ListFederationExecutionsMessage, QueryManagementMessage, EnableTimeRegulationMessage,
    TimeSwitchMessage, ModifyLookaheadMessage, AdvanceRequestMessage, TimedSendMessage,
    RetractMessage, QueryTimeBoundsMessage, QueryOwnershipMessage, ResignDirectiveMessage,
    RequestUpdateMessage, ChangeTransportationMessage, QueryTransportationMessage,
    InstanceNamesMessage, SpareUpdateMessage, LocalDeleteMessage, AdvisorySwitchMessage,
    AcknowledgeKeyframeMessage, RefuseKeyframeMessage, CreateRegionOverMessage, ModifyRangesMessage,
    RegionalClassMessage, RegionalInteractionMessage, AssociateRegionsMessage,
    InteractionWithinMessage, NotifyHostMessage, AcknowledgeDatagramsMessage, JoinedMessage,
    RefusedMessage, AnnounceSynchronizationPointMessage, FederationSynchronizedMessage,
    FederateJoinedMessage, FederateResignedMessage, DiscoverObjectMessage, RemoveObjectMessage,
    SynchronizationPointRegisteredMessage, FederationExecutionCreatedMessage,
    FederationExecutionDestroyedMessage, FederationExecutionMessage, FederationReportMessage,
    FederateReportMessage, ReportEndMessage, TimeRegulationEnabledMessage,
    TimeConstrainedEnabledMessage, TimeAdvanceGrantMessage, TimedDeliveryMessage,
    RequestRetractionMessage, TimeBoundsMessage, InformOwnershipMessage, InstanceNamesAnswerMessage,
    ClassRelevanceMessage, ObjectRelevanceMessage, TransportationMessage, BeginKeyframeMessage,
    StampStepMessage, FomDigestMessage, ProvideUpdateMessage, ExpelledMessage, FurtherBlockMessage,
    HelloMessage, ChallengeMessage, ProofMessage, AdmittedMessage>;

template <class Message>
bool read_one(FieldReader& reader) {
  Message message;
  return exchange(reader, message);
}
/// A message that is its fields and nothing else.
template <class... Each>
bool read_plain(MessageKind kind, FieldReader& reader, MessageList<Each...>) {
  bool is_sound = false;
  const bool is_known = ((Each::kind == kind && (is_sound = read_one<Each>(reader), true)) || ...);
  return is_known && is_sound;
}

/// Calls `read` and gives the bytes that it takes to `field`.
template <class Read>
bool counted(Reader& reader, FormFields& fields, std::string_view field, Read read,
             std::string_view subject = {}) {
  const std::size_t before = reader.left();
  const bool is_sound = read();
  fields.add(field, 8 * (before - reader.left()), subject);
  return is_sound;
}
/// The same of bits.
template <class Read>
bool counted(BitReader& bits, FormFields& fields, std::string_view field, Read read) {
  const std::size_t before = bits.at();
  const bool is_sound = read();
  fields.add(field, bits.at() - before);
  return is_sound;
}

/// The handles of a block, and its end.
bool read_handles(Reader& reader, FormFields& fields) {
  for (std::uint64_t step = 1; step != 0;) {
    const std::size_t before = reader.left();
    if (!reader.varint(step)) return false;
    fields.add(step == 0 ? "end" : "handle", 8 * (before - reader.left()));
  }
  return true;
}

FieldVisitor of_subject(FormFields& fields, std::string_view subject) {
  return [&fields, subject](std::string_view name, std::size_t bits) {
    fields.add(name, bits, subject);
  };
}

bool has_class(const Fom& fom, std::uint16_t number, AttributeSet set) {
  return number < fom.object_classes().size() &&
         fom.attributes(ObjectClassHandle{number}).includes(set);
}

template <class Message>
bool read_header(Reader& reader, FormFields& fields, Message& message) {
  FieldReader header(reader, fields, fields_of(static_cast<std::uint8_t>(Message::kind))->names);
  return exchange(header, message);
}

constexpr std::size_t tag_size = 16, number_size = 8;  // of what is sealed

}  // namespace

ConversationFields::ConversationFields(const Uses& uses, LedgerDirection direction,
                                       std::unique_ptr<HostContent> content)
    : uses_(uses), direction_(direction), content_(std::move(content)) {}

void ConversationFields::read(Bytes bytes) {
  FormFields fields(uses_.ledger, direction_, LedgerChannel::stream);
  while (!bytes.empty() && !is_lost_) {
    const std::size_t before = bytes.size() + frames_.waiting_bytes();
    Bytes payload;
    if (frames_.next(bytes, frame_max, payload) != Framing::sound) {
      is_lost_ = true;
      return fields.add_alone("unread", "bytes", 8 * before);
    }
    if (payload.empty()) return;  // not whole yet
    fields.add_alone("frame", "head", 8 * (before - bytes.size() - payload.size()));
    if (is_sealed_) count_sealed(payload.size(), fields, 1);
    else read_frame(payload);
  }
  fields.add_alone("unread", "bytes", 8 * bytes.size());
}

void ConversationFields::count_sealed(std::size_t size, FormFields& fields, std::size_t head) {
  fields.begin("sealed");
  const std::size_t around = head + tag_size;
  if (size < around) return fields.add_alone("unread", "bytes", 8 * size);
  fields.add("head", 8 * head);
  fields.add("content", 8 * (size - around));
  fields.add("tag", 8 * tag_size);
  fields.commit();
}

void ConversationFields::end() {
  FormFields fields(uses_.ledger, direction_, LedgerChannel::stream);
  fields.add_alone("unread", "bytes", is_lost_ ? 0 : 8 * waiting_bytes());
  is_lost_ = true;
}

void ConversationFields::read_frame(Bytes payload) {
  FormFields fields(uses_.ledger, direction_, LedgerChannel::stream);
  Reader reader(payload);
  read_messages(reader, fields, false);
}

void ConversationFields::read_datagram(Bytes datagram) {
  FormFields fields(uses_.ledger, direction_, LedgerChannel::datagram);
  if (is_sealed_) return count_sealed(datagram.size(), fields, number_size);
  Reader reader(datagram);
  constexpr std::string_view names[] = {"number", "frames"};
  DatagramHead head;
  fields.begin("datagram");
  FieldReader head_reader(reader, fields, names);
  if (!exchange(head_reader, head)) return fields.add_alone("unread", "bytes", 8 * datagram.size());
  fields.commit();
  read_messages(reader, fields, true);
}

void ConversationFields::read_messages(Reader& reader, FormFields& fields, bool is_datagram) {
  while (!reader.is_at_end()) {
    const auto kind = std::to_integer<std::uint8_t>(reader.rest().front());
    if (is_datagram && kind == datagram_end)
      return fields.add_alone("datagram", "padding", 8 * reader.left());
    const std::size_t left = reader.left();
    const MessageFields* known = fields_of(kind);
    if (known != nullptr) {
      fields.begin(known->form);
      Bytes first;
      counted(reader, fields, "kind", [&] { return reader.rest(first, 1); });
      if (read_message(known->kind, reader, fields)) {
        fields.commit();
        continue;
      }
    }
    return fields.add_alone("unread", "bytes", 8 * left);
  }
}

bool ConversationFields::read_message(MessageKind kind, Reader& reader, FormFields& fields) {
  switch (kind) {
    case MessageKind::updates:
      return read_updates(reader, fields);
    case MessageKind::entries:
      return read_header(reader, fields, entry_header_.emplace()) && read_entries(reader, fields);
    case MessageKind::entries_again:
      return entry_header_ && read_entries(reader, fields);
    case MessageKind::residuals:
      return read_residuals(reader, fields);
    case MessageKind::deltas:
      return read_deltas(reader, fields);
    case MessageKind::host_message:
      return read_host_message(reader, fields);
    case MessageKind::in_scope:
    case MessageKind::out_of_scope:
      return read_handles(reader, fields);
    case MessageKind::ownership_request: {
      OwnershipRequestMessage message;
      return read_header(reader, fields, message) && read_handles(reader, fields);
    }
    case MessageKind::ownership_notice: {
      OwnershipNoticeMessage message;
      return read_header(reader, fields, message) && read_handles(reader, fields);
    }
    default:
      break;
  }
  FieldReader plain(reader, fields, fields_of(static_cast<std::uint8_t>(kind))->names);
  if (!read_plain(kind, plain, Messages{})) return false;
  is_sealed_ |= kind == MessageKind::proof || kind == MessageKind::admitted;
  return true;
}

bool ConversationFields::read_values(const ObjectClass& object_class, AttributeSet set,
                                     Reader& reader, FormFields& fields) const {
  for (const AttributeHandle each : set) {
    const Attribute& attribute = object_class.attributes[each.value];
    const std::optional<std::size_t> size = coded_size(object_class, {each}, reader.rest());
    Bytes value;
    if (!size || !reader.rest(value, *size)) return false;
    if (attribute.codec) attribute.codec->list_fields(value, of_subject(fields, attribute.name));
    else fields.add({}, 8 * *size, attribute.name);
  }
  return true;
}

bool ConversationFields::read_updates(Reader& reader, FormFields& fields) {
  UpdatesMessage message;
  if (!read_header(reader, fields, message)) return false;
  const AttributeSet set{message.attributes};
  if (!has_class(uses_.fom, message.object_class, set)) return false;
  const ObjectClass& object_class = uses_.fom.at(ObjectClassHandle{message.object_class});
  for (;;) {
    const std::size_t before = reader.left();
    std::uint64_t step = 0;
    if (!reader.varint(step)) return false;
    fields.add(step == 0 ? "end" : "handle", 8 * (before - reader.left()));
    if (step == 0) return true;
    if (!read_values(object_class, set, reader, fields)) return false;
  }
}

bool ConversationFields::read_entries(Reader& reader, FormFields& fields) {
  assert(entry_header_);
  const AttributeSet set{entry_header_->attributes}, repeated{entry_header_->repeated},
      recalled{entry_header_->recalled};
  if (!has_class(uses_.fom, entry_header_->object_class, set)) return false;
  const ObjectClass& object_class = uses_.fom.at(ObjectClassHandle{entry_header_->object_class});
  std::uint32_t previous = first_in_scope_block;
  EntryRecord record{.is_last = false};
  while (!record.is_last) {
    if (!counted(reader, fields, "handle", [&] { return read_entry(reader, previous, record); }))
      return false;
    if (record.form == EntryForm::held) continue;
    for (const AttributeHandle each : set.without(repeated)) {
      const std::string_view name = object_class.attributes[each.value].name;
      std::uint8_t number = 0;
      if (recalled.contains(each)
              ? !counted(
                    reader, fields, "recalled", [&] { return reader.number(number); }, name)
              : !read_values(object_class, {each}, reader, fields))
        return false;
    }
  }
  return true;
}

bool ConversationFields::read_residuals(Reader& reader, FormFields& fields) const {
  ResidualsMessage message;
  Bytes block;
  if (!read_header(reader, fields, message) || !has_class(uses_.fom, message.object_class, {}) ||
      !reader.rest(block, message.size))
    return false;
  ResidualCursor cursor{uses_.residuals.residual(message.object_class)};
  BitReader bits(block);
  bool is_sound = !cursor.residual.is_empty() && counted(bits, fields, "orders", [&] {
    return bits.bits(cursor.order, gap_order_bits) &&
           bits.bits(cursor.companion_order, gap_order_bits);
  });
  while (is_sound && !is_block_end(bits)) {
    std::uint32_t handle = 0;
    bool has_companion = false;
    AttributeSet changed;
    is_sound =
        counted(bits, fields, "handle", [&] { return exchange_handle(bits, cursor, handle); }) &&
        counted(bits, fields, "has_companion", [&] { return bits.flag(has_companion); }) &&
        read_residual(message, cursor, bits, &changed, fields);
    if (is_sound && has_companion)
      is_sound = counted(bits, fields, "companion",
                         [&] { return exchange_companion(bits, cursor, handle); }) &&
                 read_residual(message, cursor, bits, &changed, fields);
  }
  fields.add("fill", bits.left());
  return is_sound;
}

/// `companion`: the attributes of the record before if this one is its companion, which become
/// those of this one.
bool ConversationFields::read_residual(const ResidualsMessage& message, ResidualCursor& cursor,
                                       BitReader& bits, AttributeSet* companion,
                                       FormFields& fields) const {
  AttributeSet attributes;
  if (!counted(bits, fields, "attributes",
               [&] { return exchange_attributes(bits, cursor, attributes); }) ||
      !cursor.residual.includes(attributes))
    return false;
  const ObjectClass& object_class = uses_.fom.at(ObjectClassHandle{message.object_class});
  for (const AttributeHandle each : attributes) {
    const Attribute& attribute = object_class.attributes[each.value];
    if (!attribute.codec->list_residual_fields(bits, companion->contains(each),
                                               of_subject(fields, attribute.name)))
      return false;
  }
  *companion = attributes;
  return true;
}

bool ConversationFields::read_deltas(Reader& reader, FormFields& fields) const {
  DeltasMessage message;
  if (!read_header(reader, fields, message) || !has_class(uses_.fom, message.object_class, {}))
    return false;
  const ObjectClassHandle handle{message.object_class};
  const std::optional<AttributeHandle> attribute = uses_.fom.periodic_attribute(handle);
  if (!attribute) return false;
  const Attribute& periodic = uses_.fom.at(handle).attributes[attribute->value];
  const QuantisedCodec& codec = *periodic.baselines;
  BitReader bits(reader.rest());
  DeltaHeader header;
  if (!counted(bits, fields, "baseline",
               [&] { return exchange(bits, header, codec.fields().size()); }))
    return false;
  for (std::uint32_t object = 0;;) {
    auto next = HandleReader::Next::malformed;
    const std::size_t before = bits.at();
    next = read_handle(bits, object);
    if (next == HandleReader::Next::malformed) return false;
    fields.add(next == HandleReader::Next::end ? "end" : "handle", bits.at() - before);
    if (next == HandleReader::Next::end) break;
    bool is_absolute = false, is_full = false;
    if (!counted(bits, fields, "absolute", [&] { return bits.flag(is_absolute); })) return false;
    if (is_absolute && !counted(bits, fields, "form", [&] { return bits.flag(is_full); }))
      return false;
    for (std::size_t i = 0; i < codec.fields().size(); ++i) {
      const QuantisedField& field = codec.fields()[i];
      const std::size_t from = bits.at();
      std::uint64_t difference = 0;
      const bool is_there =
          is_absolute ? bits.skip(is_full ? 8 * field.size : std::size_t{field.grid->bits})
                      : header.has_baseline && bits.golomb(difference, header.orders[i]);
      if (!is_there) return false;
      fields.add(field.name, bits.at() - from, periodic.name);
    }
  }
  Bytes read;
  const bool is_sound = counted(bits, fields, "fill", [&] { return bits.finish(); });
  return reader.rest(read, bits.bytes_read()) && is_sound;
}

bool ConversationFields::read_host_message(Reader& reader, FormFields& fields) {
  std::uint32_t size = 0;
  Bytes content;
  if (!counted(reader, fields, "size", [&] { return reader.varint(size); }) ||
      !reader.rest(content, size))
    return false;
  std::size_t listed = 0;
  std::vector<std::pair<std::string_view, std::size_t>> parts;
  const bool is_read =
      content_ && content_->list_fields(content, [&](std::string_view name, std::size_t bits) {
        parts.emplace_back(name, bits);
        listed += bits;
      });
  if (!is_read || listed != 8 * content.size()) return fields.add("content", 8 * size), true;
  for (const auto& [name, bits] : parts) fields.add(name, bits, "content");
  return true;
}

}  // namespace rink::rti
