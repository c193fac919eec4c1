// Texts of refusals that name the version or model of each end.
#pragma once

#include <cinttypes>
#include <cstdint>
#include <cstdio>
#include <string>

#include "rti/membership.h"

namespace rink::rti {

inline std::string refused_version(std::uint16_t of_federate, std::uint16_t of_rti) {
  return std::string(to_string(Refusal::wrong_version)) + "; the federate speaks version " +
         std::to_string(of_federate) + ", the RTI version " + std::to_string(of_rti);
}

/// Names both object models by their hashes (docs/wire.md).
inline std::string refused_fom(std::uint64_t of_federate, std::uint64_t of_rti) {
  char hashes[96];
  std::snprintf(hashes, sizeof hashes,
                "; the hash of the federate's is %016" PRIx64 ", of the RTI's %016" PRIx64,
                of_federate, of_rti);
  return to_string(Refusal::wrong_fom) + std::string(hashes);
}

}  // namespace rink::rti
