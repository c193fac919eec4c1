// A saved federation: who was in it, and what the RTI and each federate's ambassador knew.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "rti/handles.h"
#include "rti/wire/state_stream.h"

namespace rink::rti {

struct SavedFederate {
  std::uint32_t slot = 0;
  FederateHandle handle;
  std::string name, type;
  std::vector<std::byte> ambassador;  ///< its state
  template <class Stream>
  bool keep(Stream& stream) {
    return keep_all(stream, slot, handle, name, type, ambassador);
  }
};

struct SavedFederation {
  std::string federation, label;
  std::uint64_t fom_hash = 0;
  std::vector<SavedFederate> federates;
  std::vector<std::byte> state;  ///< the RTI's
  template <class Stream>
  bool keep(Stream& stream) {
    return keep_all(stream, federation, label) && stream.number(fom_hash) &&
           keep_all(stream, federates, state);
  }
};

/// The bytes of a file: a head that names its kind and version, the content's length, its hash and
/// itself.
std::vector<std::byte> encoded(SavedFederation& saved);
/// Why the bytes are no save of the present version, undamaged; empty if they are one, which
/// `saved` then is.
std::string decode(Bytes bytes, SavedFederation& saved);

}  // namespace rink::rti
