// Blocks of objects on the wire: a header that many objects share is written once (docs/wire.md).
#pragma once

#include <cassert>
#include <cstdint>
#include <vector>

#include "rti/wire/message.h"
#include "rti/wire/update_block.h"

namespace rink::rti {

/// Most bytes that an object adds to a block, its end included.
inline constexpr std::size_t object_record_max = 5 + 1;

/// The handle before the first of a block of changes of scope: most are of objects that the first
/// federate registered.
inline constexpr std::uint32_t first_in_scope_block = object_block;

/// The handle before the first of a block with this header.
template <class Header>
constexpr std::uint32_t before_first() {
  constexpr bool is_scope =
      Header::kind == MessageKind::in_scope || Header::kind == MessageKind::out_of_scope;
  return is_scope ? first_in_scope_block : 0;
}

/// Writes blocks: a header, then the step to each object, then a zero. An object joins the block
/// before it if that stands at the end of the buffer and has an equal header, so that a message
/// about each of a thousand bodies takes a thousand bytes and callers need no bulk form.
class ObjectBlockWriter {
 public:
  template <class Header>
  void append(std::vector<std::byte>& bytes, Header header, std::uint32_t object) {
    assert(end_ <= bytes.size());  // `close` was called if the buffer was cleared
    scratch_.clear();
    write(scratch_, header);
    if (end_ != 0 && end_ == bytes.size() && scratch_ == header_) {
      bytes.pop_back();
    } else {
      bytes.insert(bytes.end(), scratch_.begin(), scratch_.end());
      header_.swap(scratch_);
      previous_ = before_first<Header>();
    }
    write_handle(bytes, previous_, object);
    bytes.push_back(std::byte{0});
    previous_ = object;
    end_ = bytes.size();
  }
  /// Makes the next object begin a block. Call it whenever the buffer was cleared.
  void close() { end_ = 0; }

 private:
  std::vector<std::byte> header_, scratch_;
  std::size_t end_ = 0;
  std::uint32_t previous_ = 0;
};

/// Calls `take(object)` for each object of the block whose header was read; `take` returns false to
/// stop. False if the block is malformed or was stopped. `previous` is the handle before the first.
template <class Take>
bool read_objects(Reader& reader, Take take, std::uint32_t previous = 0) {
  HandleReader handles(previous);
  for (;;) {
    std::uint32_t handle = 0;
    const HandleReader::Next next = handles.next(reader, handle);
    if (next != HandleReader::Next::handle) return next == HandleReader::Next::end;
    if (!take(ObjectHandle{handle})) return false;
  }
}

}  // namespace rink::rti
