// How an ambassador puts a message at the end of what goes out, and names what it complains of; for
// its own sources only.
#pragma once

#include <cassert>
#include <string>

#include "rti/federate/ambassador_parts.h"

namespace rink::rti {

/// As exceptions call it.
inline std::string name_of(ObjectHandle object) { return "object " + std::to_string(object.value); }

template <class Message>
void AmbassadorParts::say(Message message) {
  if (phase_ != Phase::joining && phase_ != Phase::joined) refuse_stranger();
  append(message);
}

template <class Message>
void AmbassadorParts::append(Message& message) {
  write(outgoing_.begin_message(measure(message)), message);
  outgoing_.appended();
  open_.is_open = false;
}

template <class Header>
void AmbassadorParts::say_of(Header header, ObjectHandle object) {
  assert(phase_ == Phase::joined);
  const std::size_t size = measure(header) + object_record_max;
  if (!outgoing_.has_room(size)) object_block_writer_.close();
  object_block_writer_.append(outgoing_.begin_message(size), header, object.value);
  outgoing_.appended();
  open_.is_open = false;
}

}  // namespace rink::rti
