// The contents of datagrams, kept once for all destinations that were sent the same.
#pragma once

#include <cassert>
#include <cstdint>
#include <span>
#include <vector>

#include "rti/types.h"
#include "rti/wire/bytes.h"
#include "rti/wire/update_block.h"

namespace rink::rti {

/// The contents of one datagram: groups of attributes (varint) and the steps from handle to handle
/// that a block of updates has on the wire, ended by 0. A handle takes two bytes instead of four:
/// with 275 positions to each of 1,000 federates every tick, the unacknowledged ones must fit the
/// cache.
class SentRecord {
 public:
  void clear() { bytes_.clear(), has_group_ = false; }
  bool is_empty() const { return bytes_.empty(); }
  void begin_group(AttributeSet attributes) {
    end_group();
    Writer writer(bytes_);
    attribute_bits(writer, attributes.bits);
    last_ = 0;
    has_group_ = true;
  }
  void add(std::uint32_t handle) {
    assert(has_group_);
    write_handle(bytes_, last_, handle);
    last_ = handle;
  }
  void end_group() {
    if (has_group_) bytes_.push_back(std::byte{0});
    has_group_ = false;
  }
  /// Groups that are ended.
  void append(Bytes groups) {
    end_group();
    bytes_.insert(bytes_.end(), groups.begin(), groups.end());
  }
  Bytes groups() const { return bytes_; }

 private:
  std::vector<std::byte> bytes_;
  std::uint32_t last_ = 0;
  bool has_group_ = false;
};

/// Calls `visit(handle, attributes)` for each that `groups` name.
template <class Visit>
void for_each_sent(Bytes groups, Visit visit) {
  Reader reader(groups);
  while (!reader.is_at_end()) {
    AttributeBits attributes = 0;
    std::uint32_t handle = 0;
    if (!attribute_bits(reader, attributes)) return;
    for (HandleReader handles; handles.next(reader, handle) == HandleReader::Next::handle;)
      visit(handle, AttributeSet(attributes));
  }
}

/// Lists that many destinations' ledgers refer to. A list is unchanged while any ledger refers to
/// it; then its memory is used again.
class SentRecordPool {
 public:
  using Number = std::uint32_t;
  static constexpr Number none = 0xffffffffu;

  /// Adds a list that is held once, by the caller.
  Number add(Bytes groups) {
    if (free_.empty()) {
      free_.push_back(static_cast<Number>(lists_.size()));
      lists_.emplace_back();
    }
    const Number number = free_.back();
    free_.pop_back();
    assert(lists_[number].holders == 0);
    lists_[number].groups.assign(groups.begin(), groups.end());
    lists_[number].holders = 1;
    return number;
  }
  void hold(Number number) {
    assert(is_held(number));
    ++lists_[number].holders;
  }
  void release(Number number) {
    assert(is_held(number));
    if (--lists_[number].holders == 0) free_.push_back(number);
  }
  Bytes groups(Number number) const {
    assert(is_held(number));
    return lists_[number].groups;
  }
  std::size_t in_use() const { return lists_.size() - free_.size(); }

 private:
  bool is_held(Number number) const { return number < lists_.size() && lists_[number].holders > 0; }

  struct List {
    std::vector<std::byte> groups;
    std::uint32_t holders = 0;
  };
  std::vector<List> lists_;
  std::vector<Number> free_;
};

}  // namespace rink::rti
