// Messages in receive order that wait until a constrained federate asks to advance.
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "rti/federate/read_context.h"
#include "rti/fom/fom.h"
#include "rti/wire/message.h"
#include "rti/wire/state_stream.h"

namespace rink::rti {

class PostponedMessages {
 public:
  explicit PostponedMessages(const Fom& fom) : fom_(fom) {}

  /// Keeps one message, with its stamp if it needs one. False if it is malformed.
  bool keep(Reader& reader, MessageKind kind, const ReadContext& context);
  /// Keeps the coded values of an object that a block of entries brought, as an update.
  void keep_values(const Stamp& stamp, const EntriesMessage& block, ObjectHandle object,
                   Bytes values);
  /// Keeps that the object is to be reflected as it is held once all before this was released.
  void keep_held(const Stamp& stamp, const EntriesMessage& block, ObjectHandle object);
  bool is_empty() const { return bytes_.empty(); }
  /// True if a federate that never advances has let too much wait.
  bool is_overfull() const { return bytes_.size() > size_max; }
  /// The messages, one after the other.
  std::vector<std::byte> take() { return std::exchange(bytes_, {}); }
  std::size_t memory_bytes() const { return bytes_.capacity(); }
  template <class Stream>
  bool keep(Stream& stream) {
    return keep_all(stream, bytes_);
  }

 private:
  static constexpr std::size_t size_max = 64u << 20;  ///< [bytes]
  bool skip(Reader& reader, MessageKind kind) const;

  const Fom& fom_;
  std::vector<std::byte> bytes_;
};

}  // namespace rink::rti
