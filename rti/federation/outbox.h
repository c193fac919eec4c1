// What waits to be said to one federate by the next flush.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "rti/wire/bytes.h"
#include "rti/wire/object_block.h"

namespace rink::rti {

/// Messages in the order in which they were put in, apart by what they must precede: the updates of
/// the flush stand between the two.
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
  /// After the updates too; an object joins the block before it if that was said in the same words.
  template <class Header>
  void in_block(Header header, std::uint32_t object) {
    tail_block_.append(tail_, header, object);
  }
  /// For who writes messages of many parts.
  std::vector<std::byte>& head() { return head_; }
  Bytes tail() const { return tail_; }
  /// All of it is on its way.
  void clear() {
    head_.clear();
    tail_.clear();
    tail_block_.close();
  }

 private:
  std::vector<std::byte> head_, tail_;
  ObjectBlockWriter tail_block_;  ///< the block at the end of `tail_`, if any
};

}  // namespace rink::rti
