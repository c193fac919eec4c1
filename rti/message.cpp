// The one message that is written piece by piece: its header goes in last.
#include "rti/message.h"

#include <cstring>

namespace rink::rti {

void write_updates_header(std::byte* at, std::uint16_t object_class, AttributeSet attributes, const Stamp& stamp, std::uint32_t value_size,
                          std::uint32_t count, std::uint32_t records_size) {
  const auto put = [&at](const auto& value) {
    std::memcpy(at, &value, sizeof value);
    at += sizeof value;
  };
  put(static_cast<std::uint8_t>(UpdatesMessage::kind));
  put(object_class);
  put(attributes.bits);
  put(stamp.time);
  put(stamp.tag);
  put(value_size);
  put(count);
  put(records_size);
}

}  // namespace rink::rti
