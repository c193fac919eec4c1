// Blocks of entries on the wire: objects that come into scope, with their values (docs/wire.md).
#pragma once

#include <cassert>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "rti/types.h"
#include "rti/wire/message.h"
#include "rti/wire/object_block.h"
#include "rti/wire/update_block.h"

namespace rink::rti {

enum class EntryForm : std::uint8_t {
  known,       ///< the values follow
  discovered,  ///< the same; the federate did not know the object, whose name is the default one
  held,        ///< the federate holds the values already: nothing follows
};
inline constexpr unsigned entry_form_bits = 2;
inline constexpr auto last_entry_form = EntryForm::held;

/// One object of a block of entries, before its values.
struct EntryRecord {
  std::uint32_t handle = 0;
  EntryForm form = EntryForm::known;
  bool is_last = true;  ///< of its block
};

inline void write_entry(std::vector<std::byte>& bytes, std::uint32_t previous,
                        const EntryRecord& record) {
  std::uint64_t word = (handle_step(previous, record.handle) - 1) << (entry_form_bits + 1) |
                       std::uint64_t{static_cast<std::uint8_t>(record.form)} << 1 |
                       (record.is_last ? 1u : 0u);
  Writer(bytes).varint(word);
}
/// False if it is malformed.
inline bool read_entry(Reader& reader, std::uint32_t& previous, EntryRecord& record) {
  std::uint64_t word = 0;
  if (!reader.varint(word) || !follow_step((word >> (entry_form_bits + 1)) + 1, previous))
    return false;
  record.handle = previous;
  record.form = static_cast<EntryForm>(word >> 1 & 3u);
  record.is_last = (word & 1u) != 0;
  return record.form <= last_entry_form;
}

/// The header of the last block of entries on a connection, of which both ends keep the same:
/// another like it goes without.
using EntryHeader = std::optional<EntriesMessage>;

/// A block of entries whose values are written in place.
class EntriesBlock {
 public:
  EntriesBlock(std::vector<std::byte>& bytes, EntryHeader& last) : bytes_(bytes), last_(last) {}

  /// Appends what `put` appends as the coded values of one object. Nothing else may have been
  /// appended since the object before unless `close` was called.
  template <class Put>
  void append(const EntriesMessage& header, std::uint32_t handle, EntryForm form, Put put) {
    if (is_open_ && header == *last_)
      bytes_[last_record_] &= ~std::byte{1};  // it is not the block's last
    else begin(header);
    last_record_ = bytes_.size();
    write_entry(bytes_, previous_, {handle, form});
    previous_ = handle;
    put();
  }
  void close() { is_open_ = false; }

 private:
  void begin(const EntriesMessage& header) {
    if (last_ == header) {
      EntriesAgainMessage again;
      write(bytes_, again);
    } else {
      last_ = header;
      write(bytes_, *last_);
    }
    previous_ = first_in_scope_block;
    is_open_ = true;
  }

  std::vector<std::byte>& bytes_;
  EntryHeader& last_;
  std::size_t last_record_ = 0;  ///< where the last record stands in `bytes_`
  std::uint32_t previous_ = 0;
  bool is_open_ = false;
};

}  // namespace rink::rti
