// The first byte of the messages of every window.
#pragma once

#include <cassert>
#include <cstdint>
#include <initializer_list>

namespace rink::peer {

/// It marks which of the mostly absent parts follow. Its highest bit is always set, as in no other
/// message that may come instead (Loss, Entry).
class Head {
 public:
  explicit Head(std::initializer_list<bool> parts) : count_(static_cast<int>(parts.size())) {
    assert(parts.size() <= 7 && "the eighth bit is always set");
    int bit = 0;
    for (const bool is_there : parts) bits_ |= static_cast<std::uint64_t>(is_there) << bit++;
  }
  template <class Stream>
  bool exchange(Stream& stream) {
    return stream.part(bits_, 1) && bits_ >> count_ == 0x80u >> count_;
  }
  bool has(int part) const {
    assert(part >= 0 && part < count_);
    return (bits_ >> part & 1) != 0;
  }

 private:
  int count_;
  std::uint64_t bits_ = 0x80;
};

}  // namespace rink::peer
