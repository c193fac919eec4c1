// The messages that the next flush sends to one federate.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "rti/wire/bytes.h"
#include "rti/wire/object_block.h"
#include "rti/wire/state_stream.h"

namespace rink::rti {

/// Messages in the order in which they were put in, in two parts: the head precedes the updates of
/// the flush, the tail follows them.
class Outbox {
 public:
  template <class Message>
  void before_updates(Message message) {
    write(head_, message);
  }
  template <class Message>
  void after_updates(Message message) {
    write(tail_, message);
  }
  /// Appends an object to the tail; it joins the block at the end if that has an equal header.
  template <class Header>
  void in_block(Header header, std::uint32_t object) {
    tail_block_.append(tail_, header, object);
  }
  /// For writers of messages of many parts.
  std::vector<std::byte>& head() { return head_; }
  Bytes tail() const { return tail_; }
  bool is_empty() const { return head_.empty() && tail_.empty(); }
  /// Clears what has been sent.
  void clear() {
    head_.clear();
    tail_.clear();
    tail_block_.close();
  }
  /// The block at the end is closed.
  template <class Stream>
  bool keep(Stream& stream) {
    tail_block_.close();
    return keep_all(stream, head_, tail_);
  }

 private:
  std::vector<std::byte> head_, tail_;
  ObjectBlockWriter tail_block_;  ///< the block at the end of `tail_`, if any
};

}  // namespace rink::rti
