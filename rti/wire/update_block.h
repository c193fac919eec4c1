// Blocks of updates on the wire: records that follow a header until a zero, each with the step from
// the handle before (docs/wire.md).
#pragma once

#include <algorithm>
#include <array>
#include <cassert>
#include <cstdint>
#include <optional>
#include <vector>

#include "rti/fom/coded_values.h"
#include "rti/wire/message.h"
#include "rti/wire/stream.h"

namespace rink::rti {

/// The step from one handle to the next as it is sent: small for near handles in either direction,
/// and never 0, which ends the block.
inline std::uint64_t handle_step(std::uint32_t from, std::uint32_t to) {
  return zigzag(std::int64_t{to} - std::int64_t{from}) + 1;
}
/// Moves `handle` on by a step that is not the end of a block; false if there is no such handle.
inline bool follow_step(std::uint64_t step, std::uint32_t& handle) {
  assert(step != 0);
  if (--step >> 34 != 0) return false;
  const std::int64_t next = std::int64_t{handle} + from_zigzag(step);
  if (next < 0 || next > 0xffffffffll) return false;
  handle = static_cast<std::uint32_t>(next);
  return true;
}
inline void write_handle(std::vector<std::byte>& bytes, std::uint32_t previous,
                         std::uint32_t handle) {
  std::uint64_t step = handle_step(previous, handle);
  Writer(bytes).varint(step);
}

/// Reads the handles of one block.
class HandleReader {
 public:
  enum class Next : std::uint8_t { handle, end, malformed };
  explicit HandleReader(std::uint32_t previous = 0) : previous_(previous) {}
  Next next(Reader& reader, std::uint32_t& handle) {
    std::uint64_t step = 0;
    if (!reader.varint(step)) return Next::malformed;
    if (step == 0) return Next::end;
    if (!follow_step(step, previous_)) return Next::malformed;
    handle = previous_;
    return Next::handle;
  }

 private:
  std::uint32_t previous_;
};

/// Appends records to `bytes`, gathered in small parts since a vector grows slowly byte by byte.
/// Its end closes the block.
class RecordWriter {
 public:
  explicit RecordWriter(std::vector<std::byte>& bytes) : bytes_(bytes) {}
  RecordWriter(const RecordWriter&) = delete;
  RecordWriter& operator=(const RecordWriter&) = delete;
  ~RecordWriter() {
    part_[used_++] = std::byte{0};
    flush();
  }

  void add(std::uint32_t handle, Bytes values) {
    if (used_ + varint_size_max + 1 > part_.size()) flush();
    used_ = static_cast<std::size_t>(
        put_varint(part_.data() + used_, handle_step(previous_, handle)) - part_.data());
    previous_ = handle;
    if (used_ + values.size() + 1 > part_.size()) flush();
    if (values.size() + 1 > part_.size()) {
      bytes_.insert(bytes_.end(), values.begin(), values.end());
      return;
    }
    std::ranges::copy(values, part_.data() + used_);
    used_ += values.size();
    assert(used_ < part_.size());  // the block's end has room
  }

 private:
  void flush() {
    bytes_.insert(bytes_.end(), part_.begin(), part_.begin() + static_cast<std::ptrdiff_t>(used_));
    used_ = 0;
  }
  std::vector<std::byte>& bytes_;
  std::array<std::byte, 1024> part_;
  std::size_t used_ = 0;
  std::uint32_t previous_ = 0;
};

/// Reads one record after the other: `take(handle, coded values)` returns false to stop. Returns
/// false if the block is malformed or `take` returned false.
template <class Take>
bool read_records(Reader& reader, const ObjectClass& object_class, AttributeSet set, Take take) {
  const std::optional<std::uint32_t> fixed_size = coded_size(object_class, set);
  HandleReader handles;
  for (;;) {
    std::uint32_t handle = 0;
    const HandleReader::Next next = handles.next(reader, handle);
    if (next != HandleReader::Next::handle) return next == HandleReader::Next::end;
    const std::optional<std::size_t> size = fixed_size
                                                ? std::optional<std::size_t>(*fixed_size)
                                                : coded_size(object_class, set, reader.rest());
    Bytes values;
    if (!size || *size > values_max || !reader.rest(values, *size) || !take(handle, values))
      return false;
  }
}

}  // namespace rink::rti
