// A federation execution's record of one synchronisation point.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "rti/handles.h"
#include "rti/wire/state_stream.h"

namespace rink::rti {

struct SynchronizationPoint {
  std::string label;
  std::vector<std::byte> tag;
  FederateHandle registrar;            ///< none once it has left
  bool is_for_all = false;             ///< federates that join before it is reached belong to it
  std::vector<std::uint32_t> members;  ///< slots of the federates in its set
  std::vector<std::uint32_t> awaited;  ///< those of them that have not achieved it
  std::vector<FederateHandle> failed;  ///< those that reported that they could not

  template <class Stream>
  bool keep(Stream& stream) {
    return keep_all(stream, label, tag, registrar, is_for_all, members, awaited, failed);
  }
};

}  // namespace rink::rti
