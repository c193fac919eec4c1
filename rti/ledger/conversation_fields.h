// Reads what passes in one direction of a conversation with the RTI, and gives each bit of it to
// the field that it belongs to.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>

#include "rti/baselines/residual_bits.h"
#include "rti/baselines/residual_model.h"
#include "rti/fom/attribute_codec.h"
#include "rti/ledger/field_reader.h"
#include "rti/wire/entry_block.h"
#include "rti/wire/frame.h"

namespace rink::rti {

/// Names the fields of what a host sends one of its federates, message after message.
class HostContent {
 public:
  virtual ~HostContent() = default;
  /// All bits of `content`, in order; false if it is none that can be read.
  virtual bool list_fields(Bytes content, const FieldVisitor& visit) = 0;
};
using MakeHostContent = std::function<std::unique_ptr<HostContent>()>;

/// Knows the grammar of docs/wire.md and no values. What it cannot read is counted as `unread`, and
/// so is all that comes after a frame that is none; once both ends have proven that they have a
/// key, what they seal is counted as `sealed`.
class ConversationFields {
 public:
  struct Uses {
    const Fom& fom;
    const ResidualModel& residuals;
    ByteLedger& ledger;
  };
  /// `content` may be null.
  ConversationFields(const Uses& uses, LedgerDirection direction,
                     std::unique_ptr<HostContent> content);

  /// Bytes of the stream, cut anywhere. Those of a frame that is not whole yet are not counted.
  void read(Bytes bytes);
  void read_datagram(Bytes datagram);
  /// Of a frame that is not whole.
  std::size_t waiting_bytes() const { return frames_.waiting_bytes(); }
  /// The stream has ended: counts what waits as `unread`.
  void end();

 private:
  void read_frame(Bytes payload);
  void read_messages(Reader& reader, FormFields& fields, bool is_datagram);
  bool read_message(MessageKind kind, Reader& reader, FormFields& fields);
  bool read_updates(Reader& reader, FormFields& fields);
  bool read_entries(Reader& reader, FormFields& fields);
  bool read_values(const ObjectClass& object_class, AttributeSet set, Reader& reader,
                   FormFields& fields) const;
  bool read_residuals(Reader& reader, FormFields& fields) const;
  bool read_residual(const ResidualsMessage& message, ResidualCursor& cursor, BitReader& bits,
                     AttributeSet* companion, FormFields& fields) const;
  bool read_deltas(Reader& reader, FormFields& fields) const;
  bool read_host_message(Reader& reader, FormFields& fields);
  void count_sealed(std::size_t size, FormFields& fields, std::size_t head);

  Uses uses_;
  LedgerDirection direction_;
  std::unique_ptr<HostContent> content_;
  FrameReader frames_;
  EntryHeader entry_header_;
  bool is_sealed_ = false, is_lost_ = false;
};

}  // namespace rink::rti
