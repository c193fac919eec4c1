// Blocks of updates written value by value, by which the central component sends stored values.
#pragma once

#include <cstdint>
#include <vector>

#include "rti/wire/message.h"
#include "rti/wire/update_block.h"

namespace rink::rti {

/// A block of updates whose values are written in place. The destructor completes it, or writes
/// nothing if it stayed empty.
class UpdatesBlock {
 public:
  explicit UpdatesBlock(std::vector<std::byte>& bytes) : bytes_(bytes) {}
  ~UpdatesBlock() { close(); }
  UpdatesBlock(const UpdatesBlock&) = delete;
  UpdatesBlock& operator=(const UpdatesBlock&) = delete;

  /// Appends what `put` appends as the coded values of one object.
  template <class Put>
  void append(std::uint16_t object_class, AttributeSet attributes, ObjectHandle object, Put put) {
    if (!is_open_ || object_class != header_.object_class || attributes.bits != header_.attributes)
      begin(object_class, attributes);
    write_handle(bytes_, previous_, object.value);
    previous_ = object.value;
    put();
  }

 private:
  void begin(std::uint16_t object_class, AttributeSet attributes) {
    close();
    header_ = {object_class, attributes.bits};
    write(bytes_, header_);
    previous_ = 0;
    is_open_ = true;
  }
  void close() {
    if (is_open_) bytes_.push_back(std::byte{0});
    is_open_ = false;
  }

  std::vector<std::byte>& bytes_;
  UpdatesMessage header_;
  std::uint32_t previous_ = 0;
  bool is_open_ = false;
};

}  // namespace rink::rti
