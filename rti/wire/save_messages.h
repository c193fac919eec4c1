// The messages by which a federation is saved and restored.
#pragma once

#include "rti/save/save_status.h"
#include "rti/wire/federation_messages.h"
#include "rti/wire/message.h"

namespace rink::rti {

/// What a federate says about a save or a restore; the numbers are those on the wire.
enum class SaveWord : std::uint8_t {
  request,
  request_at_time,
  begun,
  complete,
  not_complete,
  abort,
  query,
  request_restore,
  restore_complete,
  restore_not_complete,
  abort_restore,
  query_restore,
};
/// The first two and `request_restore` have a label, the second a time; what answers the RTI has
/// the number of its notice.
struct SaveRequestMessage {
  static constexpr MessageKind kind = MessageKind::save_request;
  std::uint8_t word = 0;
  std::string_view label;
  double time = 0.0;
  std::uint32_t number = 0;
};
template <class Stream>
bool exchange(Stream& stream, SaveRequestMessage& message) {
  if (!stream.range(message.word, static_cast<std::uint64_t>(SaveWord::query_restore)))
    return false;
  const auto word = static_cast<SaveWord>(message.word);
  const bool has_time = word == SaveWord::request_at_time;
  const bool has_label = has_time || word == SaveWord::request || word == SaveWord::request_restore;
  return (!has_label || stream.text(message.label, text_max)) &&
         (!has_time || (stream.finite(message.time) && stream.check(message.time >= 0.0))) &&
         stream.varint(message.number);
}

/// A piece of what a federate's ambassador knows: pieces precede the federate's "complete". After
/// each `window` the federate waits for the RTI's "go_on", so that no queue of a connection fills.
struct AmbassadorStateMessage {
  static constexpr MessageKind kind = MessageKind::ambassador_state;
  static constexpr std::size_t size_max = 32u << 10;   ///< bytes
  static constexpr std::size_t window = 8 * size_max;  ///< under way at once
  static constexpr std::size_t state_max = 32u << 20;  ///< of all pieces
  Bytes piece;
};
template <class Stream>
bool exchange(Stream& stream, AmbassadorStateMessage& message) {
  return stream.template bytes<std::uint16_t>(message.piece, AmbassadorStateMessage::size_max);
}

/// What the RTI says about a save or a restore; the numbers are those on the wire.
enum class SaveNotice : std::uint8_t {
  initiate,
  initiate_at_time,
  saved,
  not_saved,
  restore_confirmed,
  restore_refused,
  restore_begun,
  initiate_restore,
  not_restored,
  go_on,
};
/// `text` is a label, or why it failed; `name` and `federate` are those of `initiate_restore`,
/// `name` is why a restore is refused, `failure` that of the two that failed. Each save and each
/// restore has a number of its own, so that an answer to one that was aborted is not taken for
/// another's.
struct SaveNoticeMessage {
  static constexpr MessageKind kind = MessageKind::save_notice;
  std::uint8_t notice = 0;
  std::uint32_t number = 0;
  std::string_view text;
  std::uint8_t failure = 0;
  double time = 0.0;
  std::string_view name;
  std::uint32_t federate = FederateHandle::none;
};
template <class Stream>
bool exchange(Stream& stream, SaveNoticeMessage& message) {
  if (!stream.range(message.notice, static_cast<std::uint64_t>(SaveNotice::go_on)) ||
      !stream.varint(message.number) || !stream.text(message.text, text_max))
    return false;
  switch (static_cast<SaveNotice>(message.notice)) {
    case SaveNotice::initiate_at_time:
      return stream.finite(message.time);
    case SaveNotice::not_saved:
      return stream.range(message.failure, static_cast<std::uint64_t>(SaveFailure::save_aborted));
    case SaveNotice::not_restored:
      return stream.range(message.failure,
                          static_cast<std::uint64_t>(RestoreFailure::restore_aborted));
    case SaveNotice::restore_refused:
      return stream.text(message.name, text_max);
    case SaveNotice::initiate_restore:
      return stream.text(message.name, text_max) && stream.number(message.federate);
    default:
      return true;
  }
}

/// A piece of what the federate's ambassador knew, and its handle; the last has its block of object
/// handles, since the state may be another federate's word. With the last the federation is
/// restored; those before are sent as far as the connection takes them.
struct RestoredMessage {
  static constexpr MessageKind kind = MessageKind::restored;
  std::uint32_t federate = FederateHandle::none;
  std::uint8_t is_last = 0;
  std::uint32_t block = 0;
  Bytes piece;
};
template <class Stream>
bool exchange(Stream& stream, RestoredMessage& message) {
  return stream.number(message.federate) && stream.range(message.is_last, 1) &&
         (message.is_last == 0 || stream.number(message.block)) &&
         stream.template bytes<std::uint16_t>(message.piece, AmbassadorStateMessage::size_max);
}

/// Answers a query: of each federate its handle before and after a restore, or its handle twice,
/// and its status.
struct SaveStatusMessage {
  static constexpr MessageKind kind = MessageKind::save_status;
  static constexpr std::size_t record_size = 9;
  std::uint8_t is_restore = 0;
  std::uint16_t count = 0;
  Bytes records;
};
template <class Stream>
bool exchange(Stream& stream, SaveStatusMessage& message) {
  return stream.range(message.is_restore, 1) &&
         stream.range(message.count, HandleList::count_max) &&
         stream.rest(message.records, message.count * SaveStatusMessage::record_size);
}
struct SaveStatusRecord {
  std::uint32_t before = FederateHandle::none, after = FederateHandle::none;
  std::uint8_t status = 0;
};
template <class Stream>
bool exchange(Stream& stream, SaveStatusRecord& record) {
  return stream.numbers(record.before, record.after) &&
         stream.range(record.status, static_cast<std::uint64_t>(RestoreStatus::waiting));
}

}  // namespace rink::rti
